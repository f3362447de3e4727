#include "tools/shipped/shipped_scenarios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "sim/base/message_text.hpp"
#include "sim/scenario/toml_document.hpp"
#include "tools/process/this_program.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "ARTICULAR_SCENARIOS";

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// Names of all TOML files in the folder, sorted.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".toml")
      names.push_back(entry->path().lexically_relative(folder).replace_extension().string());
  if (error)
    throw sim::InputError({folder.string()}, "the folder can't be read: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::string text_of(const sim::Node& document, std::string_view key, std::string_view otherwise) {
  const sim::Node* node = document.find(key);
  return node != nullptr && node->text() != nullptr ? *node->text() : std::string(otherwise);
}

/// "dynamic", "static", "study", "population", "fit" or "track"; "": another file.
std::string kind_of(const sim::Node& document) {
  const auto has = [&](std::string_view key) { return document.find(key) != nullptr; };
  if (has("population")) return "population";
  if (has("scenario"))
    return has("target") ? "track" : has("parameter") || has("measurement") ? "fit" : "study";
  return has("duration") ? text_of(document, "analysis", "dynamic") : "";
}

std::string_view subcommand_of(std::string_view kind) {
  if (kind == "fit" || kind == "track") return kind;
  return kind == "study" || kind == "population" ? "study" : "run";
}

/// "mandible/opening" for what users may write for it: `opening`,
/// `scenarios/mandible/opening.toml`.
std::string nearest_shipped(const fs::path& given, const std::vector<std::string>& names) {
  const fs::path bare = given.extension() == ".toml" ? fs::path(given).replace_extension() : given;
  const std::string folder_and_name = (bare.parent_path().filename() / bare.filename()).string();
  for (const std::string& name : names)
    if (name == folder_and_name) return name;
  for (const std::string& name : names)
    if (fs::path(name).filename() == bare.filename()) return name;
  return sim::nearest_name(folder_and_name, names);
}

/// Where the shipped scenarios may lie, in the order that counts.
std::vector<fs::path> candidates() {
  const char* variable = std::getenv(kVariable);
  if (variable != nullptr && *variable != '\0') return {variable};
  const auto beside = [](const fs::path& file, const char* prefix) {
    return (file.parent_path() / prefix / "share/articular/scenarios").lexically_normal();
  };
  std::vector<fs::path> places{beside(this_program(), "..")};
  if (this_library() != this_program())  // of Python: lib/python3/dist-packages/articular
    places.push_back(beside(this_library(), "../../../.."));
  places.emplace_back(ARTICULAR_SOURCE_SCENARIOS);
  return places;
}

/// The usual first try: a mesh in place of the scenario that names it.
void refuse_mesh(const fs::path& given) {
  static const std::set<std::string> kMeshes = {".stl",  ".obj", ".ply", ".vtp", ".vtu",
                                                ".vtk",  ".msh", ".inp", ".bdf", ".nas",
                                                ".mesh", ".ele", ".node"};
  const std::string ending = given.extension().string();
  if (ending == ".feb")
    throw sim::InputError(
        {sim::one_line(given.string())},
        "expected a scenario (.toml); `articular import` makes one of a FEBio model");
  if (kMeshes.contains(ending))
    throw sim::InputError(
        {sim::one_line(given.string())},
        fmt::format("expected a scenario (.toml), found a mesh; a [[body]] of a scenario names it: "
                    "mesh = {{ file = \"{}\" }}",
                    sim::one_line(given.filename().string())));
}

/// The first candidate that is a folder, or nothing.
std::optional<fs::path> existing_folder() {
  for (const fs::path& folder : candidates())
    if (is_folder(folder)) return folder;
  return std::nullopt;
}

/// A `.toml` of nearly that name in the same folder: "bar.toml" for "bar.tml"; "" without one.
fs::path nearest_beside(const fs::path& given) {
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = given.has_parent_path() ? given.parent_path() : ".";
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".toml") names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  const std::string near = sim::nearest_name(given.filename().string(), names);
  return near.empty() ? fs::path() : given.parent_path() / near;
}

}  // namespace

fs::path shipped_folder() {
  if (const auto folder = existing_folder()) return *folder;
  std::string places;
  for (const fs::path& folder : candidates())
    places += (places.empty() ? "" : " or ") + sim::in_ticks(folder.string());
  throw sim::InputError(
      fmt::format("expected the shipped scenarios in {}, found no such folder; "
                  "the environment variable {} can name another",
                  places, kVariable));
}

std::vector<ShippedScenario> shipped_scenarios() {
  const fs::path folder = shipped_folder();
  std::vector<ShippedScenario> scenarios;
  for (const std::string& name : names_in(folder)) {
    const sim::Node document = sim::read_toml(folder / (name + ".toml"));
    if (const std::string kind = kind_of(document); !kind.empty())
      scenarios.push_back({name, kind, text_of(document, "title", name)});
  }
  return scenarios;
}

std::optional<fs::path> shipped_file(const fs::path& name) {
  const auto folder = existing_folder();
  if (!folder) return std::nullopt;
  const std::vector<std::string> names = names_in(*folder);
  if (!std::binary_search(names.begin(), names.end(), name.string())) return std::nullopt;
  return *folder / (name.string() + ".toml");
}

fs::path find_file(const fs::path& given) {
  std::error_code error;
  if (fs::exists(given, error) && !is_folder(given)) {
    refuse_mesh(given);
    return given;
  }
  if (const auto shipped = shipped_file(given)) return *shipped;
  const sim::Location where{sim::one_line(given.string())};
  if (is_folder(given)) throw sim::InputError(where, "expected a scenario file, found a folder");
  if (const fs::path beside = nearest_beside(given); !beside.empty())
    throw sim::InputError(
        where, fmt::format("no such file; did you mean {}?", sim::in_ticks(beside.string())));
  const auto folder = existing_folder();
  const std::string near = folder ? nearest_shipped(given, names_in(*folder)) : "";
  throw sim::InputError(
      where, fmt::format("no such file, and no scenario of this name is shipped; {}",
                         near.empty() ? "`articular scenarios` lists those that are"
                                      : fmt::format("did you mean {}?", sim::in_ticks(near))));
}

fs::path find_file_for(std::string_view subcommand, const fs::path& given) {
  fs::path file = find_file(given);
  const std::string kind = kind_of(sim::read_toml(file));
  if (kind.empty() || subcommand_of(kind) == subcommand) return file;
  const std::string_view right = subcommand_of(kind);
  const std::string path = sim::one_line(given.string());
  throw sim::InputError({path}, fmt::format("expected a {}, found a {}; `articular {} {}` runs it",
                                            subcommand == "run" ? "scenario" : subcommand,
                                            right == "run" ? "scenario" : kind, right, path));
}

}  // namespace articular::tools
