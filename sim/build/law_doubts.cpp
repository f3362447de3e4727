#include "sim/build/law_doubts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "sim/build/usual.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

// Brain has a shear modulus of about 500 Pa, tendon and plastics have less than 4e8 Pa (Young's
// modulus 1 GPa), bone has more. Fibres of muscle pull with up to 1 MPa.
constexpr Usual kShearModulus{10, 4e8}, kFibreStress{1e3, 3e6}, kPrestretch{1, 1.2},
    kToeEnd{1, 1.5}, kDampingTime{0, 1};

/// Of the stiffness just before the toe ends: published constants of ligaments have 0.8 to 7 times
/// as much when straight, and of a tissue that hardly has fibres both are that of the rest.
constexpr double kLeastWhenStraight = 0.3;

/// Whether tissue that is drawn out, along its fibres if it has some, pushes outwards where its
/// width is held. Small bulk moduli let it swell, and fibres that count the stretch at constant
/// volume then hardly stretch [Helfenstein 2010].
/// [Helfenstein 2010] Helfenstein, Jabareen, Mazza, Govindjee. On non-physical response in models
///                    for fiber-reinforced hyperelastic materials. Int. J. Solids Struct. 47.
bool gets_wider(const fem::AnyMaterial& law) {
  constexpr double kStretch = 1.1, kLeastPart = 0.1;  // of the pull along, that it pushes
  const FibreDirections along = Vec3::UnitZ();
  const fem::PointLaw point(law, along, 0, 0);
  const Mat3 F = Vec3(1, 1, kStretch).asDiagonal();
  const Mat3 more = point.first_piola(F) - point.first_piola(Mat3::Identity());
  return more(0, 0) < -kLeastPart * more(2, 2);
}

/// How much stiffer a rod is just beyond the end of its fibres' toe than just before, drawn at
/// constant volume along them.
double stiffening_at_toe_end(const fem::AnyMaterial& law, double toe_end) {
  constexpr double kNear = 0.02;  // of the toe
  const FibreDirections along = Vec3::UnitZ();
  const fem::PointLaw point(law, along, 0, 0);
  const auto pull = [&](double stretch) {  // dΨ/dλ [Pa]
    const double across = 1 / std::sqrt(stretch);
    const Mat3 P = point.first_piola(Vec3(across, across, stretch).asDiagonal());
    return P(2, 2) - 0.5 * across / stretch * (P(0, 0) + P(1, 1));
  };
  const double end = toe_end / fem::prestretch(law), step = kNear * (end - 1);
  return (pull(end + step) - pull(end)) / (pull(end) - pull(end - step));
}

/// Of collagen: stretches that were given as strains or in per cent, and constants of several
/// units. "" if nothing.
std::string doubt_of_collagen(const std::string& body, const fem::AnyMaterial& law) {
  if (const double stretch = fem::prestretch(law); !is_usual(stretch, kPrestretch))
    return fmt::format("the `prestretch` of `{}` is {:.3g}, usual is 1 to {:g}, as in 1.03 for 3 %",
                       body, stretch, kPrestretch.most);
  const std::optional<double> toe_end = fem::toe_end(law);
  if (!toe_end) return "";
  if (!is_usual(*toe_end, kToeEnd))
    return fmt::format(
        "the toe of the fibres of `{}` ends at a stretch of {:.3g}, usual is up to {:g}, as in "
        "1.03 for 3 %",
        body, *toe_end, kToeEnd.most);
  if (*toe_end <= fem::prestretch(law)) return "";
  const double stiffening = stiffening_at_toe_end(law, *toe_end);
  if (stiffening >= kLeastWhenStraight) return "";
  return fmt::format(
      "the fibres of `{}` give way when they are straight: beyond a stretch of {:.3g} it has "
      "{:.2g} of its stiffness just before, and collagen is stiffest there",
      body, *toe_end, stiffening);
}

}  // namespace

std::vector<std::string> law_doubts(const Scenario& scenario, const Model& model) {
  std::vector<std::string> doubts;
  for (std::size_t b = 0; b < scenario.bodies.size(); ++b) {
    if (model.bodies[b].tissue < 0) continue;
    const Body& body = scenario.bodies[b];
    const fem::AnyMaterial& law = *body.material->law;
    const Tissue& tissue = model.tissues[static_cast<std::size_t>(model.bodies[b].tissue)];
    const auto doubt = [&](const std::string& what) {
      doubts.push_back(unit_doubt(body.material->where, what));
    };
    if (!is_usual(tissue.shear_modulus, kShearModulus))
      doubt(fmt::format("`{}` has a shear modulus of {:.3g} Pa, usual is {:g} Pa to {:g} MPa",
                        body.name, tissue.shear_modulus, kShearModulus.least,
                        1e-6 * kShearModulus.most));
    if (tissue.active_stress > 0 && !is_usual(tissue.active_stress, kFibreStress))
      doubt(fmt::format("fibres of `{}` pull with {:.3g} MPa, usual is 0.01 to 1 MPa", body.name,
                        1e-6 * tissue.active_stress));
    if (const std::string what = doubt_of_collagen(body.name, law); !what.empty())
      doubt(what);
    else if (gets_wider(law))
      doubt(fmt::format(
          "drawn out{} `{}` gets wider: its bulk modulus of {:.3g} kPa is too small "
          "beside what else holds it together",
          body.material->fibres ? " along its fibres" : "", body.name, 1e-3 * tissue.bulk_modulus));
    if (scenario.analysis == Scenario::Analysis::Dynamic &&
        !is_usual(body.material->stiffness_damping, kDampingTime))
      doubt(
          fmt::format("the `stiffness_damping` of `{}` is {:.3g} s, usual is up to {:g} s: the "
                      "time that it takes to give way",
                      body.name, body.material->stiffness_damping, kDampingTime.most));
  }
  return doubts;
}

}  // namespace articular::sim
