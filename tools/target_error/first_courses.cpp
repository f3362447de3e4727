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

double result_of(const RunHistory& history, const WantedResult& result) {
  return quantity_value(history, result.column, result.quantity);
}

PilotRun without_history(PilotRun run) {
  run.history = {};
  return run;
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
    keep_depths(first_.base.kinds.front(), first_.base.kinds.back());
    for (Refinement& kind : first_.base.kinds) add_course(kind);
    return std::move(first_);
  }

 private:
  PilotRun run_base() {
    PilotRun run;
    for (const bool coarse : {true, false}) {
      first_.base =
          refinement_base(scenario_, place_.overrides, place_.folder / "prepared", coarse);
      run = {coarse ? "coarse" : "as written", first_.base.overrides};
      run_pilot(place_, time_limit(), run);
      if (run.failure.empty()) return run;
      refuse_if_time_is_up(run);
    }
    throw sim::SimulationError(
        fmt::format("neither a coarser run nor the scenario as written succeeds: {}", run.failure));
  }

  double time_limit() const {
    constexpr double kLeast = 1;  // [s], for what says that there is no time
    return std::max(kLeast, seconds_left_());
  }

  void refuse_if_time_is_up(const PilotRun& run) const {
    if (!run.failure.empty() && seconds_left_() <= 0)
      throw sim::SimulationError(fmt::format(
          "--budget: the time is up in the run `{}`, and no finer one would take less; give more "
          "(coarse runs that are done are kept)",
          run.name));
  }

  /// Runs what is coarser than the base, and begins a course with it.
  void add_course(Refinement& kind) {
    Direction& direction = kind.coarser;
    first_.courses.push_back(
        {direction.name, direction.formal_order, {{1, result_of(base_run_.history, result_)}}});
    first_.choices.push_back({{1}, 0});
    if (direction.runs.empty()) return;
    ErrorCourse& course = first_.courses.back();
    const CoarserPoint coarser = coarser_point(place_, result_, first_, kind, course, time_limit());
    refuse_if_time_is_up(coarser.run);
    first_.runs.push_back(coarser.run);
    if (!coarser.problem.empty()) {
      direction.left_out += (direction.left_out.empty() ? "" : "; ") + coarser.problem;
      return;
    }
    course.points.push_back(coarser.point);
    const double cost_order =
        std::log(base_run_.seconds / coarser.run.seconds) / std::log(coarser.point.size);
    first_.choices.back() = {kind.sizes,
                             std::clamp(cost_order, kind.least_cost_order, kind.most_cost_order)};
    drop_close_sizes(course, first_.choices.back());
  }

  const sim::Scenario& scenario_;
  const PilotFolder& place_;
  const WantedError& error_;
  const WantedResult& result_;
  const std::function<double()>& seconds_left_;
  FirstCourses first_;
  PilotRun base_run_;
};

/// Why a coarser run says nothing; "" where it does.
/// @param size  that of the next finer run
std::string problem_of(const PilotRun& run, const SizedValue& point, double size) {
  constexpr double kLonger = 1.05;
  if (!run.failure.empty())
    return fmt::format("the coarser run `{}` failed: {}", run.name, run.failure);
  if (!std::isfinite(point.value))
    return fmt::format("the coarser run `{}` has no such value", run.name);
  if (point.size < kLonger * size)
    return "events cut the steps, which are no longer in the coarser run";
  return "";
}

}  // namespace

CoarserPoint coarser_point(const PilotFolder& place, const WantedResult& result,
                           const FirstCourses& first, const Refinement& kind,
                           const ErrorCourse& course, double time_limit) {
  const CoarserRun& planned = kind.coarser.runs[course.points.size() - 1];
  PilotRun run{planned.name, joined_lists(first.base.overrides, planned.overrides)};
  run_pilot(place, time_limit, run);
  SizedValue point;
  if (run.failure.empty())
    point = {planned.size > 0 ? planned.size : step_size(run.history, first.history),
             result_of(run.history, result)};
  return {without_history(run), point, problem_of(run, point, course.points.back().size)};
}

FirstCourses first_courses(const sim::Scenario& scenario, const PilotFolder& place,
                           const WantedError& error, const WantedResult& result,
                           const std::function<double()>& seconds_left) {
  return CoarseRuns(scenario, place, error, result, seconds_left).run();
}

}  // namespace articular::tools
