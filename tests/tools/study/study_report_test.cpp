// What a study says of its cases.
#include "tools/study/study_report.hpp"

#include <gtest/gtest.h>

namespace articular::tools::study_report_test {

// Two halvings for 16 times the time cost 4 times each. Where an error is hardly less for twice the
// time, the formula has 2^139.
TEST(StudyReport, TheFrontHasWhatAHalvingOfTheErrorCosts) {
  const std::pair<double, double> time_and_error[] = {{1, 0.08}, {16, 0.02}, {32, 0.0199}};
  std::vector<StudyCase> cases;
  Assessment assessment;
  for (const auto& [time, error] : time_and_error) {
    cases.push_back({});
    cases.back().name = std::to_string(cases.size());
    CaseAssessment& mine = assessment.cases.emplace_back();
    mine.time = time;
    mine.error = error;
    mine.on_front = true;
  }
  CaseRecord done;
  done.runs.push_back({});
  const std::string text =
      study_text({}, cases, std::vector<CaseRecord>(cases.size(), done), assessment);
  EXPECT_NE(text.find("| 1 | 8 % | 1 |  |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| 2 | 2 % | 16 | 4 |\n"), std::string::npos) << text;
  EXPECT_NE(text.find("| 3 | 1.99 % | 32 | more than 100 |\n"), std::string::npos) << text;
}

}  // namespace articular::tools::study_report_test
