// How errors are taken to fall, and which sizes follow, on laws that are known.
#include "tools/target_error/error_course.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/target_error/choose_sizes.hpp"

namespace articular::tools::error_course_test {

/// exact + slope h^order at these sizes.
ErrorCourse course_of(double formal, double slope, double order, const std::vector<double>& sizes) {
  ErrorCourse course{"mesh", formal, {}};
  for (const double h : sizes) course.points.push_back({h, 5 + slope * std::pow(h, order)});
  return course;
}

double change_of(double slope, double order, double from, double to) {
  return slope * (std::pow(to, order) - std::pow(from, order));
}

TEST(ErrorCourse, OfOneRunHasNoError) {
  const ErrorCourse course{"contact", 1, {{1, 7}}};
  EXPECT_EQ(error_of(course).bar, 0);
  EXPECT_EQ(expected_bar(course, 1), 0);
  EXPECT_EQ(expected_change(course, 1), 0);
}

// Two runs have a safety factor of 3 and no order above 1; a third one is to confirm the method's.
TEST(ErrorCourse, ExpectsWhatTheMethodsOrderSays) {
  const ErrorCourse course = course_of(2, 0.3, 2, {1, 1.5});
  EXPECT_NEAR(expected_bar(course, 1), 3 * 0.3 * (1.5 * 1.5 - 1) / 0.5, 1e-12);
  EXPECT_NEAR(expected_bar(course, 0.5), 1.25 * 0.3 / 4, 1e-12);
  EXPECT_NEAR(expected_change(course, 0.5), change_of(0.3, 2, 1, 0.5), 1e-12);
}

TEST(ErrorCourse, ExpectsNoMoreThanTheOrderThatWasSeen) {
  const ErrorCourse slow = course_of(2, -0.3, 1, {1, 1.5, 2});
  EXPECT_NEAR(expected_bar(slow, 0.25), 3 * 0.3 / 4, 1e-6);
  EXPECT_NEAR(expected_change(slow, 0.25), change_of(-0.3, 1, 1, 0.25), 1e-6);
}

// From 3/4 of the method's order to one more. Beyond it the method's order is taken.
TEST(ErrorCourse, HasTheSmallSafetyFactorForTheMethodsOrderOnly) {
  for (const auto& [order, safety] : {std::pair{2.0, 1.25}, {1.6, 1.25}, {1.4, 3.0}})
    EXPECT_NEAR(error_of(course_of(2, 0.3, order, {1, 1.5, 2})).bar, safety * 0.3, 1e-6) << order;
  const DiscretisationError next = error_of(course_of(2, 0.3, 2.8, {1, 2, 4}));
  EXPECT_NEAR(next.bar, 1.25 * 0.3 * (std::pow(2, 2.8) - 1) / 3, 1e-6);
  EXPECT_EQ(next.doubt, "");
  const DiscretisationError fast = error_of(course_of(2, 0.3, 3.2, {1, 2, 4}));
  EXPECT_NEAR(fast.bar, 3 * 0.3 * (std::pow(4, 3.2) - std::pow(2, 3.2)) / 12, 1e-6);
  EXPECT_EQ(fast.doubt, "the method has order 2");
}

// a h + b h^2: the finer two, with order 1, say more than the error, and less than four times it.
TEST(ErrorCourse, WithANextTermIsCovered) {
  for (const double next : {0.1, 1.0, 10.0}) {
    ErrorCourse course{"step", 1, {}};
    for (const double h : {1.0, 2.0, 4.0}) course.points.push_back({h, h + next * h * h});
    const double error = 1 + next, bar = error_of(course).bar;
    EXPECT_GT(bar, error) << next;
    EXPECT_LT(bar, 4 * error) << next;
  }
}

// The finest two nearly agree by chance: what the coarser two say counts.
TEST(ErrorCourse, ThatFallsTooFastIsNoBetterThanForetold) {
  const ErrorCourse course{"mesh", 2, {{1, 5.0001}, {2, 5}, {4, 4.4}}};
  EXPECT_NEAR(error_of(course).bar, 3 * 0.6 / 12, 1e-9);
}

// Two have a safety factor of 3, and order 1 at most.
TEST(ErrorCourse, OfTwoIsLessOnceACoarserThirdConfirmsTheOrder) {
  ErrorCourse course = course_of(2, 0.3, 2, {1, 1.5});
  const SizedValue coarsest{3, 5 + 0.3 * 9};
  EXPECT_NEAR(confirmed_bar(course), 1.25 * 0.3, 1e-12);
  add_if_it_confirms(course, coarsest);
  ASSERT_EQ(course.points.size(), 3U);
  EXPECT_NEAR(error_of(course).bar, 1.25 * 0.3, 1e-6);
}

// Slower, too fast, to and fro: the third may be too coarse.
TEST(ErrorCourse, OfTwoStaysWhereACoarserThirdShowsAnotherOrder) {
  for (const double value : {5 + 0.3 * 2.7, 5 + 0.3 * 60, 5.0}) {
    ErrorCourse course = course_of(2, 0.3, 2, {1, 1.5});
    const double bar = error_of(course).bar;
    add_if_it_confirms(course, {3, value});
    EXPECT_EQ(course.points.size(), 2U) << value;
    EXPECT_EQ(error_of(course).bar, bar) << value;
  }
}

// What was expected comes true: the bar is as it was foretold.
TEST(ErrorCourse, AFinerRunThatIsAsExpectedHasTheExpectedBar) {
  std::vector<ErrorCourse> courses{course_of(2, 0.3, 2, {1, 1.5}), course_of(1, -0.1, 1, {1, 2})};
  const double expected = expected_bar(courses[0], 0.5) + expected_bar(courses[1], 0.25);
  add_finer_run(courses, std::vector<double>{0.5, 0.25},
                change_of(0.3, 2, 1, 0.5) + change_of(-0.1, 1, 1, 0.25));
  EXPECT_NEAR(error_of(courses[0]).bar + error_of(courses[1]).bar, expected, 1e-9);
  EXPECT_NEAR(error_of(courses[0]).order, 2, 1e-6);
  EXPECT_EQ(courses[1].size(), 0.25);
}

// The method's order was not that of the scene: the next estimate shows it.
TEST(ErrorCourse, AnOrderThatIsNotAsItWasTakenIsSeenInTheNextRun) {
  std::vector<ErrorCourse> courses{course_of(2, 0.3, 1, {1, 1.5}),
                                   ErrorCourse{"step", 1, {{1, 5}}}};
  add_finer_run(courses, std::vector<double>{0.5, 1}, change_of(0.3, 1, 1, 0.5));
  EXPECT_NEAR(error_of(courses[0]).order, 1, 1e-6);
  EXPECT_NEAR(error_of(courses[0]).bar, 3 * 0.3 / 2, 1e-6);
  EXPECT_EQ(courses[1].points.size(), 1U);
}

TEST(ErrorCourse, OfAKindThatStaysAsItIsIsNotTouched) {
  std::vector<ErrorCourse> courses{course_of(2, 0.3, 2, {1, 1.5}), course_of(1, -0.1, 1, {1, 2})};
  add_finer_run(courses, std::vector<double>{0.5, 1}, change_of(0.3, 2, 1, 0.5));
  EXPECT_EQ(courses[0].points.size(), 3U);
  EXPECT_EQ(courses[1].points.size(), 2U);
}

/// Mesh with an error of 0.3 at size 1, steps with one of 0.01.
const std::vector<ErrorCourse> kCourses{course_of(2, 0.3, 2, {1, 1.5, 2}),
                                        course_of(1, 0.01, 1, {1, 2, 4})};
const std::vector<SizeChoice> kChoices{{{1, 0.5, 0.25, 0.125}, 3}, {{1, 0.5, 0.25}, 1}};

TEST(ChosenSizes, AreTheCheapestThatMeetTheGoal) {
  const auto chosen = cheapest_sizes(kCourses, kChoices, 10, 0.125);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->sizes, (std::vector<double>{0.5, 1}));
  EXPECT_NEAR(chosen->seconds, 80, 1e-9);
  EXPECT_NEAR(chosen->bar, 1.25 * (0.3 / 4 + 0.01), 1e-6);
  // A little less: half of the step is cheaper than half of the elements.
  EXPECT_EQ(cheapest_sizes(kCourses, kChoices, 10, 0.105)->sizes, (std::vector<double>{0.5, 0.5}));
}

TEST(ChosenSizes, AreThoseOfTheFinestRunWhereItMeetsTheGoal) {
  EXPECT_EQ(cheapest_sizes(kCourses, kChoices, 10, 1)->sizes, (std::vector<double>{1, 1}));
}

// 1.25 times as fine is as good as no change at all to see an order by.
TEST(ChosenSizes, AreNotCloseToThoseOfTheFinestRun) {
  SizeChoice choice{{2, 1, 0.8, 0.75, 0.5}, 3};
  drop_close_sizes(kCourses[0], choice);
  EXPECT_EQ(choice.sizes, (std::vector<double>{1, 0.75, 0.5}));
}

TEST(ChosenSizes, AreNoneWhereTheGoalIsOutOfReach) {
  EXPECT_FALSE(cheapest_sizes(kCourses, kChoices, 10, 1e-4));
  EXPECT_FALSE(best_sizes_within(kCourses, kChoices, 10, 9));
}

TEST(ChosenSizes, WithinATimeHaveTheLeastError) {
  const auto chosen = best_sizes_within(kCourses, kChoices, 10, 100);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->sizes, (std::vector<double>{0.5, 1}));
}

}  // namespace articular::tools::error_course_test
