// What a study takes for right, and which cases it calls worth their time.
#include "tools/study/study_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/error.hpp"
#include "tests/sim/support/temporary_folder.hpp"
#include "tools/study/study_assessment.hpp"

namespace articular::tools::study_values_test {

OutputValue number(double value) { return {{1}, {value}}; }

/// exact + slope * h^order at the sizes.
ReferenceValue from_law(double exact, double slope, double order, std::vector<double> sizes) {
  std::vector<OutputValue> runs;
  runs.reserve(sizes.size());
  for (const double h : sizes) runs.push_back(number(exact + slope * std::pow(h, order)));
  return reference_value(runs, sizes);
}

TEST(StudyReference, ThreeRunsExtrapolateAPowerLawExactly) {
  for (const double order : {0.7, 1.0, 2.0, 3.3})
    for (const double slope : {-0.3, 2.0})
      for (const auto& sizes : {std::vector<double>{1, 2, 4}, std::vector<double>{0.5, 0.8, 2}}) {
        const ReferenceValue reference = from_law(5, slope, order, sizes);
        EXPECT_NEAR(reference.order, order, 1e-9);
        EXPECT_NEAR(reference.value.values[0], 5, 1e-9);
        // 1.25 times what it adds, which here is the finest run's error.
        EXPECT_NEAR(reference.uncertainty, 1.25 * std::abs(slope) * std::pow(sizes[0], order),
                    1e-9);
      }
}

TEST(StudyReference, RunsThatGoToAndFroAreNotExtrapolated) {
  const ReferenceValue reference = reference_value(std::vector{number(1), number(1.1), number(0.7)},
                                                   std::vector<double>{1, 2, 4});
  EXPECT_EQ(reference.value.values[0], 1);
  EXPECT_EQ(reference.order, 0);
  EXPECT_NEAR(reference.uncertainty, 0.4, 1e-15);
}

TEST(StudyReference, RunsThatHardlyConvergeAreNotExtrapolated) {
  const ReferenceValue reference =
      reference_value(std::vector{number(1), number(2), number(3)}, std::vector<double>{1, 2, 4});
  EXPECT_EQ(reference.value.values[0], 1);
  EXPECT_EQ(reference.order, 0);
  EXPECT_EQ(reference.uncertainty, 1);
}

TEST(StudyReference, EqualRunsAreRightAndKnown) {
  const ReferenceValue reference = from_law(5, 0, 1, {1, 2, 4});
  EXPECT_EQ(reference.value.values[0], 5);
  EXPECT_EQ(reference.uncertainty, 0);
}

TEST(StudyReference, TwoRunsCountAsFirstOrder) {
  const ReferenceValue reference = from_law(5, 1, 1, {1, 3});
  EXPECT_NEAR(reference.value.values[0], 6, 1e-15);
  EXPECT_NEAR(reference.uncertainty, 1, 1e-15);
}

TEST(StudyReference, OneRunSaysNothingOfItsUncertainty) {
  EXPECT_TRUE(std::isnan(from_law(5, 1, 1, {1}).uncertainty));
}

// Curves whose errors fall with the square of the step, sampled at other times each.
TEST(StudyReference, HistoriesAreExtrapolatedAtEachTime) {
  const auto curve = [](double h, int samples) {
    OutputValue value;
    for (int i = 0; i <= samples; ++i) {
      const double t = static_cast<double>(i) / samples;
      value.times.push_back(t);
      value.values.push_back((1 + h * h) * t);  // linear, so that samples between are exact
    }
    return value;
  };
  const ReferenceValue reference = reference_value(
      std::vector{curve(0.1, 40), curve(0.2, 20), curve(0.4, 10)}, std::vector<double>{1, 2, 4});
  EXPECT_NEAR(reference.order, 2, 1e-9);
  EXPECT_LT(difference(reference.value, curve(0, 7)), 1e-12);
}

TEST(StudyOutput, TakesWhatItIsAskedForAndNamesWhatIsNotThere) {
  const TemporaryFolder folder;
  const RunHistory history = read_history(
      folder.file("history.csv", "time [s],tip.z [mm],gap [mm]\n0,1,\n1,-3,\n3,2,5\n"));
  const auto value = [&](StudyValue what) {
    return output_value({"tip", "tip.z [mm]", what, {}, {}}, history, "s.toml").values.back();
  };
  EXPECT_EQ(value(StudyValue::Last), 2);
  EXPECT_EQ(value(StudyValue::Change), 1);
  EXPECT_EQ(value(StudyValue::Largest), 2);
  EXPECT_EQ(value(StudyValue::Smallest), -3);
  EXPECT_NEAR(value(StudyValue::Mean), (-1 - 1) / 3.0, 1e-15);  // trapezia of 1 s and 2 s
  EXPECT_EQ(output_value({"gap", "gap [mm]", StudyValue::Mean, {}, {}}, history, "").values[0], 5);
  try {
    output_value({"tip", "tip.z [m]", StudyValue::Last, {}, {}}, history, "s.toml");
    ADD_FAILURE() << "no error";
  } catch (const sim::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "s.toml: output `tip`: history.csv has no column `tip.z [m]`; did you mean `tip.z "
                 "[mm]`?");
  }
}

/// A study of one output whose exact value is 1, with cases of these times and values.
class FrontTest : public testing::Test {
 protected:
  void add(double time, double value) {
    const std::string name = "case " + std::to_string(cases_.size());
    cases_.push_back({name, std::to_string(cases_.size()), {}});
    records_.push_back({{{ProgramUse::End::Exited, 0, time, 0, 0}}, ""});
    const auto results = results_of(folder_.path(), cases_.back());
    std::filesystem::create_directories(results);
    std::ofstream(results / "history.csv") << "time [s],x [mm]\n1," << value << "\n";
  }

  Assessment assessed() {
    study_.outputs = {{"x", "x [mm]", StudyValue::Last, {}, 1.0}};
    return assess(study_, cases_, records_, folder_.path(), false);
  }

  TemporaryFolder folder_;
  Study study_;
  std::vector<StudyCase> cases_;
  std::vector<CaseRecord> records_;
};

TEST_F(FrontTest, HoldsWhatNothingElseBeatsInTimeAndError) {
  add(4, 1.02);  // 0: the nearest
  add(1, 1.2);   // 1: the fastest
  add(3, 1.1);   // 2: beaten by 3
  add(2, 0.95);  // 3
  add(5, 1.02);  // 4: as near as 0, later
  const Assessment assessment = assessed();
  EXPECT_EQ(front(assessment), (std::vector<std::size_t>{1, 3, 0}));
  EXPECT_EQ(assessment.cases[2].better, 3);
  EXPECT_EQ(assessment.cases[4].better, 0);
  EXPECT_NEAR(assessment.cases[3].error, 0.05, 1e-12);
}

TEST_F(FrontTest, AFailedCaseIsNotOnIt) {
  add(4, 1.02);
  add(1, 1.0);
  records_[1].runs[0].code = 3;
  const Assessment assessment = assessed();
  EXPECT_EQ(front(assessment), std::vector<std::size_t>{0});
  EXPECT_TRUE(std::isnan(assessment.cases[1].error));
}

TEST_F(FrontTest, AHundredthNearerIsNotNearer) {
  add(1, 1.2);
  add(2, 1.199);  // 1: as near as 0
  add(3, 1.195);  // 2: nearer than 0, though hardly than 1
  const Assessment assessment = assessed();
  EXPECT_EQ(front(assessment), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(assessment.cases[1].better, 0);
}

// Nearer than the reference is known does not count as nearer.
TEST_F(FrontTest, ErrorsBelowTheUncertaintyAreEqual) {
  add(1, 1.001);
  add(2, 1.0);
  add(3, 1.01);  // references: 1.01 and 1.02, an uncertainty of 0.01
  add(3, 1.02);
  cases_[2].reference = 0;
  cases_[3].reference = 1;
  study_.references = {{1, {}}, {2, {}}};
  study_.outputs = {{"x", "x [mm]", StudyValue::Last, {}, {}}};
  const Assessment assessment = assess(study_, cases_, records_, folder_.path(), false);
  EXPECT_NEAR(assessment.uncertainty, 0.01 / 1.01, 1e-12);
  EXPECT_EQ(front(assessment), std::vector<std::size_t>{0});
}

}  // namespace articular::tools::study_values_test
