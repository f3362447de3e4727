#include "tools/study/study_cases.hpp"

#include <gtest/gtest.h>

#include <set>

#include "sim/base/error.hpp"

namespace articular::study_cases_test {

using namespace tools;

Study study_of(std::size_t knobs, std::size_t choices) {
  Study study;
  study.every_combination = true;
  for (std::size_t k = 0; k < knobs; ++k) {
    study.knobs.push_back({"k" + std::to_string(k), {}});
    for (std::size_t c = 0; c < choices; ++c)
      study.knobs.back().choices.push_back({std::to_string(c), {}});
  }
  return study;
}

TEST(StudyCases, EveryCombinationIsACaseOfItsOwn) {
  const std::vector<StudyCase> cases = study_cases(study_of(3, 4));
  ASSERT_EQ(cases.size(), 64U);
  std::set<std::string> folders;
  for (const StudyCase& c : cases) folders.insert(c.folder);
  EXPECT_EQ(folders.size(), 64U);
}

// 10^20 of them would take the memory before the first one runs.
TEST(StudyCases, MoreThanAnybodyCouldRunAreRefused) {
  for (const std::size_t knobs : {5U, 20U, 1000U})
    EXPECT_THROW(study_cases(study_of(knobs, 10)), sim::InputError);
}

TEST(StudyCases, NamesThatFoldersCannotTellApartGetNumbers) {
  Study study = study_of(0, 0);
  study.extras = {{"a b", {}}, {"a*b", {}}, {"A_b", {}}, {"a_b-2", {}}};
  const std::vector<StudyCase> cases = study_cases(study);
  ASSERT_EQ(cases.size(), 5U);
  EXPECT_EQ(cases[1].folder, "a_b");
  EXPECT_EQ(cases[2].folder, "a_b-2");
  EXPECT_EQ(cases[3].folder, "A_b-3");
  EXPECT_EQ(cases[4].folder, "a_b-2-2");
}

}  // namespace articular::study_cases_test
