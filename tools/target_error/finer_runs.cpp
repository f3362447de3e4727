#include "tools/target_error/finer_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/base/error.hpp"
#include "sim/build/contact_model.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kFinest = 1.0 / 6;  // elements, of the scenario's

bool is_static(const sim::Scenario& scenario) {
  return scenario.analysis == sim::Scenario::Analysis::Static;
}

bool is_explicit(const sim::Scenario& scenario) {
  return !is_static(scenario) && scenario.integrator.scheme == sim::Integrator::Scheme::Explicit;
}

/// Whether cells times `factor` are whole within a tenth, and no direction stays behind.
bool leaves_whole(const std::vector<int>& counts, double factor) {
  constexpr double kRounded = 0.105;
  return std::all_of(counts.begin(), counts.end(), [&](int n) {
    const double wanted = n * factor;
    return std::abs(std::max(1.0, std::round(wanted)) / wanted - 1) < kRounded;
  });
}

/// Factors on the element size of the scenario, of meshes that can be made at the base and coarser.
/// The coarsest one is none of those that have to be.
struct MadeLevels {
  MeshLevels levels;
  std::vector<std::string> base, coarser, coarsest;
  std::string failure;
};

MadeLevels made_levels(const VariedMeshes& meshes, const fs::path& folder,
                       const MeshLevels& levels) {
  MadeLevels made{levels, {}, {}, {}, ""};
  made.base = resized_meshes(meshes, folder, levels.base, false, made.failure);
  if (made.failure.empty())
    made.coarser = resized_meshes(meshes, folder, levels.coarser, false, made.failure);
  if (!made.failure.empty() || levels.coarsest == 0) return made;
  std::string failure;
  made.coarsest = resized_meshes(meshes, folder, levels.coarsest, false, failure);
  if (!failure.empty()) made.levels.coarsest = 0;
  return made;
}

std::vector<double> finer_than(double base) {
  std::vector<double> finer{base / 1.2};
  while (finer.back() / 1.2 > kFinest) finer.push_back(finer.back() / 1.2);
  return finer;
}

/// Commands have a smallest and a largest size.
MadeLevels levels_of_files(const VariedMeshes& meshes, const fs::path& folder, bool coarse) {
  constexpr std::pair<double, double> kPairs[] = {{1.5, 2.25},  {4.0 / 3, 2}, {1, 1.5},
                                                  {1, 4.0 / 3}, {1, 1.2},     {1 / 1.5, 1}};
  MadeLevels made;
  for (const auto& [base, coarser] : kPairs) {
    if (!coarse && base > 1) continue;
    MadeLevels tried =
        made_levels(meshes, folder, {base, coarser, coarser * coarser / base, finer_than(base)});
    if (tried.failure.empty()) return tried;
    if (made.failure.empty()) made = std::move(tried);
  }
  return made;
}

MeshLevels levels_of_grids(const VariedMeshes& meshes, bool coarse) {
  MeshLevels levels = mesh_levels(judged_counts(meshes));
  if (coarse || levels.base <= 1) return levels;
  std::erase_if(levels.finer, [](double factor) { return factor >= 1; });
  return {1, levels.base, levels.coarser, levels.finer};
}

/// A mesh that the difference of two runs can speak of: not the two triangles of a rigid plate.
bool has_a_say(const VariedMeshes& meshes) {
  if (meshes.has_tissue || !meshes.files.empty()) return true;
  const std::vector<int> counts = judged_counts(meshes);
  return !counts.empty() && *std::min_element(counts.begin(), counts.end()) > 1;
}

Refinement mesh_refinement(const VariedMeshes& meshes, const fs::path& folder, bool coarse,
                           std::vector<std::string>& base_overrides) {
  Refinement mesh;
  mesh.coarser.name = "mesh";
  mesh.coarser.formal_order = 2;
  if (!meshes.as_they_are.empty())
    mesh.coarser.left_out = fmt::format(
        "the mesh of {} can't be made with other elements: no `made_by` with an articular command "
        "and its --size",
        fmt::join(meshes.as_they_are, ", "));
  if (meshes.bodies.empty() || !has_a_say(meshes)) {
    if (mesh.coarser.left_out.empty()) mesh.coarser.remark = "the scene has no elements to refine";
    return mesh;
  }
  const MadeLevels made = meshes.files.empty()
                              ? made_levels(meshes, folder, levels_of_grids(meshes, coarse))
                              : levels_of_files(meshes, folder, coarse);
  if (!made.failure.empty()) {
    mesh.coarser.left_out = made.failure;
    return mesh;
  }
  const bool has_files = !meshes.files.empty();
  const auto size_of = [&meshes, has_files](double factor) {
    return has_files ? factor : cell_size(meshes, factor);
  };
  const double own = size_of(made.levels.base);
  base_overrides = made.base;
  mesh.coarser.runs.push_back(
      {"coarser mesh", made.coarser, size_of(made.levels.coarser) / own, "", {}});
  if (made.levels.coarsest > 0)
    mesh.coarser.runs.push_back(
        {"coarsest mesh", made.coarsest, size_of(made.levels.coarsest) / own, "", {}});
  std::vector<double> factors{made.levels.base};
  for (const double factor : made.levels.finer) {
    factors.push_back(factor);
    mesh.sizes.push_back(size_of(factor) / own);
  }
  mesh.settings = [&meshes, folder, factors, sizes = mesh.sizes](double size) {
    const auto at = std::find(sizes.begin(), sizes.end(), size) - sizes.begin();
    std::string failure;
    std::vector<std::string> overrides =
        resized_meshes(meshes, folder, factors[static_cast<std::size_t>(at)], false, failure);
    if (!failure.empty()) throw sim::InputError(failure);
    return overrides;
  };
  mesh.least_cost_order = has_files ? 2 : 3;  // layers of anatomy stay as they are
  mesh.most_cost_order = 5;
  return mesh;
}

std::string step_override(double step) {
  return fmt::format("integrator.step=\"{:.12g} s\"", step);
}

/// Of a base whose steps are that of the scenario `base`.
Refinement step_refinement(const sim::Scenario& base, const std::vector<double>& lengths) {
  Refinement step;
  step.coarser = coarser_steps(base);
  if (step.coarser.runs.empty()) return step;
  if (is_explicit(base)) {
    step.sizes = {1, 0.1, 0.01, 1e-3};
    step.settings = [integrator = base.integrator](double size) {
      return looser_tolerance(integrator, size);
    };
    step.most_cost_order = 0.5;
    return step;
  }
  step.sizes.clear();
  for (const double length : lengths) step.sizes.push_back(length / lengths.front());
  step.settings = [length = lengths.front()](double size) {
    return std::vector<std::string>{step_override(length * size)};
  };
  step.least_cost_order = 0.6;  // longer steps take more iterations each
  step.most_cost_order = 1;
  return step;
}

Refinement tolerance_refinement(const sim::Scenario& base) {
  Refinement tolerance;
  tolerance.coarser = looser_iteration(base);
  if (tolerance.coarser.runs.empty()) return tolerance;
  tolerance.sizes = {1, 0.1, 0.01};
  tolerance.settings = [integrator = base.integrator](double size) {
    return looser_tolerance(integrator, size);
  };
  tolerance.most_cost_order = 0.3;
  return tolerance;
}

}  // namespace

MeshLevels mesh_levels(const std::vector<int>& counts) {
  const int n = *std::min_element(counts.begin(), counts.end());
  const auto next = [&](int from) {  // multiples of n leave all whole
    int j = from;
    while (!leaves_whole(counts, static_cast<double>(j) / n)) ++j;
    return j;
  };
  const int coarser = next(n == 1 ? 1 : std::max(2, static_cast<int>(n / 2.25)));
  const int base = next(std::max(static_cast<int>(std::lround(n / 1.5)),
                                 static_cast<int>(std::ceil(4.0 / 3 * coarser))));
  const int coarsest = next(std::max(1, static_cast<int>(n / 3.375)));
  MeshLevels levels{static_cast<double>(n) / base, static_cast<double>(n) / coarser, 0, {}};
  if (4 * coarsest <= 3 * coarser) levels.coarsest = static_cast<double>(n) / coarsest;
  for (int j = next(base + 1); j * kFinest <= n; j = next(std::max(j + 1, 6 * j / 5)))
    levels.finer.push_back(static_cast<double>(n) / j);
  return levels;
}

std::vector<double> step_lengths(const sim::Scenario& scenario) {
  constexpr int kShortest = 32;
  const double own = scenario.integrator.step;
  std::vector<double> lengths;
  if (is_static(scenario)) {  // found anew at each load: no reason for others than halves
    for (int parts = 1; parts <= 8; parts *= 2) lengths.push_back(own / parts);
    return lengths;
  }
  const double interval = std::min(scenario.output.interval, scenario.duration);
  constexpr double kRounding = 1e-9;
  const int first = std::max(1, static_cast<int>(std::ceil(interval / (2 * own) - kRounding)));
  for (int parts = first; interval / parts * kShortest > own * (1 - kRounding) && parts > 0;
       parts = std::max(parts + 1, 5 * parts / 4))
    lengths.push_back(interval / parts);
  if (lengths.empty()) lengths.push_back(own);
  return lengths;
}

RefinementBase refinement_base(const sim::Scenario& scenario,
                               const std::vector<std::string>& overrides, const fs::path& folder,
                               bool coarse) {
  RefinementBase base;
  const auto meshes = std::make_shared<const VariedMeshes>(meshes_of(scenario));
  Refinement mesh = mesh_refinement(*meshes, folder, coarse, base.overrides);
  if (mesh.settings)
    mesh.settings = [meshes, settings = mesh.settings](double size) { return settings(size); };
  std::vector<double> lengths = step_lengths(scenario);
  if (!coarse)
    std::erase_if(lengths, [&](double length) { return length > scenario.integrator.step * 1.01; });
  if (!is_explicit(scenario) && !lengths.empty())
    base.overrides.push_back(step_override(lengths.front()));
  std::vector<std::string> all = overrides;
  all.insert(all.end(), base.overrides.begin(), base.overrides.end());
  const sim::Scenario coarse_scenario = sim::read_scenario(scenario.file, all);
  base.kinds = {std::move(mesh), step_refinement(coarse_scenario, lengths),
                tolerance_refinement(coarse_scenario)};
  return base;
}

Refinement contact_refinement(const sim::Scenario& base, bool anything_touches) {
  Refinement contact;
  contact.coarser = softer_contact(base, anything_touches);
  if (contact.coarser.runs.empty()) return contact;
  const double factor = sim::contact_stiffness_factor(base, true);
  contact.sizes = {1, 1.0 / 3, 1.0 / 9, 1.0 / 27};
  contact.settings = [factor](double size) {
    return std::vector<std::string>{fmt::format("contact_stiffness_factor={:.6g}", factor / size)};
  };
  contact.most_cost_order = 0.5;
  return contact;
}

void keep_depths(Refinement& mesh, const Refinement& contact) {
  if (!contact.settings) return;
  for (CoarserRun& run : mesh.coarser.runs)
    for (const std::string& text : contact.settings(1 / run.size)) run.overrides.push_back(text);
}

}  // namespace articular::tools
