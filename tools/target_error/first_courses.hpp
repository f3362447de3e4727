#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/target_error/choose_sizes.hpp"
#include "tools/target_error/finer_runs.hpp"
#include "tools/target_error/pilot_runs.hpp"
#include "tools/target_error/wanted_error.hpp"

namespace articular::tools {

/// Where a search begins: a coarse run, and of each kind of size one that is coarser still.
struct FirstCourses {
  RefinementBase base;               // with the contact among its kinds
  RunHistory history;                // of the coarse run
  std::vector<ErrorCourse> courses;  // one a kind
  std::vector<SizeChoice> choices;   // as many
  std::vector<PilotRun> runs;        // without histories, the coarse run first
};

/// The coarse run has larger elements and longer steps than the scenario. Where that can't be run,
/// the scenario as it is takes its place.
/// @param scenario     as it is written; outlives the result
/// @param seconds_left of the budget, now
/// @throws sim::InputError  where the result is nil in the coarse run: before others are run
/// @throws sim::SimulationError  where the scenario can't be run, or not in time
/// @throws StudyInterrupted
FirstCourses first_courses(const sim::Scenario& scenario, const PilotFolder& place,
                           const WantedError& error, const WantedResult& result,
                           const std::function<double()>& seconds_left);

/// What a run tells that is coarser in one kind of size, the others as in the coarse run.
struct CoarserPoint {
  PilotRun run;
  SizedValue point;
  std::string problem;  // why there is no point; "" where there is
};

/// The next coarser run of a kind: the course has the coarse run, and the coarser ones before.
/// @param kind       with a run for it
/// @param time_limit [s]
/// @throws StudyInterrupted
CoarserPoint coarser_point(const PilotFolder& place, const WantedResult& result,
                           const FirstCourses& first, const Refinement& kind,
                           const ErrorCourse& course, double time_limit);

}  // namespace articular::tools
