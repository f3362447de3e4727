#pragma once

#include <string>
#include <vector>

#include "tools/import/febio_model.hpp"

namespace articular::tools {

struct ImportedScenario {
  std::string text;          // TOML
  std::vector<Loss> losses;  // in the order of lines
};

/// A FEBio model as a scenario, which takes its meshes from the model's file.
/// @param mesh       of the model, with all its nodes
/// @param mesh_file  as the scenario names it
/// @throws sim::InputError if nothing of it can be taken over: no part has a material that is known
ImportedScenario scenario_of(const std::string& file, const FebioModel& model,
                             const sim::MeshData& mesh, const UnitSystem& units,
                             const std::string& mesh_file);

}  // namespace articular::tools
