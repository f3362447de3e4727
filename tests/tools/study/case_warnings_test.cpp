// What the runs of a study were warned of, each kind once.
#include "tools/study/case_warnings.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/sim/support/temporary_folder.hpp"

namespace articular::tools::case_warnings_test {

namespace fs = std::filesystem;

StudyCase case_called(const std::string& name) {
  StudyCase c;
  c.name = name;
  c.folder = name;
  return c;
}

CaseRecord ended_with(int code) {
  CaseRecord record;
  record.runs.push_back({ProgramUse::End::Exited, code, 1, 1, 1});
  return record;
}

class CaseWarnings : public testing::Test {
 protected:
  void warned(const StudyCase& c, const std::vector<std::string>& warnings) {
    const fs::path results = results_of(folder_.path(), c);
    fs::create_directories(results);
    std::ofstream(results / "summary.json") << nlohmann::json({{"warnings", warnings}});
  }

  const TemporaryFolder folder_;
};

TEST_F(CaseWarnings, ThatDifferInTheirNumbersAreOfOneKind) {
  const std::vector<StudyCase> cases = {case_called("a"), case_called("b"), case_called("c")};
  warned(cases[0], {"drawn out by 41.5 %", "drawn out by -3 %"});
  warned(cases[1], {"nothing holds it", "drawn out by 50 %"});
  warned(cases[2], {"nothing holds it"});
  const auto found =
      case_warnings(cases, {ended_with(0), ended_with(0), ended_with(3)}, folder_.path());
  ASSERT_EQ(found.kinds.size(), 2U);  // what failed says so itself
  EXPECT_EQ(found.kinds[0].text, "drawn out by 41.5 %");
  EXPECT_EQ(found.kinds[0].case_name, "a");
  EXPECT_EQ(found.kinds[0].num_cases, 2U);
  EXPECT_EQ(found.kinds[1].text, "nothing holds it");
  EXPECT_EQ(found.kinds[1].num_cases, 1U);
  const std::string table = warnings_table(found);
  EXPECT_NE(table.find("| drawn out by 41.5 % | 2 of 3 runs | a |"), std::string::npos) << table;
}

TEST_F(CaseWarnings, AreNoneOfRunsWithoutThemOrWithoutASummary) {
  const std::vector<StudyCase> cases = {case_called("a"), case_called("b")};
  warned(cases[0], {});
  const auto found = case_warnings(cases, {ended_with(0), ended_with(0)}, folder_.path());
  EXPECT_TRUE(found.kinds.empty());
  EXPECT_EQ(warnings_table(found), "");
}

}  // namespace articular::tools::case_warnings_test
