#pragma once

#include <string>
#include <vector>

#include "tools/fit/fit.hpp"

/// What a fit is worth for what it has not seen: each group of its measurements is left out in
/// turn, the rest is fitted, and the group is compared with what comes out.
namespace articular::tools {

/// Of one group, the roots of the mean squares of its misfits, in spreads.
struct LeftOut {
  std::string group;
  int measurements = 0;
  double at_start = 0;
  double fitted = 0;    // by the fit to all
  double left_out = 0;  // by the fit to the others
  bool converged = false;
};

/// Before any work.
/// @throws sim::InputError  where no measurement that is fitted has a group, or one group has all
void check_groups(const Fit& fit);

/// One fit a group. What they have in common with the fit to all is not run again.
/// @param fit    with groups that are checked
/// @param whole  the fit to all
/// @throws what fit_parameters throws
std::vector<LeftOut> cross_validate(const Fit& fit, const FitResult& whole, int most_iterations,
                                    const StudyRunOptions& options);

/// A table in Markdown, with its heading.
std::string cross_validation_text(const std::vector<LeftOut>& groups);

/// A row a group.
std::string cross_validation_csv(const std::vector<LeftOut>& groups);

}  // namespace articular::tools
