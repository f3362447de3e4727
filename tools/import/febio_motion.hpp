#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "tools/import/scenario_draft.hpp"

namespace articular::tools {

/// What moves along or about each axis; none: it is held.
using Drive = std::array<std::optional<FebioValue>, 6>;

/// What a motion moves: a body or a support.
struct Moved {
  std::string_view kind;
  std::string name;
  std::optional<Eigen::Vector3d> about;  // a fixed body turns about it
  bool has_mass = false;                 // in time that can't follow a velocity that jumps
  int line = 0;                          // in the model
};

/// A load of the kind "motion", unless nothing moves.
void add_motion(ScenarioDraft& draft, const Moved& moved, const Drive& drive);

/// A prescribed value at a time; 0 if there is none.
double value_of(const ScenarioDraft& draft, const std::optional<FebioValue>& value, double t);

}  // namespace articular::tools
