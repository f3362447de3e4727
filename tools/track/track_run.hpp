#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "sim/output/history.hpp"
#include "sim/run/course.hpp"
#include "tools/track/track_file.hpp"

/// The scenario of a track, run over short times with other excitations.
namespace articular::tools {

/// Muscles that share one excitation, which is sought.
struct TrackUnknown {
  std::string name;          // of the muscle, or the pattern of several
  std::vector<int> muscles;  // indices into Model::muscles
  std::vector<std::string> muscle_names;
  const TrackMuscle* given{};  // of Track::muscles
};

/// Each muscle belongs to the first entry that fits it.
/// @throws sim::InputError  where an entry fits no muscle
std::vector<TrackUnknown> unknowns_of(const Track& track, const sim::Model& model);

/// Excitations go from `from` at t_from to `to` at t_to, and stay there; one an unknown.
struct Ramp {
  double t_from = 0, t_to = 0;
  Eigen::VectorXd from, to;
};

/// What targets show at one time, and how that depends on Ramp::to.
struct TrackSample {
  double time = 0;
  Eigen::VectorXd values;  // in the columns' units
  Eigen::MatrixXd slopes;  // targets x unknowns
};

struct TrackTrial {
  std::vector<TrackSample> samples;  // one a time
  sim::State state;                  // at the first of them
  double response_error = 0;         // see sim::StateResponse
};

class TrackRun {
 public:
  /// The excitations of the model are set by trials. @throws sim::InputError  where a target names
  /// no column, or columns of different units
  TrackRun(const Track& track, const sim::Scenario& scenario, sim::Model& model,
           const std::vector<TrackUnknown>& unknowns);

  /// The start, where bodies that overlapped are set apart.
  sim::State begin();
  /// From a state along a ramp to each of the times, which increase.
  /// @throws sim::SimulationError, sim::Interruption
  TrackTrial go(const sim::State& start, const Ramp& ramp, const std::vector<double>& times);

 private:
  void set_excitations(const Ramp& ramp);
  double next_event(double t, double target) const;
  Eigen::MatrixXd excitation_change(const Ramp& ramp, double t) const;
  Eigen::VectorXd values_now(const sim::State& state);
  TrackSample sample(const sim::State& state, const sim::StateResponse& response);

  const Track& track_;
  sim::Model& model_;
  const std::vector<TrackUnknown>& unknowns_;
  sim::Course course_;
  sim::History history_;
  std::vector<double> kinks_;
  sim::Schedule frames_;
  std::vector<std::vector<std::size_t>> columns_;  // of each target, in the history
};

}  // namespace articular::tools
