#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/model/model.hpp"
#include "sim/model/state.hpp"

namespace articular::sim {

/// What a checkpoint belongs to: the scenario's content and what was read from other files (meshes,
/// muscle tables). A run of another scenario must not resume from it.
std::string fingerprint(const Scenario& scenario, const Model& model);

/// Writes the state in full precision, whole or not at all. @throws SystemError
void write_checkpoint(const std::filesystem::path& file, const State& state,
                      const std::string& fingerprint);

/// @return nothing when there is no such file
/// @throws InputError when it is damaged or belongs to another scenario
std::optional<State> read_checkpoint(const std::filesystem::path& file,
                                     const std::string& fingerprint);

}  // namespace articular::sim
