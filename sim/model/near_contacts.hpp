#pragma once

#include <span>
#include <vector>

#include "collision/mesh/box_tree.hpp"
#include "sim/model/contact_pairs.hpp"

namespace articular::sim {

/// Of all pairs that may touch, those that are near each other.
class NearContacts {
 public:
  /// The contacts of bodies whose boxes overlap, and those of bodies with themselves, in ascending
  /// order; valid until the next call.
  /// @param boxes  by body [m]; empty: it touches nothing
  const std::vector<ContactId>& find(const ContactPairs& contacts,
                                     std::span<const collision::Aabb> boxes);

  /// Pairs of boxes that the last find() compared: of bodies, or of many of them together.
  std::int64_t num_tests() const { return tree_.num_tests(); }

 private:
  collision::BoxTree tree_;
  std::vector<ContactId> found_;
};

struct Model;

/// The same where bodies are at the start, with boxes that are larger by a part of the elements at
/// their surfaces on either side.
std::vector<ContactId> contacts_near_at_start(const Model& model, double part_of_element);

}  // namespace articular::sim
