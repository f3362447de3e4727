#include "tools/study/study_record.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::study_record_test {

using tools::read_record;

constexpr const char* kRun = R"({"end": 0, "code": 2, "wall_s": 1.5, "cpu_s": 1, "memory_MB": 30})";

class Record : public testing::Test {
 protected:
  tools::CaseRecord read(const std::string& text) const {
    return read_record(folder_.file("case.json", text), "k");
  }
  TemporaryFolder folder_;
};

TEST_F(Record, IsReadAsItWasWritten) {
  tools::CaseRecord record;
  record.runs.push_back({tools::ProgramUse::End::Signalled, 11, 1.5, 1.25, 30});
  record.message = "it crashed";
  tools::write_record(folder_ / "case.json", "k", record);
  const tools::CaseRecord again = read_record(folder_ / "case.json", "k");
  ASSERT_EQ(again.runs.size(), 1U);
  EXPECT_EQ(again.outcome(), "crashed, signal 11");
  EXPECT_EQ(again.runs[0].cpu_seconds, 1.25);
  EXPECT_EQ(again.message, "it crashed");
  EXPECT_TRUE(read_record(folder_ / "case.json", "other").runs.empty());
}

// The case runs again then. A part of it would count as a run that was.
TEST_F(Record, ADamagedOneIsNone) {
  const std::string run = kRun;
  ASSERT_EQ(read(R"({"key": "k", "runs": [)" + run + R"(], "message": ""})").runs.size(), 1U);
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string(R"({"key": 1})"),
        std::string(R"({"key": "k"})"), R"({"key": "k", "runs": [)" + run + "]}",
        R"({"key": "k", "runs": [)" + run + R"(, {}], "message": ""})",
        R"({"key": "k", "runs": [)" + run + R"(], "message": null})",
        std::string(R"({"key": "k", "message": "", "runs": [{"end": 1e308, "code": 0, )"
                    R"("wall_s": 1, "cpu_s": 1, "memory_MB": 1}]})")})
    EXPECT_TRUE(read(text).runs.empty()) << text;
}

}  // namespace articular::study_record_test
