#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "tools/study/study_file.hpp"

/// What a run says, and how far it is from what is right.
namespace articular::tools {

/// Where a run says nothing.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// history.csv of a run. Empty cells are NaN.
struct RunHistory {
  std::vector<std::string> names;            // columns, the first is the time
  std::vector<std::vector<double>> columns;  // as many rows each
};

/// @throws sim::SystemError  when it can't be read
RunHistory read_history(const std::filesystem::path& file);

/// What an output is in a run: one number, or a curve over the time.
struct OutputValue {
  std::vector<double> times;  // [s]; one entry, the end, for a single number
  std::vector<double> values;
};

/// @throws sim::InputError  when the history has no such column: names the nearest
OutputValue output_value(const StudyOutput& output, const RunHistory& history,
                         const std::string& study_file);

/// The largest difference, at the times of `a`; `b` is linear between its times.
double difference(const OutputValue& a, const OutputValue& b);

/// What is right, and how well that is known.
struct ReferenceValue {
  OutputValue value;
  double uncertainty = 0;  // in the column's unit; NaN: unknown, from a single run
  double order = 0;        // observed order of convergence; 0 where none was taken
};

/// From runs with the sizes given, finest first.
///
/// One run: itself. Two: the finer one; uncertainty as if the error were of first order. Three:
/// Richardson's extrapolation with the observed order, and 1.25 times what it adds as uncertainty
/// (grid convergence index, Roache 1994; uneven ratios after Celik et al. 2008). Where the three
/// differ to and fro, or hardly converge (order below 1/2), nothing is extrapolated, and their
/// largest difference is the uncertainty.
ReferenceValue reference_value(std::span<const OutputValue> runs, std::span<const double> sizes);

}  // namespace articular::tools
