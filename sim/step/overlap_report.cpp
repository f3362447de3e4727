#include "sim/step/overlap_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/base/place_text.hpp"
#include "sim/contact/initial_overlap.hpp"
#include "sim/step/overlap_resolution.hpp"

namespace articular::sim {
namespace {

/// Of an element, whose hundredth is the penetration that contact allows.
constexpr double kDeep = 0.25, kAllowed = 0.01;

std::string pair_of(const Model& model, const ContactModel& contact) {
  const std::string& a = model.bodies[static_cast<std::size_t>(contact.a)].name;
  if (contact.a == contact.b) return fmt::format("`{}` and itself", a);
  return fmt::format("`{}` and `{}`", a, model.bodies[static_cast<std::size_t>(contact.b)].name);
}

/// By the surfaces as drawn.
std::string as_drawn(const InitialOverlap& overlap) {
  return fmt::format(" overlap at the start by {:.3g} mm, at {}, {} node{}", 1e3 * overlap.depth,
                     place_text(overlap.place), overlap.num_nodes,
                     overlap.num_nodes == 1 ? " of one in the other" : "s in the other body");
}

std::string what_run_does(const ContactModel& contact, const OverlapAtStart* found, bool is_deep) {
  if (found == nullptr) return "contact finds nothing of it, for the mean around each node is open";
  if (found->is_set_apart && is_deep)
    return "`run` sets them apart first, which moves tissue by that much, and the first row of the "
           "history is before any equilibrium; expected bodies that do not overlap";
  if (found->is_set_apart) return "`run` sets them apart first";
  return fmt::format(
      "`run` starts so, pressed together, for it is below 1/100 of an element ({:.3g} mm)",
      1e3 * contact.max_penetration);
}

}  // namespace

std::vector<OverlapReport> overlap_reports(const Scenario& scenario, const Model& model,
                                           const Eigen::VectorXd& y) {
  const std::vector<OverlapAtStart> found = overlaps_at_start(scenario, model, y);
  const std::vector<InitialOverlap> drawn = initial_overlaps(model);
  std::set<ContactId> contacts;
  for (const OverlapAtStart& overlap : found) contacts.insert(overlap.contact);
  for (const InitialOverlap& overlap : drawn) contacts.insert(overlap.contact);
  std::vector<OverlapReport> reports;
  for (const ContactId id : contacts) {
    const ContactModel contact = model.contacts[id];
    const auto is_it = [&](const auto& overlap) { return overlap.contact == id; };
    const auto by_contact = std::find_if(found.begin(), found.end(), is_it);
    const auto by_faces = std::find_if(drawn.begin(), drawn.end(), is_it);
    const OverlapAtStart* const of_contact = by_contact == found.end() ? nullptr : &*by_contact;
    if (of_contact == nullptr &&
        (by_faces == drawn.end() || by_faces->depth <= contact.max_penetration))
      continue;
    const double depth = std::max(by_faces != drawn.end() ? by_faces->depth : 0,
                                  of_contact != nullptr ? of_contact->depth : 0);
    const bool is_deep = depth > kDeep / kAllowed * contact.max_penetration;
    const std::string size =
        by_faces != drawn.end()
            ? as_drawn(*by_faces)
            : fmt::format(" overlap at the start by {:.3g} mm", 1e3 * by_contact->depth);
    reports.push_back(
        {id, of_contact != nullptr && of_contact->is_set_apart, is_deep,
         pair_of(model, contact) + size + ": " + what_run_does(contact, of_contact, is_deep)});
  }
  return reports;
}

void warn_of_overlaps(const Scenario& scenario, Model& model) {
  try {
    for (OverlapReport& overlap : overlap_reports(scenario, model, initial_state(model)))
      if (!overlap.is_set_apart || overlap.is_deep)
        model.warnings.push_back(std::move(overlap.words));
  } catch (const SimulationError&) {
    return;
  }
}

}  // namespace articular::sim
