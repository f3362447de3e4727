#include "tools/target_error/error_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/study/observed_order.hpp"

namespace articular::tools {
namespace {

constexpr double kSame = 1 - 1e-9;  // ratios above are 1

/// An observed order confirms the method's if it is less by no more than this part of it.
constexpr double kConfirmed = 0.25;

/// The order that is taken where none was seen; that of the method, if it is less.
constexpr double kUnseen = 1;

bool is_varied(const ErrorCourse& course) { return course.points.size() > 1; }

/// Observed order of three that converge one way; NaN else.
double order_of(std::span<const SizedValue> f) {
  if (f.size() < 3) return kNoValue;
  const double e21 = f[1].value - f[0].value, e32 = f[2].value - f[1].value;
  if (!(e21 * e32 > 0)) return kNoValue;
  return observed_order(std::abs(e21), std::abs(e32), f[1].size / f[0].size, f[2].size / f[1].size);
}

/// Of three that converge faster than the method does, with the order of the method: by the finer
/// two or the coarser two, whichever is more.
double faster_bar(std::span<const SizedValue> f, double formal) {
  const auto fallen = [&](const SizedValue& fine, const SizedValue& coarse) {
    return std::abs(coarse.value - fine.value) /
           (std::pow(coarse.size / f[0].size, formal) - std::pow(fine.size / f[0].size, formal));
  };
  return kDoubtSafety * std::max(fallen(f[0], f[1]), fallen(f[1], f[2]));
}

/// By which the error is taken to fall.
double taken_order(const ErrorCourse& course, const DiscretisationError& error) {
  if (std::isfinite(error.order)) return std::min(error.order, course.formal_order);
  return course.points.size() == 2 ? course.formal_order : std::min(kUnseen, course.formal_order);
}

}  // namespace

DiscretisationError error_of(const ErrorCourse& course) {
  if (!is_varied(course)) return {0, kNoValue, ""};
  const auto finest =
      std::span(course.points).first(std::min<std::size_t>(3, course.points.size()));
  const double formal = course.formal_order, order = order_of(finest);
  if (finest.size() == 2) return discretisation_error(finest, std::min(kUnseen, formal));
  DiscretisationError error = discretisation_error(finest, formal);
  const std::string doubt = fmt::format("the method has order {}", formal);
  if (order > formal + 1) return {faster_bar(finest, formal), order, doubt};
  if (error.order < (1 - kConfirmed) * formal)
    return {error.bar * kDoubtSafety / kGridSafety, order, doubt};
  return error;
}

double confirmed_bar(const ErrorCourse& course) {
  if (course.points.size() != 2) return error_of(course).bar;
  return kGridSafety / kDoubtSafety * discretisation_error(course.points, course.formal_order).bar;
}

void add_if_it_confirms(ErrorCourse& course, const SizedValue& coarsest) {
  course.points.push_back(coarsest);
  const DiscretisationError error = error_of(course);
  if (!std::isfinite(error.order) || !error.doubt.empty()) course.points.pop_back();
}

double expected_bar(const ErrorCourse& course, double ratio) {
  const DiscretisationError error = error_of(course);
  if (!is_varied(course) || ratio > kSame) return error.bar;
  return confirmed_bar(course) * std::pow(ratio, taken_order(course, error));
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
