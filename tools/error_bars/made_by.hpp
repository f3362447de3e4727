#pragma once

#include <optional>
#include <string>
#include <vector>

/// The command that a mesh file was made by, and the same with another element size.
namespace articular::tools {

/// `articular anatomy ...` or `articular mesh ...` of `made_by`.
struct MeshCommand {
  std::vector<std::string> words;  // after `articular`; variables in them are replaced
  std::size_t size_word = 0;       // "--size 1.2": the number of the word with the number
  std::size_t out_word = 0;
};

/// Reads `made_by`. None where it is another command, or one that names no --size or --out.
std::optional<MeshCommand> mesh_command(const std::string& made_by);

/// The arguments for elements `factor` times as large, with the results in
/// ${ARTICULAR_PREPARED}.
std::vector<std::string> resized_arguments(const MeshCommand& command, double factor);

}  // namespace articular::tools
