#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "tools/error_bars/coarser_runs.hpp"
#include "tools/error_bars/resized_mesh.hpp"

/// What can be made finer in a scenario: element size, step, stiffness of contact, tolerance.
namespace articular::tools {

/// One kind of size, relative to a base run.
struct Refinement {
  /// A run that is coarser than the base, and one that is coarser still; none: this kind is not
  /// varied. One: no order can be seen without finer ones.
  Direction coarser;
  std::vector<double> sizes = {1};  // that a run can have, from the base's down
  /// Overrides for one of these sizes, after those of the base. May make meshes.
  /// @throws sim::InputError  where a command refuses that size
  std::function<std::vector<std::string>(double size)> settings;
  double least_cost_order = 0, most_cost_order = 0;  // bounds of what timing a run may show
};

/// The base run: a scenario with coarser elements and steps than it is written with.
struct RefinementBase {
  std::vector<std::string> overrides;
  std::vector<Refinement> kinds;  // the mesh first, the contact last
};

/// Element sizes of a base, and of a run that is coarser still, relative to the scenario's.
struct MeshLevels {
  double base = 1, coarser = 1;
  double coarsest = 0;        // 0: there is none
  std::vector<double> finer;  // than the base, falling
};

/// Of built-in geometry. With n cells across the thinnest body, meshes have j = 1, 2, ... cells
/// there, and elsewhere as many in proportion: only such j count as leave the others whole within a
/// tenth. The base has about 2n/3, the coarser one about n/2, but not less than 3 and 2. The
/// coarsest one has about n/3, and 3/4 of the coarser one's at most.
/// @param counts  cells along edges of bodies
MeshLevels mesh_levels(const std::vector<int>& counts);

/// Steps that divide the interval between frames, so that steps are cut alike. The first is nearest
/// to twice that of the scenario; they fall to a 32nd of it. [s]
std::vector<double> step_lengths(const sim::Scenario& scenario);

/// @param scenario   as it is written; outlives the result
/// @param overrides  that it was read with
/// @param folder     where meshes go
/// @param coarse     the base is coarser than the scenario; else it is the scenario
/// @throws StudyInterrupted
RefinementBase refinement_base(const sim::Scenario& scenario,
                               const std::vector<std::string>& overrides,
                               const std::filesystem::path& folder, bool coarse);

/// The contact of a base, once it is known whether anything touches. Its size is a depth: it goes
/// with that of elements, over `contact_stiffness_factor`.
Refinement contact_refinement(const sim::Scenario& base, bool anything_touches);

/// Gives the coarser meshes the depths of the base, so that they are not counted with the mesh too.
void keep_depths(Refinement& mesh, const Refinement& contact);

}  // namespace articular::tools
