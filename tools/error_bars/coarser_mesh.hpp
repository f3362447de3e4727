#pragma once

#include <filesystem>
#include <optional>

#include "tools/error_bars/coarser_runs.hpp"

/// A scenario again with coarser elements.
namespace articular::tools {

/// `articular anatomy ...` or `articular mesh ...` of `made_by`, with another element size and
/// another place.
struct MeshCommand {
  std::vector<std::string> words;  // after `articular`; variables in them are replaced
  std::size_t size_word = 0;       // "--size 1.2": the number of the word with the number
  std::size_t out_word = 0;
};

/// Reads `made_by`. None where it is another command, or one that names no --size or --out.
std::optional<MeshCommand> mesh_command(const std::string& made_by);

/// The arguments for elements `factor` times as large, with the results in
/// ${ARTICULAR_PREPARED}.
std::vector<std::string> coarser_arguments(const MeshCommand& command, double factor);

/// By what two coarser meshes of these cells are coarser, so that few counts are rounded much:
/// of a few pairs, each ratio between 4/3 and 2.
/// @param counts  cells along edges of bodies
std::pair<double, double> coarsening_of(const std::vector<int>& counts);

/// Every built-in geometry with fewer cells, and every mesh file whose `made_by` is an `articular`
/// command with a --size made again by it. Sizes are told by the number of elements of tissue (of
/// all bodies that are made coarser, if none is tissue), to the power -1/3.
/// @param folder  where the meshes of commands go
/// @param fresh   makes them again
/// @throws StudyInterrupted
Direction coarser_meshes(const sim::Scenario& scenario, const std::vector<std::string>& overrides,
                         const std::filesystem::path& folder, bool fresh);

}  // namespace articular::tools
