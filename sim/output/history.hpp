#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/base/length_unit.hpp"
#include "sim/step/stepper.hpp"

namespace articular::sim {

/// The rows of history.csv: first column `time [s]`, then one column a probe value with its unit. A
/// place where nothing is (NaN) is an empty cell: plots and spreadsheets leave a gap there, while a
/// number would draw a line to it.
class History {
 public:
  History(const Model& model, LengthUnit unit);

  void record(const State& state, const Stepper& stepper);
  /// The file's first line.
  std::string header() const;
  /// Those recorded since the last call.
  std::string take_rows() { return std::exchange(rows_, {}); }

  std::size_t num_pending_bytes() const { return rows_.size(); }

  const std::vector<std::string>& columns() const { return columns_; }
  /// The values of the last record(), one a column.
  const std::vector<double>& last() const { return values_; }

 private:
  double share_of(const ObservedShare& share, const std::vector<std::size_t>& begin) const;

  const Model& model_;
  LengthUnit unit_;
  std::vector<std::string> columns_;
  std::vector<double> values_;
  std::string rows_;
};

}  // namespace articular::sim
