#include "sim/step/failure_diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

const std::string& name_of(const Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)].name;
}

std::string most_squeezed(const Model& model, const Configuration& tried) {
  std::string words;
  double least = 1;
  Positions x;
  for (const Tissue& tissue : model.tissues) {
    positions_of(tried, tissue.nodes, x);
    if (!x.allFinite()) continue;  // nothing to be learnt from
    Eigen::Index worst = 0;
    const double lowest = tissue.elements.volume_ratio(x).minCoeff(&worst);
    if (!(lowest < least)) continue;
    least = lowest;
    words = fmt::format("; the most squeezed element is {} of tissue `{}` (volume ratio {:.3g})",
                        worst, name_of(model, tissue.body), lowest);
    if (!tissue.law_ends.empty()) words += fmt::format(": {}", tissue.law_ends);
  }
  return words;
}

std::string fastest(const Model& model, const Configuration& start) {
  std::string words;
  double most = 0;  // [m/s]
  for (const Tissue& tissue : model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      if (tissue.nodes[i].rigid >= 0) continue;
      const double speed = start.velocity(tissue.nodes[i]).norm();
      if (!(speed > most)) continue;
      most = speed;
      words = fmt::format("; the fastest is node {} of tissue `{}` ({:.3g} m/s)", i,
                          name_of(model, tissue.body), speed);
    }
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const double speed = start.velocities[b].linear.norm();
    if (!(speed > most)) continue;
    most = speed;
    words = fmt::format("; the fastest is body `{}` ({:.3g} m/s)",
                        name_of(model, model.rigid_bodies[b].body), speed);
  }
  return words;
}

}  // namespace

std::string failure_diagnosis(const Model& model, const Configuration& start,
                              const Configuration& tried) {
  return most_squeezed(model, tried) + fastest(model, start);
}

std::string what_gives_way(const Model& model) {
  std::string words;
  for (const Tissue& tissue : model.tissues)
    if (!tissue.law_ends.empty())
      words += fmt::format("; or tissue `{}` gives way: {}", name_of(model, tissue.body),
                           tissue.law_ends);
  for (const BodyModel& body : model.bodies)
    if (body.collider && body.collider->layer_thickness > 0)
      words += fmt::format("; or the layer of `{}`, {:.3g} mm thick, is pressed through", body.name,
                           1e3 * body.collider->layer_thickness);
  return words;
}

std::string deepest_contact(const Model& model, const std::vector<ContactSummary>& contacts) {
  const auto most = std::max_element(
      contacts.begin(), contacts.end(),
      [](const ContactSummary& a, const ContactSummary& b) { return a.energy < b.energy; });
  if (most == contacts.end() || !(most->energy > 0)) return {};
  const ContactModel pair = model.contacts[most->contact];
  return fmt::format("; contact of `{}` and `{}` holds {:.2g} J, {:.3g} mm deep",
                     name_of(model, pair.a), name_of(model, pair.b), most->energy,
                     1e3 * most->max_depth);
}

}  // namespace articular::sim
