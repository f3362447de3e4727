#include "sim/output/results_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <vector>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder, const char* what, int error) {
  throw SystemError(folder.string() + ": the folder can't be " + what + ": " +
                    std::system_category().message(error));
}

/// BODY_000123.vtu or .vtp, also half-written.
bool is_frame(const fs::path& file) {
  std::string name = file.filename().string();
  if (name.ends_with(".part")) name.resize(name.size() - std::string_view(".part").size());
  if (!name.ends_with(".vtu") && !name.ends_with(".vtp")) return false;
  const std::string stem = fs::path(name).stem().string();
  const std::size_t underscore = stem.rfind('_');
  return underscore != std::string::npos && stem.size() - underscore > 6 &&
         std::all_of(stem.begin() + static_cast<std::ptrdiff_t>(underscore) + 1, stem.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

/// None where the folder is not there.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
  if (error && error != std::errc::no_such_file_or_directory) fail(folder, "read", error.value());
  return files;
}

/// Name and folder of the scenario that results are of; "" where nothing tells.
struct Origin {
  std::string scenario, folder;
};

Origin origin_of(const fs::path& folder) {
  std::ifstream in(folder / "summary.json");
  const auto json = nlohmann::json::parse(in, nullptr, false);
  const auto text = [&](const char* key) -> std::string {
    return json.is_object() && json.contains(key) && json[key].is_string() ? json[key] : "";
  };
  if (std::string name = text("scenario"); !name.empty()) return {name, text("scenario_folder")};
  for (const fs::path& file : files_in(folder))
    if (file.extension() == ".pvd") return {file.stem().string() + ".toml", ""};
  return {};
}

void refuse_link(const fs::path& file) {
  std::error_code none;
  if (fs::is_symlink(file, none))
    throw InputError({file.string()},
                     "is a symbolic link; results are not written through one: remove it, or "
                     "choose another --out");
}

void delete_file(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw SystemError(file.string() + ": can't be removed: " + error.message());
}

}  // namespace

ResultsFolder::ResultsFolder(const fs::path& folder) {
  make_folders(folder);
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) fail(folder, "opened", errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int reason = errno;
  ::close(descriptor_);
  if (reason == EWOULDBLOCK)
    throw InputError(
        {folder.string()},
        "another run is writing its results here; wait for it, or choose another --out");
  fail(folder, "locked", reason);
}

ResultsFolder::~ResultsFolder() { ::close(descriptor_); }

std::string folder_of(const fs::path& scenario) {
  std::error_code none;
  return fs::weakly_canonical(scenario, none).parent_path().string();
}

void clear_results(const fs::path& folder, const fs::path& scenario, bool overwrite) {
  auto [other, home] = origin_of(folder);
  if (other.empty() && fs::exists(folder / "history.csv")) other = "an unknown scenario";
  const std::string name = scenario.filename().string();
  const bool is_elsewhere = other == name && !home.empty() && home != folder_of(scenario);
  if (!overwrite && !other.empty() && (other != name || is_elsewhere))
    throw InputError({folder.string()}, "holds results of " + other +
                                            (is_elsewhere ? " in " + home : "") +
                                            "; choose another --out, or replace them with "
                                            "--overwrite");
  std::vector<fs::path> checkpoints, files;
  for (const char* const name : {"state.bin", "previous.bin"})
    checkpoints.push_back(folder / "checkpoint" / name);
  for (const char* const name : {"history.csv", "convergence.csv", "error_bars.csv"})
    files.push_back(folder / name);
  for (const std::string& of : {name, other})
    files.push_back(folder / (fs::path(of).stem().string() + ".pvd"));
  for (const fs::path& file : files_in(folder / "frames"))
    if (is_frame(file)) files.push_back(file);
  for (const char* const name : {"checkpoint", "frames", "summary.json"})
    refuse_link(folder / name);
  for (const auto* all : {&checkpoints, &files})
    for (const fs::path& file : *all) refuse_link(file);
  // First what says that there are whole results, then what goes on from them: whatever stops this,
  // nobody takes the rest for more than it is.
  write_unfinished_summary(folder, scenario);
  for (const fs::path& file : checkpoints) delete_file(file);
  if (std::error_code none; fs::exists(folder / "checkpoint", none))
    sync_file(folder / "checkpoint");
  for (const fs::path& file : files) delete_file(file);
}

void write_unfinished_summary(const fs::path& folder, const fs::path& scenario) {
  const nlohmann::json summary = {{"outcome", "unfinished"},
                                  {"scenario", scenario.filename().string()},
                                  {"scenario_folder", folder_of(scenario)}};
  write_text_file(folder / "summary.json", summary.dump(2) + "\n");
}

}  // namespace articular::sim
