#pragma once

#include <vector>

/// What a list of numbers says of the population that they are drawn from. Numbers that are missing
/// (NaN) don't count.
namespace articular::tools {

std::vector<double> known(const std::vector<double>& values);

/// @param values  known(), at least one
double mean_of(const std::vector<double>& values);
/// Standard deviation of the population, with n - 1; 0 of one value.
double sd_of(const std::vector<double>& values);
/// The value below which the share p lies, linear between the sorted values.
double quantile_of(std::vector<double> values, double p);

struct Histogram {
  double lowest = 0, width = 1;  // bin i: from lowest + i * width
  std::vector<int> counts;
};
/// Bins by Freedman and Diaconis (1981): twice the interquartile range over the cube root of n, but
/// 5 to 40 of them.
Histogram histogram_of(const std::vector<double>& values);

/// Spearman's correlation of ranks; NaN where one of them does not vary. Pairs with a missing
/// number don't count.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace articular::tools
