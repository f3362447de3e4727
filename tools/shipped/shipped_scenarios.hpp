#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The scenarios and studies that come with the program, each known by its path in their folder:
/// "mandible/opening" is mandible/opening.toml.
namespace articular::tools {

/// Where they lie: the environment variable ARTICULAR_SCENARIOS, else share/articular/scenarios
/// beside the program's bin, or of the Python package beside its lib, else the folder of the source
/// tree that it was built from.
/// @throws sim::InputError  if none of these is a folder
std::filesystem::path shipped_folder();

struct ShippedScenario {
  std::string name;   // "mandible/opening"
  std::string kind;   // "dynamic", "static", "study", "population", "fit" or "track"
  std::string title;  // the name if it has none
};

/// All of them by name; other TOML files in the folder are left out.
/// @throws sim::InputError  if one is no valid TOML
std::vector<ShippedScenario> shipped_scenarios();

/// The file of a shipped scenario, or nothing if none has this name.
std::optional<std::filesystem::path> shipped_file(const std::filesystem::path& name);

/// The file that a user means: `given` if that is a file, else what is shipped by that name.
/// @throws sim::InputError  if there is neither; suggests the nearest name
std::filesystem::path find_file(const std::filesystem::path& given);

/// The same of a file that a subcommand takes: "run" stands for all that take a scenario, and there
/// are "study", "fit" and "track".
/// @throws sim::InputError  also where another subcommand takes it: names that one; where it is no
///                          valid TOML
std::filesystem::path find_file_for(std::string_view subcommand,
                                    const std::filesystem::path& given);

}  // namespace articular::tools
