#include "tools/target_error/choose_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace articular::tools {
namespace {

/// All combinations: some thousand.
std::vector<ChosenSizes> combinations(std::span<const ErrorCourse> courses,
                                      std::span<const SizeChoice> choices, double seconds) {
  std::vector<ChosenSizes> all{{{}, 0, seconds}};
  for (std::size_t i = 0; i < courses.size(); ++i) {
    std::vector<ChosenSizes> longer;
    for (const double size : choices[i].sizes) {
      const double ratio = size / courses[i].size();
      const double bar = expected_bar(courses[i], ratio);
      const double cost = std::pow(ratio, -choices[i].cost_order);
      for (const ChosenSizes& shorter : all) {
        longer.push_back(shorter);
        longer.back().sizes.push_back(size);
        longer.back().bar += bar;
        longer.back().seconds *= cost;
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

void drop_close_sizes(const ErrorCourse& course, SizeChoice& choice) {
  constexpr double kApart = 1.3 - 1e-9;
  std::erase_if(choice.sizes, [&](double size) {
    return size != course.size() && size * kApart > course.size();
  });
}

std::optional<ChosenSizes> cheapest_sizes(std::span<const ErrorCourse> courses,
                                          std::span<const SizeChoice> choices, double seconds,
                                          double goal) {
  std::optional<ChosenSizes> best;
  for (const ChosenSizes& tried : combinations(courses, choices, seconds))
    if (tried.bar <= goal &&
        (!best || std::tie(tried.seconds, tried.bar) < std::tie(best->seconds, best->bar)))
      best = tried;
  return best;
}

std::optional<ChosenSizes> best_sizes_within(std::span<const ErrorCourse> courses,
                                             std::span<const SizeChoice> choices, double seconds,
                                             double limit) {
  std::optional<ChosenSizes> best;
  for (const ChosenSizes& tried : combinations(courses, choices, seconds))
    if (tried.seconds <= limit &&
        (!best || std::tie(tried.bar, tried.seconds) < std::tie(best->bar, best->seconds)))
      best = tried;
  return best;
}

}  // namespace articular::tools
