#include "sim/model/near_contacts.hpp"

#include <algorithm>

#include "sim/model/model.hpp"

namespace articular::sim {

const std::vector<ContactId>& NearContacts::find(const ContactPairs& contacts,
                                                 std::span<const collision::Aabb> boxes) {
  found_ = contacts.of_bodies_with_themselves();
  for (const collision::BodyPair& pair : tree_.overlapping_bodies(boxes))
    if (const auto contact = contacts.between(pair.first, pair.second)) found_.push_back(*contact);
  std::sort(found_.begin(), found_.end());
  return found_;
}

std::vector<ContactId> contacts_near_at_start(const Model& model, double part_of_element) {
  std::vector<collision::Aabb> boxes(model.bodies.size());
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const auto& collider = model.bodies[b].collider;
    if (!collider) continue;
    for (const Vec3 x : collider->X.colwise()) boxes[b].include(x);
    boxes[b].inflate(part_of_element * collider->size);
  }
  return NearContacts().find(model.contacts, boxes);
}

}  // namespace articular::sim
