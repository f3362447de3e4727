#include "tools/error_bars/coarser_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.hpp"
#include "sim/build/body_geometry.hpp"
#include "tools/error_bars/resized_mesh.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
using sim::Body;

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

/// Both coarser runs for one pair of factors. A failure of a command stands in its run.
std::vector<CoarserRun> runs_by(const VariedMeshes& varied, std::pair<double, double> factors,
                                const fs::path& folder, bool fresh) {
  std::vector<CoarserRun> runs;
  for (const double factor : {factors.first, factors.second}) {
    CoarserRun run;
    run.name = fmt::format("mesh {:.3g} times", factor);
    run.overrides = resized_meshes(varied, folder, factor, fresh, run.failure);
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

}  // namespace

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
                         const fs::path& folder, bool fresh, double ratio) {
  Direction mesh{"mesh", 2};
  const VariedMeshes varied = meshes_of(scenario);
  if (!varied.as_they_are.empty())
    mesh.left_out = fmt::format(
        "{} can't be made coarser: no `made_by` with an articular command "
        "and its --size",
        fmt::join(varied.as_they_are, ", "));
  mesh.is_needed = std::any_of(scenario.bodies.begin(), scenario.bodies.end(),
                               [](const Body& body) { return body.kind == Body::Kind::Tissue; });
  if (varied.bodies.empty() || (mesh.is_needed && !varied.has_tissue)) {
    if (mesh.left_out.empty()) mesh.remark = "the scene has no elements";
    return mesh;
  }
  if (ratio > 0)
    mesh.runs = runs_by(varied, {ratio, ratio * ratio}, folder, fresh);
  else if (varied.files.empty())
    mesh.runs = runs_by(varied, coarsening_of(judged_counts(varied)), folder, fresh);
  else
    mesh.runs = runs_with_files(varied, folder, fresh);
  measure_sizes(scenario, overrides, varied.bodies, mesh.runs);
  if (mesh.runs.empty()) mesh.left_out = "there are no fewer cells to take";
  return mesh;
}

}  // namespace articular::tools
