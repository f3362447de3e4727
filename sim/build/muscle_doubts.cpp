#include "sim/build/muscle_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "fem/material/any_material.hpp"
#include "fem/mesh/fibre_field.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

/// A muscle begins at less of its largest active force hardly by intent.
constexpr double kLeastShareAtRest = 0.2;
/// Of fibres with the line between the ends: bellies are pennate by up to some 40 degrees.
constexpr double kLeastCosine = 0.3;

/// Of their flux: rounded numbers of a file leave a millionth, and what is worse costs force.
constexpr double kMostLoose = 0.2;

/// Of fibres [Pa]: unit_doubts.cpp doubts less by itself.
constexpr double kLeastPull = 1e3;

/// Of the largest active stress at any length; 1 of laws without a force-length curve.
double active_share_at_rest(const fem::AnyMaterial& law) {
  const std::optional<fem::MuscleFibre> fibre = fem::muscle_fibre(law);
  if (!fibre) return 1;
  const auto active = [&](double stretch) {
    return fibre->tension(stretch, 1) - fibre->tension(stretch, 0);
  };
  constexpr double kLeast = 0.2, kMost = 1000;  // of the stretches to look at
  constexpr int kSteps = 1000;
  double most = 0;
  for (int i = 0; i <= kSteps; ++i)
    most =
        std::max(most, active(kLeast * std::pow(kMost / kLeast, static_cast<double>(i) / kSteps)));
  return most > 0 ? active(fem::prestretch(law)) / most : 0;
}

/// How far the fibres of a tissue that is tied to more than one body run along the line between the
/// middles of the two patches that are farthest apart: the mean cosine.
std::optional<double> cosine_with_ends(const Tissue& tissue) {
  std::map<int, std::pair<Vec3, int>> sums;  // of tied nodes, by the body
  for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
    if (const int rigid = tissue.nodes[i].rigid; rigid >= 0) {
      auto& [sum, count] = sums.try_emplace(rigid, Vec3::Zero(), 0).first->second;
      sum += tissue.X.col(static_cast<Eigen::Index>(i));
      ++count;
    }
  Vec3 way = Vec3::Zero();
  for (const auto& [a, from] : sums)
    for (const auto& [b, to] : sums)
      if (const Vec3 d = to.first / to.second - from.first / from.second; d.norm() > way.norm())
        way = d;
  if (way.isZero(0)) return std::nullopt;
  return (way.normalized().transpose() * tissue.fibres.colwise().normalized()).cwiseAbs().mean();
}

/// Nodes at which fibres may end: tied, supported or in a sheet.
std::vector<bool> holding_nodes(const Model& model, std::size_t t) {
  const Tissue& tissue = model.tissues[t];
  std::vector<bool> holds;
  for (const NodeRef& node : tissue.nodes) holds.push_back(node.rigid >= 0);
  for (const SupportModel& support : model.supports)
    if (support.tissue == static_cast<int>(t))
      for (const SupportModel::Node& node : support.nodes)
        holds[static_cast<std::size_t>(node.node)] = true;
  for (const SheetModel& sheet : tissue.sheets)
    for (const int node : sheet.fibres.faces().reshaped())
      holds[static_cast<std::size_t>(node)] = true;
  return holds;
}

bool is_conserved_array(const Fibres& fibres) {
  return std::holds_alternative<FibreArray>(fibres.along) &&
         fibres.density == Fibres::Density::Conserved;
}

/// Of an array whose fibres should run from end to end, and break off in its elements; "" if none.
std::string doubt_of_flux(const Body& body, const Model& model, std::size_t t) {
  const Tissue& tissue = model.tissues[t];
  const std::vector<bool> holds = holding_nodes(model, t);
  if (!is_conserved_array(*body.material->fibres) || std::ranges::count(holds, true) == 0)
    return {};
  const double loose = fem::loose_flux(tissue.X, tissue.elements.tets(), tissue.fibres, holds);
  if (loose <= kMostLoose) return {};
  return fmt::format(
      "the fibres of `{}` are not conserved on this mesh: for each that ends where it is held, "
      "{:.2g} end at nodes that nothing holds, and it will pull with too little; expected an array "
      "whose flux goes on from element to element, or `from` and `to`",
      body.name, loose);
}

bool is_driven(const Muscle& muscle) { return !muscle.excitation.time.empty(); }

/// What keeps the fibres of a tissue from pulling, and where the scenario says so; "" if nothing.
std::pair<std::string, Location> doubt_of_fibres(const Body& body, const Tissue& tissue,
                                                 const Model& model) {
  const bool can_pull = tissue.active_stress > 0;
  if (tissue.muscle < 0) {
    if (!can_pull) return {};
    return {fmt::format("the fibres of `{0}` can pull with {1:.3g} kPa and never do: no [[muscle]] "
                        "has tissue = \"{0}\"",
                        body.name, 1e-3 * tissue.active_stress),
            body.material->where};
  }
  const Muscle& muscle = model.muscles[static_cast<std::size_t>(tissue.muscle)].given;
  if (!can_pull)
    return {fmt::format("muscle `{}` never pulls: the material of `{}` has no `active_stress`",
                        muscle.name, body.name),
            muscle.where};
  if (!is_driven(muscle))
    return {fmt::format("muscle `{}` has no `excitation`: the fibres of `{}` never pull",
                        muscle.name, body.name),
            muscle.where};
  if (const double share = active_share_at_rest(*body.material->law); share < kLeastShareAtRest)
    return {fmt::format("the fibres of `{}` can give only {:.1f} % of their active stress as they "
                        "are drawn: are `optimal_stretch` and `tendon_ratio` the ones that were "
                        "meant?",
                        body.name, 100 * share),
            body.material->where};
  if (const auto cosine = cosine_with_ends(tissue); cosine && *cosine < kLeastCosine)
    return {fmt::format("the fibres of `{}` run across the line between what it is tied to, at "
                        "{:.0f} degrees in the mean: "
                        "they will not draw these together",
                        body.name, std::acos(*cosine) * 180 / std::numbers::pi),
            body.material->where};
  return {};
}

/// Of the substance between fibres that pull, which should give way to them and keep its volume;
/// "" if none.
std::string doubt_of_substance(const Body& body, const Tissue& tissue) {
  const auto less = [&](const char* what, double modulus, const char* consequence) {
    return fmt::format(
        "the fibres of `{}` can pull with {:.3g} kPa, and its {} modulus is {:.3g} kPa: {}; are "
        "units those that were meant?",
        body.name, 1e-3 * tissue.active_stress, what, 1e-3 * modulus, consequence);
  };
  if (tissue.active_stress < kLeastPull) return {};
  if (tissue.shear_modulus > tissue.active_stress)
    return less("shear", tissue.shear_modulus, "it will hardly shorten");
  if (tissue.bulk_modulus < tissue.active_stress)
    return less("bulk", tissue.bulk_modulus, "it will not keep its volume");
  return {};
}

/// Stress that relaxes is that of the whole law.
std::string doubt_of_relaxation(const Body& body) {
  double sum = 0;
  for (const auto& term : body.material->relaxation) sum += term.weight;
  return fmt::format(
      "`relaxation` of `{}` takes {:.0f} % of its fibres' active stress too, not of the passive "
      "one alone",
      body.name, 100 * sum);
}

}  // namespace

std::vector<std::string> muscle_doubts(const Scenario& scenario, const Model& model) {
  std::vector<std::string> doubts;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    if (model.bodies[b].tissue < 0) continue;
    const Body& body = scenario.bodies[b];
    const auto t = static_cast<std::size_t>(model.bodies[b].tissue);
    const Tissue& tissue = model.tissues[t];
    const auto [what, where] = doubt_of_fibres(body, tissue, model);
    if (!what.empty()) doubts.push_back(prefix(where) + what);
    if (!(tissue.active_stress > 0)) continue;
    if (!body.material->relaxation.empty())
      doubts.push_back(prefix(body.material->where) + doubt_of_relaxation(body));
    if (const std::string substance = doubt_of_substance(body, tissue); !substance.empty())
      doubts.push_back(prefix(body.material->where) + substance);
    if (const std::string flux = doubt_of_flux(body, model, t); !flux.empty())
      doubts.push_back(prefix(body.material->fibres->where) + flux);
  }
  const std::vector<Muscle>& muscles = scenario.muscles;
  const auto line = std::ranges::find_if(muscles, [](const Muscle& m) { return m.tissue.empty(); });
  if (line != muscles.end() && std::ranges::none_of(muscles, is_driven))
    doubts.push_back(
        prefix(line->where) +
        fmt::format("no muscle of the scene has an `excitation`, the first one `{}`: they never "
                    "pull, and only resist being drawn out",
                    line->name));
  return doubts;
}

}  // namespace articular::sim
