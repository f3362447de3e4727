#include "tools/track/track_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/output/history_column.hpp"
#include "sim/scenario/name_pattern.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<std::size_t> columns_of(const TrackTarget& target,
                                    const std::vector<std::string>& known) {
  const auto unit = [](const std::string& column) { return sim::history_column(column).unit; };
  std::vector<std::size_t> indices;
  for (const std::string& name : target.columns) {
    const auto found = std::find(known.begin() + 1, known.end(), name);
    if (found == known.end())
      throw sim::InputError(target.where, fmt::format("no probe of the scenario shows `{}`{}", name,
                                                      sim::suggestion(name, known)));
    if (unit(name) != unit(target.columns.front()))
      throw sim::InputError(target.where, fmt::format("columns `{}` and `{}` have different units",
                                                      target.columns.front(), name));
    indices.push_back(static_cast<std::size_t>(found - known.begin()));
  }
  return indices;
}

/// The model, with constant excitations where they are sought: kinks are then those of others.
sim::Model& with_own_start(sim::Model& model, const std::vector<TrackUnknown>& unknowns) {
  for (const TrackUnknown& unknown : unknowns)
    for (const int m : unknown.muscles) {
      sim::MuscleModel& muscle = model.muscles[static_cast<std::size_t>(m)];
      const double start = std::clamp(sim::steady_activation(muscle, 0), unknown.given->lowest,
                                      unknown.given->highest);
      muscle.given.excitation = {{0}, {start}};
    }
  return model;
}

}  // namespace

std::vector<TrackUnknown> unknowns_of(const Track& track, const sim::Model& model) {
  std::vector<char> taken(model.muscles.size(), 0);
  std::vector<std::string> names;
  for (const sim::MuscleModel& muscle : model.muscles) names.push_back(muscle.given.name);
  std::vector<TrackUnknown> unknowns;
  for (const TrackMuscle& given : track.muscles) {
    std::vector<int> fitting;
    for (std::size_t m = 0; m < names.size(); ++m) {
      if (taken[m] != 0 || !sim::fits(given.name, names[m])) continue;
      taken[m] = 1;
      fitting.push_back(static_cast<int>(m));
    }
    if (fitting.empty())
      throw sim::InputError(given.where,
                            fmt::format("the scenario has no muscle `{}` that an "
                                        "entry before does not name{}",
                                        given.name, sim::suggestion(given.name, names)));
    const auto name_of = [&](int m) { return names[static_cast<std::size_t>(m)]; };
    if (given.together) {
      TrackUnknown& unknown = unknowns.emplace_back(TrackUnknown{given.name, fitting, {}, &given});
      for (const int m : fitting) unknown.muscle_names.push_back(name_of(m));
    } else {
      for (const int m : fitting) unknowns.push_back({name_of(m), {m}, {name_of(m)}, &given});
    }
  }
  return unknowns;
}

TrackRun::TrackRun(const Track& track, const sim::Scenario& scenario, sim::Model& model,
                   const std::vector<TrackUnknown>& unknowns)
    : track_(track),
      model_(with_own_start(model, unknowns)),
      unknowns_(unknowns),
      course_(scenario, model),
      history_(model, scenario.output.length_unit),
      kinks_(sim::kink_times(model, scenario.duration)),
      frames_{scenario.output.interval} {
  for (const TrackTarget& target : track.targets)
    columns_.push_back(columns_of(target, history_.columns()));
  course_.set_stop(interruption_asked);
}

sim::State TrackRun::begin() {
  course_.begin();
  course_.set_apart();
  return course_.state();
}

void TrackRun::set_excitations(const Ramp& ramp) {
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    for (const int m : unknowns_[u].muscles)
      model_.muscles[static_cast<std::size_t>(m)].given.excitation = {
          {ramp.t_from, ramp.t_to},
          {ramp.from[static_cast<Index>(u)], ramp.to[static_cast<Index>(u)]}};
}

/// Where `run` would end a step, too.
double TrackRun::next_event(double t, double target) const {
  const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), t * (1 + 1e-12));
  return std::min({target, frames_.next(t), kink == kinks_.end() ? target : *kink});
}

Eigen::MatrixXd TrackRun::excitation_change(const Ramp& ramp, double t) const {
  Eigen::MatrixXd change =
      Eigen::MatrixXd::Zero(model_.layout.num_muscles, static_cast<Index>(unknowns_.size()));
  const double part = std::clamp((t - ramp.t_from) / (ramp.t_to - ramp.t_from), 0.0, 1.0);
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    for (const int m : unknowns_[u].muscles) change(m, static_cast<Index>(u)) = part;
  return change;
}

VectorXd TrackRun::values_now(const sim::State& state) {
  history_.record(state, course_.stepper());
  history_.take_rows();
  VectorXd values = VectorXd::Zero(static_cast<Index>(columns_.size()));
  for (std::size_t k = 0; k < columns_.size(); ++k)
    for (const std::size_t column : columns_[k])
      values[static_cast<Index>(k)] += history_.last()[column];
  return values;
}

TrackSample TrackRun::sample(const sim::State& state, const sim::StateResponse& response) {
  TrackSample sample;
  sample.time = state.t;
  sample.values = values_now(state);
  for (Index k = 0; k < sample.values.size(); ++k)
    if (!std::isfinite(sample.values[k]))
      throw sim::SimulationError(
          fmt::format("target `{}` shows nothing at {:g} s, as where nothing touches",
                      track_.targets[static_cast<std::size_t>(k)].name, state.t));
  sample.slopes.resize(sample.values.size(), static_cast<Index>(unknowns_.size()));
  sim::Stepper& stepper = course_.stepper();
  for (Index u = 0; u < sample.slopes.cols(); ++u) {
    const sim::NearbyStates nearby = sim::nearby_states(model_, state.y, response, u);
    stepper.look_at(state, nearby.above);
    sample.slopes.col(u) = values_now(state);
    stepper.look_at(state, nearby.below);
    sample.slopes.col(u) -= values_now(state);
    sample.slopes.col(u) /= nearby.apart;
  }
  stepper.look_at(state, state.y);
  return sample;
}

TrackTrial TrackRun::go(const sim::State& start, const Ramp& ramp,
                        const std::vector<double>& times) {
  set_excitations(ramp);
  sim::Stepper& stepper = course_.stepper();
  sim::State state = start;
  stepper.restart(state);
  sim::StateResponse response = sim::no_response(model_, static_cast<Index>(unknowns_.size()));
  TrackTrial trial;
  for (const double time : times) {
    while (state.t < time) {
      stepper.step(state, next_event(state.t, time));
      if (model_.is_static && state.t < time) continue;  // equilibria forget
      if (!stepper.follow(state, excitation_change(ramp, state.t), response))
        throw sim::SimulationError(fmt::format(
            "at {:g} s Newton's matrix can't be solved: nothing holds some body against "
            "a motion",
            state.t));
    }
    if (trial.samples.empty()) trial.state = state;
    trial.samples.push_back(sample(state, response));
  }
  trial.response_error = response.error;
  return trial;
}

}  // namespace articular::tools
