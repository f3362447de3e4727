#pragma once

#include <string>

#include "tools/fit/fit.hpp"

namespace articular::tools {

/// What came out, in Markdown: measurements before and after, those held out apart; parameters with
/// widths, and what determines them; which of them can't be told from each other.
std::string fit_text(const Fit& fit, const FitResult& result);

/// The fitted measurements that are missed, in words; "" where none is.
std::string missed_measurements(const Fit& fit, const FitResult& result);

/// A row a measurement: what was measured, its value before and after, misfit in spreads.
std::string measurements_csv(const Fit& fit, const FitResult& result);

/// A row a parameter: start, what is known before, spread, bounds, fitted value, width, share of
/// the data.
std::string parameters_csv(const Fit& fit, const FitResult& result);

/// PATH=VALUE a line, for `articular run --set @FILE`: the parameters, what the first run was told
/// with a parameter in it, and what all runs were told.
std::string fitted_overrides(const Fit& fit, const FitResult& result);

}  // namespace articular::tools
