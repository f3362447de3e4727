#include "tools/track/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/scenario/curve.hpp"
#include "sim/scenario/name_pattern.hpp"
#include "tools/process/interruption.hpp"
#include "tools/shipped/shipped_scenarios.hpp"
#include "tools/track/least_activation.hpp"

namespace articular::tools {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The sum would not fall by more than this part of it, or than by the square of a thousandth of a
/// spread.
constexpr double kConverged = 3e-3, kNegligible = 1e-6;
/// Where no change of excitations within this helps, there is nothing more to find: contact opens
/// and closes along them.
constexpr double kLeastReach = 1e-4;
/// It has converged all the same where no more than this could be gained: a tenth of a spread a
/// row.
constexpr double kAsGood = 0.01;
/// What a trial has to keep of the fall of the sum that slopes promise, for the next to reach as
/// far, and to reach farther.
constexpr double kKept = 0.1, kKeptWell = 0.5;

bool counts_at(const TrackTarget& target, double t) {
  const std::vector<double>& times = target.value.time;
  const double slack = 1e-9 * (1 + std::abs(t));
  return times.size() == 1 || (t > times.front() - slack && t < times.back() + slack);
}

double wanted_at(const TrackTarget& target, double t) {
  return counts_at(target, t) ? sim::value_at(target.value, t)
                              : std::numeric_limits<double>::quiet_NaN();
}

/// One place that the iteration has come to.
struct Iterate {
  VectorXd excitation;
  TrackTrial trial;
  double sum = 0;  // of squared misfits and effort
};

/// Of the scenario, one an unknown.
std::vector<sim::Curve> own_excitations(const sim::Model& model,
                                        const std::vector<TrackUnknown>& unknowns) {
  std::vector<sim::Curve> own;
  own.reserve(unknowns.size());
  for (const TrackUnknown& unknown : unknowns)
    own.push_back(
        model.muscles[static_cast<std::size_t>(unknown.muscles.front())].given.excitation);
  return own;
}

class Tracker {
 public:
  Tracker(const Track& track, const TrackOptions& options)
      : track_(track),
        options_(options),
        scenario_(sim::read_scenario(find_file_for("run", track.scenario), track.overrides)),
        model_(build()),
        unknowns_(unknowns_of(track, model_)),
        own_(own_excitations(model_, unknowns_)),
        run_(track, scenario_, model_, unknowns_) {
    if (track.look_ahead && model_.is_static)
      throw sim::InputError({track.file.string()},
                            "`look_ahead` is for dynamic scenarios: an equilibrium does not depend "
                            "on what was before");
    const auto n = static_cast<Index>(unknowns_.size());
    lowest_.resize(n), highest_.resize(n), count_.resize(n), start_.resize(n);
    for (Index u = 0; u < n; ++u) {
      const TrackUnknown& unknown = unknowns_[static_cast<std::size_t>(u)];
      lowest_[u] = unknown.given->lowest;
      highest_[u] = unknown.given->highest;
      count_[u] = static_cast<double>(unknown.muscles.size());
      start_[u] = sim::steady_activation(
          model_.muscles[static_cast<std::size_t>(unknown.muscles.front())], 0);
    }
    duration_ = track.duration.value_or(scenario_.duration);
    if (duration_ > scenario_.duration)
      throw sim::InputError({track.file.string()},
                            fmt::format("`duration`: the scenario ends at {:g} s, before {:g} s",
                                        scenario_.duration, duration_));
    for (const TrackTarget& target : track.targets)
      if (target.value.time.size() > 1 && target.value.time.front() >= duration_)
        throw sim::InputError(
            target.where,
            fmt::format("target `{}` begins at {:g} s, when the run of {:g} s is over", target.name,
                        target.value.time.front(), duration_));
    interval_ = track.interval.value_or(model_.is_static ? scenario_.integrator.step
                                                         : scenario_.output.interval);
    for (const TrackTarget& target : track.targets) check_times(target);
  }

  TrackResult go() {
    TrackResult result;
    result.unknowns = unknowns_;
    result.start = start_;
    result.is_static = model_.is_static;
    sim::State state = run_.begin();
    VectorXd excitation = start_;
    try {
      for (double before = 0; before < duration_;) {
        const double time = next_time(before);
        const VectorXd guess = before == 0 ? first_guess(time) : excitation;
        Iterate place = solve(state, {before, time, excitation, guess}, result);
        excitation = place.excitation;
        state = std::move(place.trial.state);
        before = time;
        if (options_.after_point) options_.after_point(result, duration_);
      }
    } catch (const sim::Interruption&) {
      result.interrupted = true;
      result.failure = "interrupted";
    } catch (const sim::SimulationError& error) {
      result.failure = error.what();
    }
    return result;
  }

 private:
  sim::Model build() {
    scenario_.threads = options_.threads;
    // What is sought needs no excitation in the scenario: it is not warned of.
    sim::Scenario driven = scenario_;
    for (sim::Muscle& muscle : driven.muscles)
      for (const TrackMuscle& sought : track_.muscles)
        if (muscle.excitation.time.empty() && sim::fits(sought.name, muscle.name))
          muscle.excitation = {{0}, {0}};
    sim::Model model = sim::build_model(driven);
    for (std::size_t m = 0; m < model.muscles.size(); ++m)
      model.muscles[m].given.excitation = scenario_.muscles[m].excitation;
    if (options_.warn)
      for (const std::string& warning : model.warnings) options_.warn(warning);
    return model;
  }

  /// Multiples of the interval; the last one is the duration, if it is not a tenth of one away.
  double next_time(double t) const {
    const double next = interval_ * (std::floor(t / interval_ + 1e-6) + 1);
    return next > duration_ - 0.1 * interval_ ? duration_ : next;
  }

  /// A target counts somewhere, and does not go on to where the run has long ended.
  void check_times(const TrackTarget& target) const {
    const sim::Curve& curve = target.value;
    if (curve.time.size() < 2) return;
    bool counts = false;
    for (double t = 0; t < duration_ && !counts;) {
      t = next_time(t);
      counts = counts_at(target, t);
    }
    if (!counts)
      throw sim::InputError(
          target.where,
          fmt::format("target `{}` counts from {:g} to {:g} s, and excitations are found every "
                      "{:g} s: at none of these times",
                      target.name, curve.time.front(), curve.time.back(), interval_));
    if (options_.warn && sim::changes_after(curve, duration_))
      options_.warn(sim::prefix(target.where) +
                    fmt::format("target `{}` changes until {:g} s, and the run ends at {:g} s",
                                target.name, curve.time.back(), duration_));
  }

  VectorXd first_guess(double time) const {
    VectorXd guess = start_;
    for (std::size_t u = 0; u < own_.size(); ++u)
      if (!own_[u].time.empty()) guess[static_cast<Index>(u)] = sim::value_at(own_[u], time);
    return guess.cwiseMax(lowest_).cwiseMin(highest_);
  }

  std::vector<double> times_to_look_at(double time) const {
    std::vector<double> times{time};
    if (model_.is_static) return times;
    const double end = std::min(time + track_.look_ahead.value_or(interval_), duration_);
    while (times.back() < end - 1e-9 * interval_) {
      const double next = next_time(times.back());
      if (next > end + 1e-9 * interval_) break;
      times.push_back(next);
    }
    return times;
  }

  /// Misfits in spreads: of all samples, then of what was measured of excitations.
  ActivationProblem problem_at(const Iterate& place, double time) const {
    std::vector<VectorXd> rows;
    std::vector<double> right;
    for (const TrackSample& sample : place.trial.samples)
      for (std::size_t k = 0; k < track_.targets.size(); ++k) {
        const TrackTarget& target = track_.targets[k];
        if (!counts_at(target, sample.time)) continue;
        const auto i = static_cast<Index>(k);
        rows.emplace_back(sample.slopes.row(i).transpose() / target.spread);
        right.push_back(rows.back().dot(place.excitation) -
                        (sample.values[i] - wanted_at(target, sample.time)) / target.spread);
      }
    for (std::size_t u = 0; u < unknowns_.size(); ++u) {
      const TrackMuscle& given = *unknowns_[u].given;
      if (given.emg.time.empty()) continue;
      rows.emplace_back(VectorXd::Unit(place.excitation.size(), static_cast<Index>(u)) /
                        given.emg_spread);
      right.push_back(sim::value_at(given.emg, time) / given.emg_spread);
    }
    ActivationProblem problem;
    // Where nothing counts a row of zeros stands for all.
    problem.A.setZero(std::max<Index>(1, static_cast<Index>(rows.size())), place.excitation.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      problem.A.row(static_cast<Index>(r)) = rows[r].transpose();
    problem.b.setZero(problem.A.rows());
    std::copy(right.begin(), right.end(), problem.b.begin());
    problem.lowest = lowest_;
    problem.highest = highest_;
    problem.count = count_;
    problem.effort = track_.effort;
    return problem;
  }

  double sum_of(const ActivationProblem& problem, const VectorXd& a) const {
    return (problem.A * a - problem.b).squaredNorm() +
           track_.effort * cost_of(track_.cost, a, count_);
  }

  Iterate place_at(const sim::State& state, const Ramp& ramp) {
    Iterate place{ramp.to, run_.go(state, ramp, times_to_look_at(ramp.t_to)), 0};
    place.sum = sum_of(problem_at(place, ramp.t_to), place.excitation);
    return place;
  }

  /// None where the run fails.
  std::optional<Iterate> try_place(const sim::State& state, const Ramp& ramp) {
    try {
      return place_at(state, ramp);
    } catch (const sim::SimulationError&) {
      return std::nullopt;
    }
  }

  void tell(double time, int trial, std::optional<double> sum) const {
    if (options_.after_trial) options_.after_trial(time, trial, sum);
  }

  /// From `here` to where slopes promise the least sum, with no excitation changed by more than
  /// `reach`: nearer, until the sum falls. So what targets determine is mended also where slopes
  /// are wrong along what they do not. @return whether it went
  bool go_on(const sim::State& state, Ramp ramp, const ActivationProblem& problem, double& reach,
             Iterate& here, int& trials) {
    while (reach >= kLeastReach) {
      ActivationProblem near = problem;
      near.lowest = lowest_.cwiseMax((here.excitation.array() - reach).matrix());
      near.highest = highest_.cwiseMin((here.excitation.array() + reach).matrix());
      ramp.to = least_activation(near, track_.cost);
      const double promised = here.sum - sum_of(problem, ramp.to);
      const double way = (ramp.to - here.excitation).lpNorm<Eigen::Infinity>();
      ++trials;
      std::optional<Iterate> place = try_place(state, ramp);
      tell(ramp.t_to, trials, place ? std::optional(place->sum) : std::nullopt);
      const double kept = place ? (here.sum - place->sum) / promised : 0;
      reach = kept > kKeptWell ? std::min(1.0, 2 * reach) : kept > kKept ? reach : 0.25 * way;
      if (!(kept > 0)) continue;
      here = std::move(*place);
      return true;
    }
    return false;
  }

  /// @param ramp  to the first guess
  Iterate solve(const sim::State& state, const Ramp& ramp, TrackResult& result) {
    const double time = ramp.t_to;
    TrackPoint point;
    point.time = time;
    point.trials = 1;
    Iterate here = place_at(state, ramp);
    tell(time, point.trials, here.sum);
    double reach = 1;
    for (int k = 0;; ++k) {
      const ActivationProblem problem = problem_at(here, time);
      const double promised = here.sum - sum_of(problem, least_activation(problem, track_.cost));
      // Without any slope nothing is promised, and nothing known.
      const bool is_blind = problem.A.isZero(0) && !problem.b.isZero(0);
      point.converged = !is_blind && promised <= kConverged * here.sum + kNegligible;
      if (point.converged || is_blind || k == options_.most_iterations) break;
      if (go_on(state, ramp, problem, reach, here, point.trials)) continue;
      point.converged = promised <= kAsGood * static_cast<double>(problem.A.rows());
      break;
    }
    describe(here, point);
    result.points.push_back(std::move(point));
    return here;
  }

  void describe(const Iterate& place, TrackPoint& point) const {
    const TrackSample& sample = place.trial.samples.front();
    point.excitation = place.excitation;
    point.got = sample.values;
    point.wanted.resize(point.got.size());
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < track_.targets.size(); ++k) {
      const auto i = static_cast<Index>(k);
      point.wanted[i] = wanted_at(track_.targets[k], point.time);
      if (!std::isfinite(point.wanted[i])) continue;
      const double off = (point.got[i] - point.wanted[i]) / track_.targets[k].spread;
      sum += off * off;
      ++count;
    }
    point.misfit = count > 0 ? std::sqrt(sum / count) : 0;
    point.response_error = place.trial.response_error;
    const ActivationProblem problem = problem_at(place, point.time);
    // A number of which only the bounds are known is spread evenly between them.
    const VectorXd spreads = (highest_ - lowest_) / std::sqrt(12.0);
    point.determination = determine(problem.A, spreads, problem.A * place.excitation - problem.b);
    for (std::size_t c = 0; c < kTrackCosts.size(); ++c) {
      point.by_cost[c] = kTrackCosts[c] == track_.cost ? place.excitation
                                                       : least_activation(problem, kTrackCosts[c]);
      const VectorXd off = problem.A * point.by_cost[c] - problem.b;
      point.misfit_by_cost[c] =
          off.size() > 0 ? std::sqrt(off.squaredNorm() / static_cast<double>(off.size())) : 0;
    }
  }

  const Track& track_;
  const TrackOptions& options_;
  sim::Scenario scenario_;
  sim::Model model_;
  std::vector<TrackUnknown> unknowns_;
  std::vector<sim::Curve> own_;  // excitations of the scenario: the first guess
  TrackRun run_;
  VectorXd lowest_, highest_, count_, start_;
  double duration_ = 0, interval_ = 0;  // [s]
};

}  // namespace

TrackResult track_excitations(const Track& track, const TrackOptions& options) {
  return Tracker(track, options).go();
}

}  // namespace articular::tools
