#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/fit/determination.hpp"
#include "tools/track/track_run.hpp"

/// Excitations from motions and forces.
namespace articular::tools {

inline constexpr std::array kTrackCosts{TrackCost::Squares, TrackCost::Cubes, TrackCost::Largest};

/// What was found at one time.
struct TrackPoint {
  double time = 0;
  Eigen::VectorXd excitation;   // one an unknown
  Eigen::VectorXd wanted, got;  // one a target, in its unit; wanted: NaN where it does not count
  double misfit = 0;            // root of the mean square of those that count, in spreads
  Determination determination;  // of the excitations, with what their bounds say before
  /// For each of kTrackCosts what it would have led to, by the responses at the solution.
  std::array<Eigen::VectorXd, 3> by_cost;
  std::array<double, 3> misfit_by_cost{};
  int trials = 0;  // runs from the time before
  bool converged = false;
  double response_error = 0;  // see sim::StateResponse
};

struct TrackResult {
  std::vector<TrackUnknown> unknowns;
  Eigen::VectorXd start;           // excitations at 0 s
  std::vector<TrackPoint> points;  // as far as it came
  bool is_static = false, interrupted = false;
  std::string failure;  // why it came no further; empty: it is done
};

struct TrackOptions {
  int threads = 1;
  int most_iterations = 10;  // of each time
  std::function<void(const TrackResult&, double duration)> after_point;
  /// @param sum  that is made least; none: the run failed
  std::function<void(double time, int trial, std::optional<double> sum)> after_trial;
  std::function<void(const std::string&)> warn;  // of the scenario
};

/// Goes through the times of a track. At each, Gauss-Newton's iteration within bounds finds the
/// excitations with the least sum of squared misfits, in spreads, and effort times cost; each of
/// its trials starts from the time before.
/// @throws sim::InputError
TrackResult track_excitations(const Track& track, const TrackOptions& options);

}  // namespace articular::tools
