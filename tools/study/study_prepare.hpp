#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Meshes that cases of a study need, and what programs of cases leave behind.
namespace articular::tools {

/// Somebody asked for the end; what is finished stays.
struct StudyInterrupted {};

/// The environment variable, and the text in arguments, that stands for the folder of the meshes.
inline constexpr const char* kPrepared = "ARTICULAR_PREPARED";

/// Runs `articular ARGUMENTS` with ${ARTICULAR_PREPARED} replaced by the folder, which is made.
/// Does nothing where the same program did so before.
/// @param fresh  does it again
/// @return what the command says is wrong, with its log; "" if nothing is
/// @throws StudyInterrupted, sim::SystemError
std::string prepare_meshes(const std::filesystem::path& folder,
                           const std::vector<std::string>& arguments, bool fresh);

/// The command that prepare_meshes() runs.
std::vector<std::string> prepare_command(const std::filesystem::path& folder,
                                         const std::vector<std::string>& arguments);

/// What a file holds; "" if it can't be read.
std::string text_of(const std::filesystem::path& file);

/// Size and date of a file: another build gives another answer.
std::string identity(const std::filesystem::path& file);

/// Words as one text, for keys.
std::string joined(const std::vector<std::string>& words);

/// The first error in the log of an `articular` command; "" if there is none.
std::string first_error(const std::filesystem::path& log);

/// The last line that is not empty, of a log of any program; "" if there is none.
std::string last_line(const std::filesystem::path& log);

}  // namespace articular::tools
