#include "tools/study/study_prepare.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "tools/process/interruption.hpp"
#include "tools/process/measured_program.hpp"
#include "tools/process/this_program.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using End = ProgramUse::End;

}  // namespace

std::vector<std::string> prepare_command(const fs::path& folder,
                                         const std::vector<std::string>& arguments) {
  std::vector<std::string> command{this_program().string()};
  for (std::string argument : arguments) {
    const std::string pattern = std::string("${") + kPrepared + "}";
    if (const auto at = argument.find(pattern); at != std::string::npos)
      argument.replace(at, pattern.size(), folder.string());
    command.push_back(argument);
  }
  return command;
}

std::string prepare_meshes(const fs::path& folder, const std::vector<std::string>& arguments,
                           bool fresh) {
  const std::string program = this_program().string();
  const fs::path done = folder / "prepared";
  const std::string key = joined(arguments) + identity(program);
  if (!fresh && text_of(done) == key) return "";
  fs::create_directories(folder);
  fs::remove(done);
  const std::vector<std::string> command = prepare_command(folder, arguments);
  const fs::path log = folder / "log";
  const ProgramUse use = run_measured(command, {}, log, {}, interruption_asked);
  if (use.end == End::Interrupted) throw StudyInterrupted{};
  if (use.end != End::Exited || use.code != 0)
    return fmt::format("({}): {}", log.string(), first_error(log));
  std::ofstream(done) << key;
  return "";
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string identity(const fs::path& file) {
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0) return "";
  return fmt::format("{} {}.{}", info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, "\x1f"));
}

std::string first_error(const fs::path& log) {
  std::ifstream stream(log);
  std::string line;
  while (std::getline(stream, line))
    if (line.starts_with("articular: ") && !line.starts_with("articular: warning:") &&
        !line.starts_with("articular: start:"))
      return line.substr(std::string("articular: ").size());
  return "";
}

std::string last_line(const fs::path& log) {
  std::ifstream stream(log);
  std::string line, last;
  while (std::getline(stream, line))
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  return last;
}

}  // namespace articular::tools
