#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "tools/study/study_values.hpp"

/// A scenario again with coarser steps, stiffness of contact and tolerance: one thing at a time.
namespace articular::tools {

/// A run that differs from the scenario in one setting.
struct CoarserRun {
  std::string name;                         // "step 2 times"
  std::vector<std::string> overrides = {};  // of `run --set`, after those of the scenario
  double size = 0;                          // relative to the scenario's; 0: the run itself tells
  std::string failure = {};                 // why there are no results, "" where there are
  RunHistory history = {};                  // once it has run
};

/// What is made coarser.
struct Direction {
  std::string name;                   // "mesh", "step", "contact", "tolerance"
  double formal_order = 1;            // of the error in `size`
  std::vector<CoarserRun> runs = {};  // from finer to coarser; none: the next two say why
  std::string left_out = {};          // what of this error is not in the bar, and why; "": nothing
  std::string remark = {};            // what a reader has to know of it; "": nothing
  int wanted_runs = 2;     // with fewer than two no order can be seen, nor is it asked for
  bool is_needed = false;  // without its part there is no bar: the others would promise too much
};

/// Steps twice and four times as long, with frames and restart points as much rarer, so that steps
/// are cut alike. In statics twice alone: equilibrium does not know by which steps it was found,
/// and longer ones take many iterations. The scheme `explicit` chooses its steps by its tolerance,
/// which is made larger.
Direction coarser_steps(const sim::Scenario& scenario);

/// Averaged depths in time: contact three and nine times as soft, an error of first order in
/// 1 / contact_stiffness_factor.
/// @param anything_touches  whether bodies came near each other in the run
Direction softer_contact(const sim::Scenario& scenario, bool anything_touches);

/// Overrides for Newton's tolerance, or that of the scheme `explicit`, `factor` times as large.
std::vector<std::string> looser_tolerance(const sim::Integrator& integrator, double factor);

/// Newton's tolerance ten times as large.
Direction looser_iteration(const sim::Scenario& scenario);

/// Whether a body is in a pair that can touch.
bool can_touch(const sim::Scenario& scenario, const sim::Body& body);

}  // namespace articular::tools
