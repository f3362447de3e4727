#include "tools/error_bars/resized_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tools/error_bars/coarser_runs.hpp"
#include "tools/study/study_prepare.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using sim::Body;

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

std::vector<int> resized(const std::vector<int>& counts, double factor) {
  std::vector<int> others;
  others.reserve(counts.size());
  for (const int n : counts)
    others.push_back(std::max(1, static_cast<int>(std::lround(n / factor))));
  return others;
}

/// How many there are; of a ball in proportion.
double cells(const GridBody& grid, const std::vector<int>& counts) {
  if (std::holds_alternative<sim::SphereGeometry>(grid.body->geometry))
    return std::pow(counts[0], 3);
  double product = 1;
  for (const int n : counts) product *= n;
  return product;
}

std::string grid_override(const GridBody& grid, double factor) {
  const std::vector<int> counts = resized(grid.counts, factor);
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
  bool varies = false, is_left = false;
  if (std::vector<int> counts = counts_of(body); !counts.empty()) {
    varied.grids.push_back({path_of(body) + ".geometry", std::move(counts), &body});
    varies = true;
  } else if (const auto* mesh = std::get_if<sim::MeshFile>(&body.geometry)) {
    const bool counts_for_contact = body.contact_meshes.empty() && can_touch(scenario, body);
    if (is_tissue || counts_for_contact)
      (add_file(*mesh, path_of(body) + ".mesh.file", varied) ? varies : is_left) = true;
  }
  for (std::size_t i = 0; i < body.contact_meshes.size() && can_touch(scenario, body); ++i) {
    const std::string path = fmt::format("{}.contact_meshes.{}.file", path_of(body), i);
    (add_file(body.contact_meshes[i], path, varied) ? varies : is_left) = true;
  }
  if (varies) varied.bodies.push_back(body.name);
  varied.has_tissue |= varies && is_tissue;
  if (is_left)
    varied.as_they_are.push_back(fmt::format("{}`{}`", is_tissue ? "" : "surface of ", body.name));
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
    const std::vector<std::string> arguments = resized_arguments(mesh.command, factor);
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

}  // namespace

VariedMeshes meshes_of(const sim::Scenario& scenario) {
  VariedMeshes varied;
  for (const Body& body : scenario.bodies) add_body(scenario, body, varied);
  return varied;
}

std::vector<int> judged_counts(const VariedMeshes& varied) {
  std::vector<int> of_tissue, all;
  for (const GridBody& grid : varied.grids) {
    all.insert(all.end(), grid.counts.begin(), grid.counts.end());
    if (grid.body->kind == Body::Kind::Tissue)
      of_tissue.insert(of_tissue.end(), grid.counts.begin(), grid.counts.end());
  }
  return of_tissue.empty() ? all : of_tissue;
}

std::vector<std::string> resized_meshes(const VariedMeshes& meshes, const fs::path& folder,
                                        double factor, bool fresh, std::string& failure) {
  std::vector<std::string> overrides = made_overrides(meshes, folder, factor, fresh, failure);
  for (const GridBody& grid : meshes.grids) overrides.push_back(grid_override(grid, factor));
  return overrides;
}

double cell_size(const VariedMeshes& meshes, double factor) {
  double before = 0, after = 0;
  for (const GridBody& grid : meshes.grids) {
    if (meshes.has_tissue && grid.body->kind != Body::Kind::Tissue) continue;
    before += cells(grid, grid.counts);
    after += cells(grid, resized(grid.counts, factor));
  }
  return before > 0 ? std::cbrt(before / after) : factor;
}

}  // namespace articular::tools
