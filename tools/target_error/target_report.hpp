#pragma once

#include <string>
#include <vector>

#include "tools/target_error/choose_sizes.hpp"
#include "tools/target_error/finer_runs.hpp"
#include "tools/target_error/wanted_error.hpp"

namespace articular::tools {

/// All that is told of a run with a target.
struct TargetRecord {
  WantedError wanted;
  WantedResult result;
  ErrorGoal goal;  // of the last run
  double value = 0;
  double bar = 0;
  bool is_met = false;
  std::vector<ErrorCourse> courses;
  std::vector<Refinement> kinds;       // as many
  std::vector<std::string> overrides;  // by which the run differs from the scenario
  struct Trial {
    std::string name, failure;
    double seconds = 0;
  };
  std::vector<Trial> trials;  // in their order; the last one that was chosen has the results
};

/// Sum of the bars of all kinds.
double bar_of(const std::vector<ErrorCourse>& courses);

/// The same, if a third run of each kind with two were to confirm the method's order.
double bar_if_confirmed(const std::vector<ErrorCourse>& courses);

/// "mesh 0.02, step 0.004": the parts that count.
std::string parts_text(const std::vector<ErrorCourse>& courses);

/// What of the error is not in the estimate; "" if nothing is known to be left out.
std::string left_out_text(const std::vector<Refinement>& kinds);

/// An error as a share of the scale, "1.3 %", where there is one, else with the column's unit.
std::string error_text(double error, const TargetRecord& record);

/// For the terminal, after the names of the files.
std::string target_text(const TargetRecord& record);

/// summary.json with `target_error`.
std::string summary_with_target(const std::string& summary, const TargetRecord& record);

/// 75 s as "75 s", 4000 s as "67 min", ...
std::string duration_text(double seconds);

}  // namespace articular::tools
