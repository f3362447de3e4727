#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tools/error_bars/coarser_runs.hpp"

/// A scenario again with coarser elements.
namespace articular::tools {

/// By what two coarser meshes of these cells are coarser, so that few counts are rounded much:
/// of a few pairs, each ratio between 4/3 and 2.
/// @param counts  cells along edges of bodies
std::pair<double, double> coarsening_of(const std::vector<int>& counts);

/// Every built-in geometry with fewer cells, and every mesh file whose `made_by` is an `articular`
/// command with a --size made again by it. Sizes are told by the number of elements of tissue (of
/// all bodies that are made coarser, if none is tissue), to the power -1/3. Where there is tissue
/// and none of it can be made coarser, there are no runs, and without them no bars.
/// @param folder  where the meshes of commands go
/// @param fresh   makes them again
/// @param ratio   of sizes from mesh to mesh; 0 chooses one
/// @throws StudyInterrupted
Direction coarser_meshes(const sim::Scenario& scenario, const std::vector<std::string>& overrides,
                         const std::filesystem::path& folder, bool fresh, double ratio = 0);

}  // namespace articular::tools
