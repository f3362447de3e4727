#include "tools/target_error/error_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/study/observed_order.hpp"

namespace articular::tools {
namespace {

constexpr double kSame = 1 - 1e-9;  // ratios above are 1

/// An observed order confirms the method's if it differs by no more than this part of it.
constexpr double kConfirmed = 0.25;

bool is_varied(const ErrorCourse& course) { return course.points.size() > 1; }

/// By which the error is taken to fall.
double taken_order(const ErrorCourse& course, const DiscretisationError& error) {
  constexpr double kUnknown = 1;
  if (std::isfinite(error.order)) return std::min(error.order, course.formal_order);
  return course.points.size() == 2 ? course.formal_order : std::min(kUnknown, course.formal_order);
}

}  // namespace

DiscretisationError error_of(const ErrorCourse& course) {
  if (!is_varied(course)) return {0, kNoValue, ""};
  const auto finest =
      std::span(course.points).first(std::min<std::size_t>(3, course.points.size()));
  DiscretisationError error = discretisation_error(finest, course.formal_order);
  if (std::abs(error.order - course.formal_order) > kConfirmed * course.formal_order) {
    error.bar *= kDoubtSafety / kGridSafety;
    error.doubt = fmt::format("the method has order {}", course.formal_order);
  }
  return error;
}

double expected_bar(const ErrorCourse& course, double ratio) {
  const DiscretisationError error = error_of(course);
  if (!is_varied(course) || ratio > kSame) return error.bar;
  const double confirmed = course.points.size() == 2 ? kGridSafety / kDoubtSafety : 1;
  return confirmed * error.bar * std::pow(ratio, taken_order(course, error));
}

double expected_change(const ErrorCourse& course, double ratio) {
  if (!is_varied(course) || ratio > kSame) return 0;
  const double order = taken_order(course, error_of(course));
  const SizedValue &fine = course.points[0], &coarse = course.points[1];
  const double error = (fine.value - coarse.value) / (std::pow(coarse.size / fine.size, order) - 1);
  return error * (1 - std::pow(ratio, order));
}

void add_finer_run(std::span<ErrorCourse> courses, std::span<const double> sizes, double change) {
  std::vector<double> shares(courses.size());
  double foretold = 0, sum = 0;
  std::size_t finer = 0;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const double ratio = sizes[i] / courses[i].size();
    shares[i] = expected_change(courses[i], ratio);
    foretold += shares[i];
    sum += std::abs(shares[i]);
    if (is_varied(courses[i]) && ratio <= kSame) ++finer;
  }
  for (std::size_t i = 0; i < courses.size(); ++i) {
    ErrorCourse& course = courses[i];
    if (!is_varied(course) || sizes[i] > kSame * course.size()) continue;
    const double weight = sum > 0 ? std::abs(shares[i]) / sum : 1.0 / static_cast<double>(finer);
    course.points.insert(course.points.begin(), {sizes[i], course.points[0].value + shares[i] +
                                                               weight * (change - foretold)});
  }
}

}  // namespace articular::tools
