#pragma once

#include <set>
#include <string>
#include <vector>

#include "sim/scenario/toml_document.hpp"

/// What curves of a scenario's document are hardly meant to be.
namespace articular::sim {

/// Names that an `excitation` or a `profile` mentions, each of which may be that of a curve.
std::set<std::string> named_curves(const Node& root);

/// Curves of [curve] that nothing names. @return  one line each, with its place
std::vector<std::string> unnamed_curve_doubts(const Node& root, const std::set<std::string>& named);

/// Tables of `time` and values, those of [curve] that are named among them, whose values change
/// after the end of the run. The document has to be valid.
/// @param duration  [s]
/// @return          one line each, with its place
std::vector<std::string> cut_off_doubts(const Node& root, double duration);

}  // namespace articular::sim
