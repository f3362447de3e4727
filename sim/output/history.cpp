#include "sim/output/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "sim/output/probe_columns.hpp"

namespace articular::sim {
namespace {

/// Of forces: what is left of them where they act across a direction, in equilibrium.
constexpr double kRoundOff = 1e-6;

}  // namespace

History::History(const Model& model, LengthUnit unit)
    : model_(model), unit_(std::move(unit)), columns_{"time [s]"} {
  for (const ProbeModel& probe : model.probes)
    for (auto& name : column_names(probe, unit_)) columns_.push_back(name);
}

void History::record(const State& state, const Stepper& stepper) {
  values_.assign(1, state.t);
  std::vector<std::size_t> begin;  // of each probe's columns
  for (const ProbeModel& probe : model_.probes) {
    begin.push_back(values_.size());
    append_values(probe, model_, unit_, state, stepper, values_);
  }
  for (std::size_t p = 0; p < model_.probes.size(); ++p)
    if (const auto* share = std::get_if<ObservedShare>(&model_.probes[p].what))
      values_[begin[p]] = share_of(*share, begin);
  fmt::format_to(std::back_inserter(rows_), "{:.12g}", state.t);
  for (std::size_t i = 1; i < values_.size(); ++i) {
    rows_ += ',';
    if (!std::isnan(values_[i])) fmt::format_to(std::back_inserter(rows_), "{:.9g}", values_[i]);
  }
  rows_ += '\n';
}

/// Of the row so far, in which each probe with a force begins with it.
double History::share_of(const ObservedShare& share, const std::vector<std::size_t>& begin) const {
  const auto force = [&](int probe) {
    return Eigen::Map<const Vec3>(&values_[begin[static_cast<std::size_t>(probe)]]);
  };
  const auto along = [&](const std::vector<int>& probes) {
    double sum = 0;
    for (const int p : probes) sum += force(p).dot(share.direction);
    return sum;
  };
  double size = 0;
  for (const int p : share.whole) size += force(p).norm();
  const double whole = along(share.whole);
  const bool is_nothing = !(std::abs(whole) > kRoundOff * size);
  return is_nothing ? std::numeric_limits<double>::quiet_NaN() : along(share.part) / whole;
}

std::string History::header() const { return fmt::format("{}\n", fmt::join(columns_, ",")); }

}  // namespace articular::sim
