#include "tools/target_error/first_courses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

using Overrides = std::vector<std::string>;

Overrides joined_lists(Overrides all, const Overrides& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

bool anything_touches(const std::filesystem::path& results) {
  const auto summary = nlohmann::json::parse(text_of(results / "summary.json"));
  return summary.at("counts").at("reported_pairs") > 0;
}

/// Steps of mean length, relative to those of another run: they are cut at events.
double step_size(const RunHistory& history, const RunHistory& other) {
  return static_cast<double>(other.columns[0].size() - 1) /
         static_cast<double>(std::max<std::size_t>(2, history.columns[0].size()) - 1);
}

class CoarseRuns {
 public:
  CoarseRuns(const sim::Scenario& scenario, const PilotFolder& place, const WantedError& error,
             const WantedResult& result, const std::function<double()>& seconds_left)
      : scenario_(scenario),
        place_(place),
        error_(error),
        result_(result),
        seconds_left_(seconds_left) {}

  FirstCourses run() {
    base_run_ = run_base();
    error_goal(error_, result_, base_run_.history);
    first_.history = base_run_.history;
    first_.runs.push_back(without_history(base_run_));
    const sim::Scenario base =
        sim::read_scenario(scenario_.file, joined_lists(place_.overrides, first_.base.overrides));
    first_.base.kinds.push_back(
        contact_refinement(base, anything_touches(results_of(place_, base_run_))));
    for (Refinement& kind : first_.base.kinds) add_course(kind);
    return std::move(first_);
  }

 private:
  static PilotRun without_history(PilotRun run) {
    run.history = {};
    return run;
  }

  double result_of(const RunHistory& history) const {
    return quantity_value(history, result_.column, result_.quantity);
  }

  PilotRun run_one(const std::string& name, const Overrides& overrides) const {
    constexpr double kLeast = 1;  // [s], for what says that there is no time
    PilotRun run{name, overrides};
    run_pilot(place_, std::max(kLeast, seconds_left_()), run);
    if (!run.failure.empty() && seconds_left_() <= 0)
      throw sim::SimulationError(fmt::format(
          "--budget: the time is up in the run `{}`, and no finer one would take less; give more "
          "(coarse runs that are done are kept)",
          name));
    return run;
  }

  PilotRun run_base() {
    PilotRun run;
    for (const bool coarse : {true, false}) {
      first_.base =
          refinement_base(scenario_, place_.overrides, place_.folder / "prepared", coarse);
      run = run_one(coarse ? "coarse" : "as written", first_.base.overrides);
      if (run.failure.empty()) return run;
    }
    throw sim::SimulationError(
        fmt::format("neither a coarser run nor the scenario as written succeeds: {}", run.failure));
  }

  /// Runs what is coarser than the base, and begins a course with it.
  void add_course(Refinement& kind) {
    Direction& direction = kind.coarser;
    first_.courses.push_back(
        {direction.name, direction.formal_order, {{1, result_of(base_run_.history)}}});
    first_.choices.push_back({{1}, 0});
    if (direction.runs.empty()) return;
    const CoarserRun& planned = direction.runs[0];
    const PilotRun run =
        run_one(planned.name, joined_lists(first_.base.overrides, planned.overrides));
    first_.runs.push_back(without_history(run));
    const std::string problem = problem_of(run, planned);
    if (!problem.empty()) {
      direction.left_out += (direction.left_out.empty() ? "" : "; ") + problem;
      return;
    }
    const double size = planned.size > 0 ? planned.size : step_size(run.history, base_run_.history);
    first_.courses.back().points.push_back({size, result_of(run.history)});
    first_.choices.back() = {kind.sizes,
                             std::clamp(std::log(base_run_.seconds / run.seconds) / std::log(size),
                                        kind.least_cost_order, kind.most_cost_order)};
    drop_close_sizes(first_.courses.back(), first_.choices.back());
  }

  /// Why a coarser run says nothing; "" where it does.
  std::string problem_of(const PilotRun& run, const CoarserRun& planned) const {
    constexpr double kLonger = 1.05;
    if (!run.failure.empty())
      return fmt::format("the coarser run `{}` failed: {}", run.name, run.failure);
    if (!std::isfinite(result_of(run.history)))
      return fmt::format("the coarser run `{}` has no such value", run.name);
    if (planned.size == 0 && step_size(run.history, base_run_.history) < kLonger)
      return "events cut the steps, which are no longer in the coarser run";
    return "";
  }

  const sim::Scenario& scenario_;
  const PilotFolder& place_;
  const WantedError& error_;
  const WantedResult& result_;
  const std::function<double()>& seconds_left_;
  FirstCourses first_;
  PilotRun base_run_;
};

}  // namespace

FirstCourses first_courses(const sim::Scenario& scenario, const PilotFolder& place,
                           const WantedError& error, const WantedResult& result,
                           const std::function<double()>& seconds_left) {
  return CoarseRuns(scenario, place, error, result, seconds_left).run();
}

}  // namespace articular::tools
