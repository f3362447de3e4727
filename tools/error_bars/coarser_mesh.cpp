#include "tools/error_bars/coarser_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "sim/base/error.hpp"
#include "sim/build/body_geometry.hpp"
#include "tools/study/study_prepare.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using sim::Body;

/// A body whose cells are counted in the scenario.
struct GridBody {
  std::string path;         // of its geometry: body."NAME".geometry
  std::vector<int> counts;  // cells along its edges; of a sphere along the radius
  const Body* body;
};

/// A mesh file, and the command that makes it.
struct MadeMesh {
  std::string path;  // body."NAME".mesh.file
  std::string file_name;
  MeshCommand command;
};

struct VariedMeshes {
  std::vector<GridBody> grids;
  std::vector<MadeMesh> files;
  std::vector<std::string> bodies;  // names of those that get coarser
  std::vector<std::string> as_they_are;
};

std::string path_of(const Body& body) { return fmt::format("body.\"{}\"", body.name); }

int sphere_cells(const sim::SphereGeometry& sphere) {
  return std::max(1, static_cast<int>(std::lround(sphere.radius / sphere.element_size)));
}

/// Empty: no built-in geometry.
std::vector<int> counts_of(const Body& body) {
  const auto list = [](const auto& cells) { return std::vector<int>(cells.begin(), cells.end()); };
  if (const auto* box = std::get_if<sim::BoxGeometry>(&body.geometry)) return list(box->cells);
  if (const auto* block = std::get_if<sim::HexahedronGeometry>(&body.geometry))
    return list(block->cells);
  if (const auto* v = std::get_if<sim::VShapeGeometry>(&body.geometry)) return list(v->cells);
  if (const auto* ball = std::get_if<sim::SphereGeometry>(&body.geometry))
    return {sphere_cells(*ball)};
  return {};
}

std::vector<int> coarser(const std::vector<int>& counts, double factor) {
  std::vector<int> fewer;
  fewer.reserve(counts.size());
  for (const int n : counts)
    fewer.push_back(std::max(1, static_cast<int>(std::lround(n / factor))));
  return fewer;
}

std::string grid_override(const GridBody& grid, double factor) {
  const std::vector<int> counts = coarser(grid.counts, factor);
  if (const auto* ball = std::get_if<sim::SphereGeometry>(&grid.body->geometry))
    return fmt::format("{}.sphere.element_size=\"{} m\"", grid.path, ball->radius / counts[0]);
  const char* shape = std::holds_alternative<sim::BoxGeometry>(grid.body->geometry) ? "box"
                      : std::holds_alternative<sim::HexahedronGeometry>(grid.body->geometry)
                          ? "hexahedron"
                          : "v_shape";
  return fmt::format("{}.{}.cells=[{}]", grid.path, shape, fmt::join(counts, ", "));
}

/// Adds a mesh file to what can be made anew, or says that it can't.
bool add_file(const sim::MeshFile& mesh, const std::string& path, VariedMeshes& varied) {
  const auto command = mesh_command(mesh.made_by);
  if (command) varied.files.push_back({path, mesh.path.filename().string(), *command});
  return command.has_value();
}

void add_body(const sim::Scenario& scenario, const Body& body, VariedMeshes& varied) {
  const bool is_tissue = body.kind == Body::Kind::Tissue;
  bool gets_coarser = false, is_left = false;
  if (std::vector<int> counts = counts_of(body); !counts.empty()) {
    varied.grids.push_back({path_of(body) + ".geometry", std::move(counts), &body});
    gets_coarser = true;
  } else if (const auto* mesh = std::get_if<sim::MeshFile>(&body.geometry)) {
    const bool counts_for_contact = body.contact_meshes.empty() && can_touch(scenario, body);
    if (is_tissue || counts_for_contact)
      (add_file(*mesh, path_of(body) + ".mesh.file", varied) ? gets_coarser : is_left) = true;
  }
  for (std::size_t i = 0; i < body.contact_meshes.size() && can_touch(scenario, body); ++i) {
    const std::string path = fmt::format("{}.contact_meshes.{}.file", path_of(body), i);
    (add_file(body.contact_meshes[i], path, varied) ? gets_coarser : is_left) = true;
  }
  if (gets_coarser) varied.bodies.push_back(body.name);
  if (is_left)
    varied.as_they_are.push_back(fmt::format("{}`{}`", is_tissue ? "" : "surface of ", body.name));
}

VariedMeshes meshes_of(const sim::Scenario& scenario) {
  VariedMeshes varied;
  for (const Body& body : scenario.bodies) add_body(scenario, body, varied);
  return varied;
}

/// How fine the meshes are: the number of elements by which sizes compare, to the power -1/d.
double element_size(const sim::Scenario& scenario, const std::vector<std::string>& names) {
  double tissue = 0, all = 0, triangles = 0;
  for (const std::string& name : names) {
    const Body& body = scenario.bodies[static_cast<std::size_t>(sim::body_index(scenario, name))];
    const sim::BodyGeometry geometry = sim::read_geometry(body);
    const auto tets = static_cast<double>(geometry.mesh.tets.cols());
    all += tets;
    if (body.kind == Body::Kind::Tissue) tissue += tets;
    triangles +=
        static_cast<double>(geometry.mesh.triangles.cols() + geometry.contact.triangles.cols());
  }
  if (tissue > 0) return std::cbrt(1 / tissue);
  return all > 0 ? std::cbrt(1 / all) : std::sqrt(1 / std::max(1.0, triangles));
}

/// A text as TOML's basic string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// Makes the files of one factor and returns the overrides that name them, or what failed.
std::vector<std::string> made_overrides(const VariedMeshes& varied, const fs::path& folder,
                                        double factor, bool fresh, std::string& failure) {
  std::vector<std::string> overrides, made;
  for (const MadeMesh& mesh : varied.files) {
    const std::vector<std::string> arguments = coarser_arguments(mesh.command, factor);
    const std::string key = joined(arguments);
    const fs::path place = folder / fmt::format("{:016x}", std::hash<std::string>{}(key));
    const bool is_made = std::find(made.begin(), made.end(), key) != made.end();
    failure = is_made ? "" : prepare_meshes(place, arguments, fresh);
    if (!failure.empty()) {
      failure = fmt::format("`articular {}` failed {}", fmt::join(arguments, " "), failure);
      return {};
    }
    made.push_back(key);
    overrides.push_back(mesh.path + "=" + quoted((place / mesh.file_name).string()));
  }
  return overrides;
}

/// Both coarser runs for one pair of factors. A failure of a command stands in its run.
std::vector<CoarserRun> runs_by(const VariedMeshes& varied, std::pair<double, double> factors,
                                const fs::path& folder, bool fresh) {
  std::vector<CoarserRun> runs;
  for (const double factor : {factors.first, factors.second}) {
    CoarserRun run;
    run.name = fmt::format("mesh {:.3g} times", factor);
    run.overrides = made_overrides(varied, folder, factor, fresh, run.failure);
    for (const GridBody& grid : varied.grids) run.overrides.push_back(grid_override(grid, factor));
    runs.push_back(std::move(run));
  }
  return runs;
}

bool all_made(const std::vector<CoarserRun>& runs) {
  return std::all_of(runs.begin(), runs.end(),
                     [](const CoarserRun& run) { return run.failure.empty(); });
}

/// Commands have a largest size: the first ratio with which both meshes can be made.
std::vector<CoarserRun> runs_with_files(const VariedMeshes& varied, const fs::path& folder,
                                        bool fresh) {
  std::vector<CoarserRun> runs;
  for (const double ratio : {1.5, 4.0 / 3, 1.25}) {
    std::vector<CoarserRun> tried = runs_by(varied, {ratio, ratio * ratio}, folder, fresh);
    if (all_made(tried)) return tried;
    if (runs.empty()) runs = std::move(tried);
  }
  return runs;
}

/// Counts by which the rounding of cells is judged: those of tissue, else all.
std::vector<int> judged_counts(const VariedMeshes& varied) {
  std::vector<int> of_tissue, all;
  for (const GridBody& grid : varied.grids) {
    all.insert(all.end(), grid.counts.begin(), grid.counts.end());
    if (grid.body->kind == Body::Kind::Tissue)
      of_tissue.insert(of_tissue.end(), grid.counts.begin(), grid.counts.end());
  }
  return of_tissue.empty() ? all : of_tissue;
}

/// Sizes that differ by less are equal.
constexpr double kCoarser = 1.05;

/// Their sizes, by the meshes themselves. Runs that are no coarser than the one before go.
void measure_sizes(const sim::Scenario& scenario, const std::vector<std::string>& overrides,
                   const std::vector<std::string>& bodies, std::vector<CoarserRun>& runs) {
  const double own = element_size(scenario, bodies);
  double before = 1;
  for (CoarserRun& run : runs) {
    if (!run.failure.empty()) continue;
    std::vector<std::string> all = overrides;
    all.insert(all.end(), run.overrides.begin(), run.overrides.end());
    try {
      run.size = element_size(sim::read_scenario(scenario.file, all), bodies) / own;
    } catch (const sim::InputError& error) {
      run.failure = error.what();  // the command made no such file
      continue;
    }
    if (run.size > before * kCoarser)
      before = run.size;
    else
      run.size = 0;
  }
  std::erase_if(runs, [](const CoarserRun& run) { return run.failure.empty() && run.size == 0; });
}

/// Splits a command as a shell would, quotes and ${NAME} but nothing else.
std::vector<std::string> words_of_command(const std::string& text) {
  std::vector<std::string> words;
  bool is_open = false;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == 0 && (c == ' ' || c == '\t')) {
      is_open = false;
      continue;
    }
    if (!is_open) words.emplace_back();
    is_open = true;
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (const std::size_t end = text.find('}', i);
               text.compare(i, 2, "${") == 0 && end != std::string::npos) {
      const char* value = std::getenv(text.substr(i + 2, end - i - 2).c_str());
      if (value != nullptr) words.back() += value;
      i = end;
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// `--size=2` as `--size 2`.
std::vector<std::string> split_options(const std::vector<std::string>& words) {
  std::vector<std::string> split;
  for (const std::string& word : words) {
    const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    split.push_back(word.substr(0, equals));
    if (equals != std::string::npos) split.push_back(word.substr(equals + 1));
  }
  return split;
}

/// The word with the value of an option; 0: it is not there.
std::size_t value_word(const std::vector<std::string>& words, const std::string& option) {
  const auto at = std::find(words.begin(), words.end(), option);
  return words.end() - at > 1 ? static_cast<std::size_t>(at - words.begin()) + 1 : 0;
}

}  // namespace

std::optional<MeshCommand> mesh_command(const std::string& made_by) {
  std::vector<std::string> words = split_options(words_of_command(made_by));
  if (words.size() < 2 || fs::path(words[0]).filename() != "articular") return {};
  words.erase(words.begin());
  if (words[0] != "anatomy" && words[0] != "mesh") return {};
  const MeshCommand command{words, value_word(words, "--size"), value_word(words, "--out")};
  if (command.size_word == 0 || command.out_word == 0) return {};
  if (!(std::strtod(words[command.size_word].c_str(), nullptr) > 0)) return {};
  return command;
}

std::vector<std::string> coarser_arguments(const MeshCommand& command, double factor) {
  std::vector<std::string> words = command.words;
  std::string& size = words[command.size_word];
  char* rest = nullptr;
  const double number = std::strtod(size.c_str(), &rest);
  size = fmt::format("{:.6g}{}", factor * number, rest);
  const std::string place = fmt::format("${{{}}}", kPrepared);
  std::string& out = words[command.out_word];
  out = words[0] == "mesh" ? place + "/" + fs::path(out).filename().string() : place;
  return words;
}

std::pair<double, double> coarsening_of(const std::vector<int>& counts) {
  constexpr std::pair<double, double> kPairs[] = {{1.5, 2.25},    {1.5, 2}, {4.0 / 3, 2}, {1.5, 3},
                                                  {4.0 / 3, 1.6}, {2, 3},   {2, 4}};
  const auto rounding = [&](double factor) {
    double sum = 0;
    for (const int n : counts)
      if (n > 1)
        sum += std::pow(std::log(n / factor / std::max<double>(1, std::round(n / factor))), 2);
    return sum;
  };
  std::pair<double, double> best = kPairs[0];
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [first, second] : kPairs) {
    const double score = rounding(first) + rounding(second);
    if (score < least - 1e-9) {
      least = score;
      best = {first, second};
    }
  }
  return best;
}

Direction coarser_meshes(const sim::Scenario& scenario, const std::vector<std::string>& overrides,
                         const fs::path& folder, bool fresh) {
  Direction mesh{"mesh", 2};
  const VariedMeshes varied = meshes_of(scenario);
  if (!varied.as_they_are.empty())
    mesh.left_out = fmt::format(
        "{} can't be made coarser: no `made_by` with an articular command "
        "and its --size",
        fmt::join(varied.as_they_are, ", "));
  if (varied.bodies.empty()) {
    if (mesh.left_out.empty()) mesh.remark = "the scene has no elements";
    return mesh;
  }
  mesh.runs = varied.files.empty()
                  ? runs_by(varied, coarsening_of(judged_counts(varied)), folder, fresh)
                  : runs_with_files(varied, folder, fresh);
  measure_sizes(scenario, overrides, varied.bodies, mesh.runs);
  if (mesh.runs.empty()) mesh.left_out = "there are no fewer cells to take";
  return mesh;
}

}  // namespace articular::tools
