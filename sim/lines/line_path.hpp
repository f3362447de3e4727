#pragma once

#include <span>

#include "sim/model/configuration.hpp"
#include "sim/model/state.hpp"

/// Where a line that wraps around bodies runs now.
namespace articular::sim {

struct LinePath {
  /// Those of Line::path, and between them where the line bends over edges.
  std::vector<WeightedPoint> points;
  std::vector<WrappedString> strings;  // one between each two points of Line::path
  std::vector<WrapWork> works;         // of each string: its shape
  bool found = true;
};

/// @param history  of this line's strings
void find_path(const Model& model, const Line& line, const Configuration& configuration,
               std::span<const std::vector<EdgeCrossing>> history, LinePath& path);

/// The points of a line, of one that wraps pulled from where it is at the start.
std::vector<WeightedPoint> path_from_start(const Model& model, const Line& line,
                                           const Configuration& configuration);

/// At the start.
WrapHistory initial_wraps(const Model& model);
/// What the next step goes on from.
void keep_wraps(const std::vector<LinePath>& paths, WrapHistory& history);

/// How much of a line lies on bodies [m]: from edge to edge of the same body.
double contact_length(const LinePath& path);

}  // namespace articular::sim
