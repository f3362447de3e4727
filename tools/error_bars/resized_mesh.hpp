#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"
#include "tools/error_bars/made_by.hpp"

/// The meshes of a scene with larger or smaller elements.
namespace articular::tools {

/// A body whose cells are counted in the scenario.
struct GridBody {
  std::string path;         // of its geometry: body."NAME".geometry
  std::vector<int> counts;  // cells along its edges; of a sphere along the radius
  const sim::Body* body;
};

/// A mesh file, and the command that makes it.
struct MadeMesh {
  std::string path;  // body."NAME".mesh.file
  std::string file_name;
  MeshCommand command;
};

/// What of a scene can have other elements. It points into the scenario.
struct VariedMeshes {
  std::vector<GridBody> grids;
  std::vector<MadeMesh> files;
  std::vector<std::string> bodies;       // names of those whose meshes vary
  std::vector<std::string> as_they_are;  // whose meshes count and can't be made again
  bool has_tissue = false;               // among `bodies`
};

/// Every built-in geometry, and every mesh file whose `made_by` is an `articular` command with a
/// --size, of bodies whose mesh has a say: tissue, and surfaces that can touch.
VariedMeshes meshes_of(const sim::Scenario& scenario);

/// Counts by which the rounding of cells is judged: those of tissue, else all.
std::vector<int> judged_counts(const VariedMeshes& meshes);

/// Overrides for elements `factor` times as large as in the scenario. Mesh files are made, in
/// `folder`.
/// @param fresh         makes them again
/// @param[out] failure  what a command says is wrong; "" if nothing is
/// @throws StudyInterrupted
std::vector<std::string> resized_meshes(const VariedMeshes& meshes,
                                        const std::filesystem::path& folder, double factor,
                                        bool fresh, std::string& failure);

/// Size of the cells that this factor leaves after rounding, relative to the scenario's: by the
/// number of cells of tissue (of all bodies, if none is tissue), to the power -1/3.
double cell_size(const VariedMeshes& meshes, double factor);

}  // namespace articular::tools
