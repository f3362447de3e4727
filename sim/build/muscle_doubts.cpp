#include "sim/build/muscle_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/material/any_material.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {
namespace {

/// A muscle begins at less of its largest active force hardly by intent.
constexpr double kLeastShareAtRest = 0.2;

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
  return {};
}

}  // namespace

std::vector<std::string> muscle_doubts(const Scenario& scenario, const Model& model) {
  std::vector<std::string> doubts;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    const int t = model.bodies[b].tissue;
    if (t < 0) continue;
    const auto [what, where] =
        doubt_of_fibres(scenario.bodies[b], model.tissues[static_cast<std::size_t>(t)], model);
    if (!what.empty()) doubts.push_back(prefix(where) + what);
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
