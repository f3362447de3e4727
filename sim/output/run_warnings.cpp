#include "sim/output/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/step/failure_diagnosis.hpp"
#include "sim/step/run_extrema.hpp"

namespace articular::sim {
namespace {

/// Parts of the energy that was turned over. Losing is what stable schemes do; what is made is
/// wrong, and so is what stands on it.
constexpr double kMuchLost = 0.05, kMuchMade = 0.01;
/// Of the depth to which contact is followed: half an element, where it is a tissue's.
constexpr double kDeep = 0.5;

const std::string& name_of(const Model& model, int body) {
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

void warn_of_energy(const Model& model, const State& state, const Stepper& stepper,
                    std::vector<std::string>& warnings) {
  if (model.is_static) return;
  const double loss = numerical_loss(state, stepper.stored_energy()), whole = turned_over(state);
  if (!(whole > energy_of_tolerance(model, stepper.settings().step))) return;
  if (loss > kMuchLost * whole)
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

}  // namespace

std::vector<std::string> run_warnings(const Model& model, const State& state,
                                      const Stepper& stepper) {
  std::vector<std::string> warnings;
  const RunExtrema& extrema = state.extrema;
  if (extrema.volume_ratio <= 0)
    warnings.push_back(fmt::format(
        "element {} of tissue `{}` was inside out at t = {:.4g} s (volume ratio {:.3g}): it was "
        "driven or pressed harder than its law can bear",
        extrema.element,
        name_of(model, model.tissues[static_cast<std::size_t>(extrema.tissue)].body),
        extrema.squeezed_at, extrema.volume_ratio));
  if (extrema.overlap > kDeep) {
    const ContactModel& contact = model.contacts[static_cast<std::size_t>(extrema.contact)];
    warnings.push_back(fmt::format(
        "`{}` and `{}` lay in each other at t = {:.4g} s, to {:.1f} times the depth to which "
        "contact is followed: one may go through the other",
        name_of(model, contact.a), name_of(model, contact.b), extrema.overlap_at, extrema.overlap));
  }
  warn_of_energy(model, state, stepper, warnings);
  for (const RigidBodyMode& motion : stepper.indifferent())
    warnings.push_back(motion.words + ": nothing holds it, and nothing drives it");
  return warnings;
}

}  // namespace articular::sim
