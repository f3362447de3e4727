#include "tools/target_error/reach_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/output/probe_columns.hpp"
#include "sim/output/results_folder.hpp"
#include "tools/process/interruption.hpp"
#include "tools/process/this_program.hpp"
#include "tools/target_error/first_courses.hpp"
#include "tools/target_error/kept_runs.hpp"
#include "tools/target_error/target_report.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Overrides = std::vector<std::string>;

/// Of the goal: what is aimed at, so that an estimate that comes out a little worse still meets it.
constexpr double kAim = 0.7;
constexpr int kMostRuns = 4;

/// Of the estimate: a part that is less is not worth a run of its own.
constexpr double kCounts = 0.1;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of history.csv, without running: those of the probes, and sizes of forces.
std::vector<std::string> columns_of(const sim::Scenario& scenario, const sim::Model& model) {
  RunHistory history{{"time [s]"}, {}};
  for (const sim::ProbeModel& probe : model.probes)
    for (const std::string& name : sim::column_names(probe, scenario.output.length_unit))
      history.names.push_back(name);
  history.columns.assign(history.names.size(), {0});
  add_force_sizes(history);
  return {history.names.begin() + 1, history.names.end()};
}

/// "PATH" of "PATH=VALUE"; a name in quotes may hold an equals sign.
std::string key_of(const std::string& text) {
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') is_quoted = !is_quoted;
    if (text[i] == '=' && !is_quoted) return text.substr(0, i);
  }
  return text;
}

/// What counts of overrides: the last one for each path.
Overrides last_of_each_key(const Overrides& all) {
  Overrides last;
  for (auto text = all.rbegin(); text != all.rend(); ++text)
    if (std::none_of(last.begin(), last.end(),
                     [&](const std::string& other) { return key_of(other) == key_of(*text); }))
      last.push_back(*text);
  std::reverse(last.begin(), last.end());
  return last;
}

/// ": mesh 0.02, step 0.004"; "" where there is no error.
std::string parts_behind(const std::vector<ErrorCourse>& courses) {
  const std::string parts = parts_text(courses);
  return parts.empty() ? "" : ": " + parts;
}

class TargetSearch {
 public:
  TargetSearch(const sim::Scenario& scenario, const TargetSettings& settings)
      : scenario_(scenario),
        settings_(settings),
        folder_(fs::absolute(settings.directory / "target-error")) {
    record_.wanted = wanted_error(settings.error);
  }

  TargetOutcome reach() {
    start();
    see_orders();
    TargetOutcome outcome;
    for (int runs = 0; runs == 0 || record_.bar > record_.goal.error; ++runs) {
      const std::optional<Plan> plan = next_plan();
      if (!plan || plan->chosen.seconds > seconds_left() || runs == kMostRuns) {
        outcome.refusal = refusal(plan);
        break;
      }
      outcome.exit_code = run_plan(*plan);
      if (outcome.exit_code != 0) return outcome;
      see_orders();
    }
    if (!has_run_) return outcome;
    record_.is_met = outcome.refusal.empty();
    if (!KeptRun(folder_, record_.overrides).is_in(settings_.directory))
      outcome.exit_code = settings_.run(record_.overrides, false, interruption_asked);
    if (outcome.exit_code != 0) return outcome;
    const fs::path summary = settings_.directory / "summary.json";
    sim::write_text_file(summary, summary_with_target(text_of(summary), record_));
    outcome.text = target_text(record_);
    return outcome;
  }

 private:
  void say(const std::string& text) const {
    if (!settings_.quiet) fmt::print(stderr, "articular: target error: {}\n", text);
  }

  double seconds_left() const { return settings_.budget - seconds_since(start_); }

  void start() {
    const sim::Model model = sim::build_model(scenario_);
    record_.result = wanted_result(settings_.of, columns_of(scenario_, model));
    const sim::ResultsFolder lock(settings_.directory);
    open_kept_runs(folder_, sim::fingerprint(scenario_, model) + identity(this_program()));
    place_ = {scenario_.file,         folder_,        settings_.overrides, settings_.threads,
              scenario_.reproducible, settings_.quiet};
    say(fmt::format("first coarse runs, to see how the error of {} falls",
                    name_of(record_.result)));
    first_ = first_courses(scenario_, place_, record_.wanted, record_.result,
                           [&] { return seconds_left(); });
    for (const PilotRun& run : first_.runs)
      record_.trials.push_back({run.name, run.failure, run.seconds});
    record_.courses = first_.courses;
    record_.kinds = first_.base.kinds;
    seconds_ = first_.runs[0].seconds;
    take(first_.history);
    if (const std::string left_out = left_out_text(record_.kinds); !left_out.empty())
      say(fmt::format("not in the estimate: {}", left_out));
    say(fmt::format("the coarse run has {:.6g} ± {:.2g}, that is {}{}", record_.value, record_.bar,
                    error_text(record_.bar, record_), parts_behind(record_.courses)));
    refuse_without_estimate();
  }

  void take(const RunHistory& history) {
    record_.goal = error_goal(record_.wanted, record_.result, history);
    record_.value = quantity_value(history, record_.result.column, record_.result.quantity);
    record_.bar = bar_of(record_.courses);
  }

  void refuse_without_estimate() const {
    const auto is_varied = [](const ErrorCourse& course) { return course.points.size() > 1; };
    if (!std::any_of(record_.courses.begin(), record_.courses.end(), is_varied))
      throw sim::SimulationError(
          fmt::format("nothing of this scenario can be varied, so its error can't be estimated: {}",
                      left_out_text(record_.kinds)));
  }

  /// Where the target is met if the method's orders are those of the scene, a third, coarser run
  /// of each kind tells whether they are. It costs less than a finer one. One that does not confirm
  /// the order may be too coarse for it, and says nothing.
  void see_orders() {
    if (bar_if_confirmed(record_.courses) > record_.goal.error) return;
    const double counts = kCounts * record_.bar;
    for (std::size_t i = 0; i < record_.courses.size(); ++i) {
      ErrorCourse& course = record_.courses[i];
      const bool can_be_seen =
          course.points.size() == 2 && record_.kinds[i].coarser.runs.size() > 1;
      if (!can_be_seen || error_of(course).bar < counts || seconds_left() <= 0) continue;
      const CoarserPoint coarser =
          coarser_point(place_, record_.result, first_, record_.kinds[i], course, seconds_left());
      record_.trials.push_back({coarser.run.name, coarser.run.failure, coarser.run.seconds});
      if (coarser.problem.empty()) add_if_it_confirms(course, coarser.point);
    }
    const double before = std::exchange(record_.bar, bar_of(record_.courses));
    if (record_.bar < before)
      say(fmt::format("coarser runs confirm the order: ± {:.2g}, that is {}{}", record_.bar,
                      error_text(record_.bar, record_), parts_behind(record_.courses)));
  }

  struct Plan {
    ChosenSizes chosen;
    Overrides overrides;  // after those of the scenario
  };

  /// The cheapest sizes that meet the goal and whose meshes can be made; none: no sizes do.
  std::optional<Plan> next_plan() {
    while (true) {
      const auto chosen =
          cheapest_sizes(record_.courses, first_.choices, seconds_, kAim * record_.goal.error);
      if (!chosen) return {};
      try {
        return Plan{*chosen, overrides_of(*chosen)};
      } catch (const sim::InputError& error) {
        say(fmt::format("elements of that size can't be had: {}", error.what()));
        const double refused = chosen->sizes[0];
        std::erase_if(first_.choices[0].sizes, [&](double size) { return size <= refused; });
      }
    }
  }

  Overrides overrides_of(const ChosenSizes& chosen) const {
    std::vector<double> sizes = chosen.sizes;
    sizes.back() /= sizes.front();  // depths of contact shrink with elements by themselves
    Overrides all = first_.base.overrides;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (sizes[i] == 1 || !record_.kinds[i].settings) continue;
      for (const std::string& text : record_.kinds[i].settings(sizes[i])) all.push_back(text);
    }
    return last_of_each_key(all);
  }

  int run_plan(const Plan& plan) {
    say(fmt::format("chosen, for {} in about {}: {}", error_text(plan.chosen.bar, record_),
                    duration_text(plan.chosen.seconds), fmt::join(plan.overrides, "  ")));
    const KeptRun kept(folder_, plan.overrides);
    if (!kept.is_finished()) {
      const Clock::time_point start = Clock::now();
      const bool goes_on = kept.is_begun();
      kept.begin();
      const int exit_code = settings_.run(
          plan.overrides, goes_on, [&] { return interruption_asked() || seconds_left() <= 0; });
      if (exit_code == kInterruptedExitCode && !interruption_asked())
        throw sim::SimulationError(end_of_budget(plan, seconds_since(start)));
      if (exit_code != 0) return exit_code;
      kept.keep(settings_.directory, seconds_since(start));
    }
    has_run_ = true;
    record_.overrides = plan.overrides;
    record_.trials.push_back({"chosen", "", kept.seconds()});
    seconds_ = kept.seconds();
    const RunHistory history = kept.history();
    add_finer_run(
        record_.courses, plan.chosen.sizes,
        quantity_value(history, record_.result.column, record_.result.quantity) - record_.value);
    take(history);
    for (std::size_t i = 0; i < first_.choices.size(); ++i)
      drop_close_sizes(record_.courses[i], first_.choices[i]);
    say(fmt::format("the run has {:.6g} ± {:.2g}, that is {}{}", record_.value, record_.bar,
                    error_text(record_.bar, record_), parts_behind(record_.courses)));
    return 0;
  }

  std::string end_of_budget(const Plan& plan, double seconds) const {
    std::string text = fmt::format(
        "--budget {} is over: the run of the chosen settings was to take about {}, and was stopped "
        "after {}; the same command with --resume and more time goes on",
        duration_text(settings_.budget), duration_text(plan.chosen.seconds),
        duration_text(seconds));
    if (has_run_)
      text += fmt::format("; a run before it had {} with {}", error_text(record_.bar, record_),
                          fmt::join(record_.overrides, "  "));
    return text;
  }

  std::string refusal(const std::optional<Plan>& plan) const {
    const double left = std::max(0.0, seconds_left());
    std::string text =
        fmt::format("{} of {} can't be had", record_.wanted.text, name_of(record_.result));
    if (plan && plan->chosen.seconds > left)
      text += fmt::format(" in --budget {}: it would take about {} more",
                          duration_text(settings_.budget), duration_text(plan->chosen.seconds));
    else if (plan)
      text += fmt::format(": after {} runs the estimate still is {}", kMostRuns,
                          error_text(record_.bar, record_));
    else
      text += " with any settings that can be chosen";
    const auto best = best_sizes_within(record_.courses, first_.choices, seconds_, left);
    if (best && (best->bar < record_.bar || !has_run_))
      text += fmt::format("; about {} can be had in {} more", error_text(best->bar / kAim, record_),
                          duration_text(best->seconds));
    if (has_run_) text += fmt::format("; the results have {}", error_text(record_.bar, record_));
    return text;
  }

  const sim::Scenario& scenario_;
  const TargetSettings& settings_;
  fs::path folder_;
  Clock::time_point start_ = Clock::now();
  PilotFolder place_;
  FirstCourses first_;
  TargetRecord record_;
  double seconds_ = 0;    // of the finest run
  bool has_run_ = false;  // beside the coarse ones
};

}  // namespace

TargetOutcome reach_target(const sim::Scenario& scenario, const TargetSettings& settings) {
  return TargetSearch(scenario, settings).reach();
}

}  // namespace articular::tools
