#include "sim/output/fingerprint.hpp"

#include <fmt/format.h>

#include "sim/base/hash.hpp"

namespace articular::sim {

std::string fingerprint(const Scenario& scenario, const Model& model) {
  std::string bytes = scenario.content;
  const auto put = [&bytes](double value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto put_numbers = [&bytes](const auto& matrix) {
    bytes.append(reinterpret_cast<const char*>(matrix.data()),
                 static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data()));
  };
  put_numbers(initial_state(model));
  for (const BodyModel& body : model.bodies) {
    put_numbers(body.X);
    if (body.collider) put_numbers(body.collider->X);
    if (body.collider) put_numbers(body.collider->tets);
  }
  for (const Tissue& tissue : model.tissues) {
    put_numbers(tissue.elements.tets());
    put_numbers(tissue.fibres);
    for (const SheetModel& sheet : tissue.sheets) {
      put_numbers(sheet.fibres.faces());
      // Where its fibres point shows in how far each is drawn out as the tissue is sheared.
      const Mat3 sheared{{2, 1, 0}, {0, 3, 1}, {1, 0, 5}};
      put_numbers(sheet.fibres.stretch(sheared * tissue.X));
    }
  }
  for (const RigidBody& rigid : model.rigid_bodies) put_numbers(rigid.rest.p);
  const auto put_motion = [&](const std::optional<Motion>& motion) {
    if (!motion) return;
    for (const double t : motion->time) put(t);
    for (const Vec3& shift : motion->translation) put_numbers(shift);
    for (const Vec3& turn : motion->rotation) put_numbers(turn);
  };
  for (const RigidBody& rigid : model.rigid_bodies) put_motion(rigid.motion);
  for (const SupportModel& support : model.supports) put_motion(support.motion);
  for (const MuscleModel& muscle : model.muscles) {
    put(muscle.given.max_force);
    put(muscle.given.max_length_ratio);
    put(muscle.given.tendon_ratio);
  }
  for (const Line& line : model.lines) put(line.start_length);
  return fmt::format("{:016x}", hash_bytes(bytes));
}

}  // namespace articular::sim
