#include "sim/output/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "fem/mesh/tetrahedron.hpp"
#include "sim/contact/contact_pressure.hpp"
#include "sim/contact/contact_response.hpp"
#include "sim/model/tissue.hpp"
#include "sim/step/failure_diagnosis.hpp"
#include "sim/step/run_extrema.hpp"

namespace articular::sim {
namespace {

/// Parts of the energy that was turned over. Losing is what stable schemes do; what is made is
/// wrong, and so is what stands on it.
constexpr double kMuchLost = 0.05, kMuchMade = 0.01;
/// Of the depth to which contact is followed: half an element, where it is a tissue's.
constexpr double kDeepOverlap = 0.5;
/// Of rigid bodies that are both driven or fixed: what meets as drawn overlaps by rounded numbers
/// [m].
constexpr double kDrivenDepth = 1e-6;
/// Of the volume at rest: the law "neo-hookean" stays crushed below 0.16 at ν = 0, and below 0.02
/// at ν = 0.3 (fem/THEORY.md).
constexpr double kCrushed = 0.1;
/// Of the volume at rest: elements of shipped scenarios, which resist growth next to others that
/// shrink, stay below 2.
constexpr double kSwollen = 3;
/// Of the slack length: most ligaments tear at a fifth to two fifths, and their law knows no end.
constexpr double kTorn = 0.5;
/// Of |F − I|: a beam whose end is turned by 20 degrees is off by some per cent.
constexpr double kSmallGradient = 0.5;
/// Of the smaller element: points so deep with no force at all lie between the nodes that would
/// carry it.
constexpr double kMissedDepth = 0.02;
/// In a heap hundreds of contacts may have the same fault: more lines would hide the other
/// warnings.
constexpr std::size_t kMostNamed = 4;

const std::string& name_of_body(const Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)].name;
}

/// What makes less of the energy that was made.
std::string remedy(const Model& model, Integrator::Scheme scheme) {
  const bool chooses_steps = scheme == Integrator::Scheme::Explicit;
  return fmt::format("a smaller integrator.{} makes less{}",
                     chooses_steps ? "position_tolerance" : "step",
                     model.contacts.empty() ? ""
                                            : " where the time integration made it, "
                                              "accuracy = \"accurate\" where deep contact did");
}

struct EnergyBalance {
  double loss = 0;   // [J], by the time integration; negative: made
  double whole = 0;  // [J], what was turned over
};

/// None where there is no motion to speak of.
std::optional<EnergyBalance> energy_balance(const Model& model, const State& state,
                                            const Stepper& stepper) {
  const StoredEnergy stored = stepper.stored_energy();
  const double given_off = state.energy.start - stored.total();  // what was strained at the start
  const double whole = std::max(turned_over(state), given_off);
  if (model.is_static || !(whole > energy_of_tolerance(model, stepper.settings().step)))
    return std::nullopt;
  return EnergyBalance{numerical_loss(state, stored), whole};
}

bool is_much_lost(const EnergyBalance& energy) { return energy.loss > kMuchLost * energy.whole; }

/// With friction the way to rest decides where it is.
bool rest_is_untouched(const Model& model, const State& state) {
  return is_at_rest(state) && !has_friction(model);
}

void warn_of_energy(const Model& model, const State& state, const Stepper& stepper,
                    std::vector<std::string>& warnings) {
  const std::optional<EnergyBalance> energy = energy_balance(model, state, stepper);
  if (!energy) return;
  const auto [loss, whole] = *energy;
  if (is_much_lost(*energy) && !rest_is_untouched(model, state))
    warnings.push_back(
        fmt::format("the time integration took {:.2g} J, {:.0f} % of the energy that was turned "
                    "over ({:.2g} J): motion dies out sooner than it would; a smaller "
                    "integrator.step or a scheme of higher order takes less",
                    loss, 100 * loss / whole, whole));
  if (const double made = std::max(state.extrema.made, -loss); made > kMuchMade * whole)
    warnings.push_back(fmt::format(
        "{:.2g} J were made out of nothing, {:.2g} % of the energy that was turned over "
        "({:.2g} J){}: {}",
        made, 100 * made / whole, whole, deepest_contact(model, stepper.dynamics().contacts()),
        remedy(model, stepper.settings().scheme)));
}

/// The largest |F − I| of an element.
double largest_displacement_gradient(const Tissue& tissue, const Configuration& now) {
  Positions x;
  positions_of(now, tissue.nodes, x);
  double largest = 0;
  for (const auto& tet : tissue.elements.tets().colwise()) {
    const fem::Mat34 at_start = tissue.X(Eigen::all, tet), at_end = x(Eigen::all, tet);
    const Mat3 F = fem::deformation_gradient(at_end, fem::edge_matrix(at_start).inverse());
    largest = std::max(largest, (F - Mat3::Identity()).norm());
  }
  return largest;
}

void warn_of_small_strain_laws(const Model& model, const Configuration& now,
                               std::vector<std::string>& warnings) {
  for (const Tissue& tissue : model.tissues) {
    if (tissue.bears_turning) continue;
    const double gradient = largest_displacement_gradient(tissue, now);
    if (gradient > kSmallGradient)
      warnings.push_back(fmt::format(
          "tissue `{}` has moved too far for the law \"linear\", which takes a rotation for a "
          "strain: |F - I| is {:.2g} in an element, and the law holds for small motion (less than "
          "{}); take \"corotated\" or \"neo-hookean\"",
          name_of_body(model, tissue.body), gradient, kSmallGradient));
  }
}

/// How a contact's non-mortar side lies against the other body.
struct Carrying {
  int num_nodes = 0;         // that have a pressure; point by point: not over a sliver alone
  double deepest_point = 0;  // [m]
};

Carrying carrying(const Model& model, const ContactPairState& pair_state) {
  const Eigen::VectorXd& around = sides_of(model, pair_state).triangles.group_area;
  Carrying result;
  for (const int group : pair_state.groups)
    if (pair_state.pressure[group] > 0 &&
        (pair_state.pair.averaged || pair_state.area[group] >= kLeastShare * around[group]))
      ++result.num_nodes;
  for (const ContactPairState::Patch& entry : pair_state.patches())
    result.deepest_point = std::max(result.deepest_point, entry.patch.depth_max);
  return result;
}

/// Where few nodes carry a force, or none though points lie in the other body, it is the mesh's.
bool is_unresolved(const Model& model, const ContactPairState& contact, const Carrying& found) {
  const auto body = [&](int b) -> const BodyModel& {
    return model.bodies[static_cast<std::size_t>(b)];
  };
  const BodyModel &a = body(contact.pair.a), &b = body(contact.pair.b);
  if ((a.tissue < 0 && b.tissue < 0) || found.num_nodes >= kResolvedNodes) return false;
  const double missed = kMissedDepth * std::min(a.collider->size, b.collider->size);
  return found.num_nodes > 0 || found.deepest_point > missed;
}

void warn_of_unresolved_contacts(const Model& model, const Stepper& stepper,
                                 std::vector<std::string>& warnings) {
  std::size_t count = 0;
  for (const ContactPairState* const contact : stepper.now().contact.pair_states()) {
    const Carrying found = carrying(model, *contact);
    if (!is_unresolved(model, *contact, found) || ++count > kMostNamed) continue;
    const ContactModel& pair = contact->pair;
    const std::string& carrier = name_of_body(model, pair.reversed ? pair.b : pair.a);
    const std::string who =
        found.num_nodes > 0
            ? fmt::format("{} of the nodes of `{}` carry it", found.num_nodes, carrier)
            : fmt::format(
                  "no node of `{}` carries it, though points lie {:.2g} mm in the other body",
                  carrier, 1e3 * found.deepest_point);
    warnings.push_back(fmt::format(
        "the contact of `{}` and `{}` is not resolved at the end: {}, and the force may be far "
        "off; expected smaller elements where they touch",
        name_of_body(model, pair.a), name_of_body(model, pair.b), who));
  }
  if (count > kMostNamed)
    warnings.push_back(
        fmt::format("{} more contacts are not resolved at the end either", count - kMostNamed));
}

std::string element_of(const Model& model, const ExtremeVolume& volume) {
  return fmt::format(
      "element {} of tissue `{}`", volume.element,
      name_of_body(model, model.tissues[static_cast<std::size_t>(volume.tissue)].body));
}

void warn_of_swollen_elements(const Model& model, const ExtremeVolume& largest,
                              std::vector<std::string>& warnings) {
  if (largest.ratio <= kSwollen) return;
  warnings.push_back(fmt::format(
      "{} grew to {:.2g} times its volume at t = {:.4g} s: soft tissue is mostly water and hardly "
      "grows; expected a larger bulk modulus or Poisson's ratio, smaller elements, or less of a "
      "load or motion",
      element_of(model, largest), largest.ratio, largest.at));
}

/// Muscle presses itself, and what fits it is not what fits a pad.
std::string remedy_of_crushing(const Model& model, const ExtremeVolume& least) {
  return model.tissues[static_cast<std::size_t>(least.tissue)].active_stress > 0
             ? "smaller elements, ends that are broader, or less of an excitation, motion or load"
             : "a stiffer tissue, a smaller motion or load, or another law (for what is pressed "
               "far: coupled-neo-hookean)";
}

void warn_of_squeezed_elements(const Model& model, const ExtremeVolume& least,
                               std::vector<std::string>& warnings) {
  if (least.ratio >= kCrushed) return;
  const std::string element = element_of(model, least);
  if (least.ratio <= 0)
    warnings.push_back(
        fmt::format("{} was inside out at t = {:.4g} s (volume ratio {:.3g}): it was "
                    "driven or pressed harder than its law can bear",
                    element, least.at, least.ratio));
  else
    warnings.push_back(
        fmt::format("{} was crushed to {:.2g} of its volume at t = {:.4g} s: some laws "
                    "do not spring back from there, and forces may be far too small; expected {}",
                    element, least.ratio, least.at, remedy_of_crushing(model, least)));
}

void warn_of_deep_contacts(const Model& model, const RunExtrema& extrema,
                           std::vector<std::string>& warnings) {
  const auto names = [&](const WorstContact& worst) {
    const ContactModel contact = model.contacts[worst.of];
    return fmt::format("`{}` and `{}`", name_of_body(model, contact.a),
                       name_of_body(model, contact.b));
  };
  const auto& [overlap, layer, driven] = std::tie(extrema.overlap, extrema.layer, extrema.driven);
  if (overlap.value > kDeepOverlap)
    warnings.push_back(fmt::format(
        "{} lay in each other at t = {:.4g} s, to {:.1f} times the depth to which contact is "
        "followed: one may go through the other",
        names(overlap), overlap.at, overlap.value));
  if (layer.value > 1)
    warnings.push_back(fmt::format(
        "{} were pressed into the layer between them at t = {:.4g} s, by {:.2g} times its "
        "thickness: a layer is a spring that has no end, so that bodies are too near or forces too "
        "small; expected a thicker or stiffer layer, or less of a load or motion",
        names(layer), layer.at, layer.value));
  if (driven.value > kDrivenDepth)
    warnings.push_back(fmt::format(
        "{} are both where the scenario puts them, and lay in each other by {:.3g} mm at t = "
        "{:.4g} s: nothing gives way there, and the force between them means nothing; expected a "
        "`layer` or tissue on one of them, or a body that is free to move",
        names(driven), 1e3 * driven.value, driven.at));
}

void warn_of_torn_ligaments(const Model& model, const WorstLigament& worst,
                            std::vector<std::string>& warnings) {
  if (worst.value <= kTorn) return;
  const Ligament& ligament = model.ligaments[static_cast<std::size_t>(worst.of)].given;
  warnings.push_back(fmt::format(
      "ligament `{}` was stretched by {:.0f} % at t = {:.4g} s: most tear at 20 to 40 %, and its "
      "law has no end; are its slack length and stiffness, and their units, those that were meant?",
      ligament.name, 100 * worst.value, worst.at));
}

void warn_of_snap(const Model& model, const Snap& snap, std::vector<std::string>& warnings) {
  if (snap.body < 0) return;
  warnings.push_back(fmt::format(
      "`{}` buckled, or snapped through, in the load step to t = {:.4g} s: it moved by {:.3g} mm, "
      "where its stiffness would let it move by {:.2g} mm, and lost {:.2g} J. What follows is "
      "another equilibrium, and need not be one that the body comes to; results hold until shortly "
      "before. analysis = \"dynamic\" shows where it goes",
      name_of_body(model, snap.body), snap.at, 1e3 * snap.motion, 1e3 * snap.expected, snap.loss));
}

}  // namespace

std::vector<std::string> run_warnings(const Model& model, const State& state,
                                      const Stepper& stepper) {
  std::vector<std::string> warnings;
  const RunExtrema& extrema = state.extrema;
  warn_of_squeezed_elements(model, extrema.least, warnings);
  warn_of_swollen_elements(model, extrema.largest, warnings);
  warn_of_deep_contacts(model, extrema, warnings);
  warn_of_torn_ligaments(model, extrema.strain, warnings);
  warn_of_snap(model, extrema.snap, warnings);
  warn_of_small_strain_laws(model, stepper.now().configuration, warnings);
  warn_of_unresolved_contacts(model, stepper, warnings);
  warn_of_energy(model, state, stepper, warnings);
  if (stepper.is_unstable())
    warnings.push_back(
        "the equilibrium at the end is not stable: where it is pushed a little, however little, "
        "it goes on to another one, as a straight column does under more than it bears. "
        "analysis = \"dynamic\" with a small disturbance shows where");
  for (const RigidBodyMode& motion : stepper.indifferent())
    warnings.push_back(motion.words + ": nothing holds it, and nothing drives it");
  return warnings;
}

std::vector<std::string> overlap_warnings(const Model& model,
                                          const std::vector<IgnoredOverlap>& overlaps) {
  std::vector<std::string> warnings;
  for (const IgnoredOverlap& overlap : overlaps) {
    if (warnings.size() == kMostNamed) {
      warnings.push_back(fmt::format("{} more pairs of bodies went into each other",
                                     overlaps.size() - kMostNamed));
      break;
    }
    const auto [a, b] = std::minmax(overlap.inner, overlap.outer);
    warnings.push_back(fmt::format(
        "`{}` and `{}` went into each other, by {:.3g} mm at t = {:.4g} s, and nothing "
        "kept them apart: no [[contact]] names both; expected one",
        name_of_body(model, a), name_of_body(model, b), 1e3 * overlap.depth, overlap.t));
  }
  return warnings;
}

std::vector<std::string> run_notes(const Model& model, const State& state, const Stepper& stepper) {
  const std::optional<EnergyBalance> energy = energy_balance(model, state, stepper);
  if (!energy || !is_much_lost(*energy) || !rest_is_untouched(model, state)) return {};
  return {fmt::format(
      "motion died out sooner than it would: the time integration took {:.2g} J, {:.0f} % of the "
      "energy that was turned over ({:.2g} J). What rests from t = {:.4g} s on is not touched by "
      "that, but how things moved before is; a smaller integrator.step takes less",
      energy->loss, 100 * energy->loss / energy->whole, energy->whole, state.extrema.moved_at)};
}

}  // namespace articular::sim
