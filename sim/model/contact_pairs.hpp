#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sim/model/layer_law.hpp"
#include "sim/model/surface_law.hpp"

/// Which bodies may touch which, and how. Of n bodies that may all touch there are n(n−1)/2 pairs,
/// of which few are ever near: a pair is made when it is asked for, and what is kept grows with n.
namespace articular::sim {

struct Collider;

/// A pair of bodies that may touch; its numbers are alike for all who ask.
struct ContactModel {
  int a = 0, b = 0;            // bodies; a == b: with itself
  bool averaged = true;        // depths are averaged at the nodes of one side; else pointwise
  bool reversed = false;       // b's triangles look for a's faces
  double mean_stiffness = 0;   // of the two sides in series [Pa/m]
  double max_penetration = 0;  // [m] mean depth at a node that the penalty may take
  bool is_bounded = false;     // where it takes more, it is helped: see ContactResponse
  double share = 1;            // ½ where both folds of one body look for the other
  SurfaceLaw law;              // its damping times `share`
  // Of the stiffness at a node, see stiffness_at_groups():
  double factor = 1, soft_factor = 1;
  double softening = 1;  // of the non-mortar side's compliance
  double opposite = 0;   // mean compliance of the other side [m/Pa]
  double layers = 0;     // that of the layers on both, at no depth [m/Pa]
  // Those of `layers` that stiffen; of such a pair depths are averaged.
  std::array<LogarithmicLayer, 2> logarithmic;
  bool stiffens() const { return logarithmic[0].thickness > 0 || logarithmic[1].thickness > 0; }

  /// An iteration that comes from afar starts with another stiffness.
  bool starts_soft() const { return averaged && factor != soft_factor && softening + opposite > 0; }
};

/// share · k_a [Pa/m] at the smoothing groups a of the non-mortar side, at no depth: of averaged
/// depths 1/k_a = (s h_a/M + c)/f + l, of the elements h_a/M there, softened by s, the other side's
/// c and the layers' l. @param soft  with the soft factor for f
Eigen::VectorXd stiffness_at_groups(const ContactModel& contact, const Collider& nonmortar,
                                    bool soft);

/// What gives way of a pair that stiffens, with all that is linear taken together.
/// @param stiffness  k_a [Pa/m], of all of it at no depth
LayersInSeries layers_of(const ContactModel& contact, double stiffness);

/// Names a pair, and orders pairs: first those that the scenario names one by one, in its order,
/// then all others by their bodies. No number of things to be stored by.
using ContactId = std::int64_t;

class ContactPairs {
 public:
  /// A body among many: bit p of `first` says that it is in the first set of the pth entry that
  /// goes by sets; of entries that fit a pair, the one of the lowest bit holds.
  struct Member {
    std::uint64_t first = 0, second = 0;
    bool is_fixed = false;  // two of these never touch, unless they are named
    bool is_tissue = false;
    double size = 0;  // [m] of the elements at its surface
  };
  /// Two bodies that an entry names.
  struct Named {
    int a = 0, b = 0;
    std::size_t entry = 0;
  };
  /// What an entry does to two bodies; of sets, the entry is the number of the bit.
  struct Makers {
    std::function<ContactModel(const Named&)> of_named;
    std::function<ContactModel(int a, int b, std::size_t bit)> of_members;
  };

  ContactPairs() = default;  // nothing touches
  /// @param members  one a body. None is named twice
  ContactPairs(std::vector<Named> named, std::vector<Member> members, Makers makers);

  bool empty() const { return size_ == 0; }
  /// How many pairs may touch.
  std::int64_t size() const { return size_; }
  ContactModel operator[](ContactId contact) const;
  /// Of two bodies in any order; none: they do not touch.
  std::optional<ContactId> between(int a, int b) const;
  const std::vector<ContactId>& of_bodies_with_themselves() const { return selves_; }
  bool touches(int body) const { return !empty() && touches_[static_cast<std::size_t>(body)] != 0; }
  /// A pair of each kind: what any pair does, the friction that any has, one of these does too,
  /// with elements as small.
  const std::vector<ContactId>& kinds() const { return kinds_; }
  template <class Has>
  bool any(Has&& has) const {
    for (const ContactId contact : kinds_)
      if (has((*this)[contact])) return true;
    return false;
  }
  /// In ascending order; takes time and memory of their number.
  std::vector<ContactId> all() const;

  /// Nothing else touches; its number is another one.
  ContactPairs only(ContactId contact) const;
  /// All numbers stay.
  ContactPairs without(ContactId contact) const;
  /// From now on pairs are changed so as they are made.
  void change(std::function<void(ContactModel&)> by);

 private:
  using Bodies = std::pair<int, int>;  // the lower one first
  int num_bodies() const { return static_cast<int>(members_.size()); }
  std::optional<std::size_t> bit_of(int a, int b) const;
  ContactId pairs_before(ContactId body) const;
  ContactId id_of(const Bodies& bodies) const;
  Bodies members_of(ContactId contact) const;
  void count();

  std::vector<Named> named_;
  std::map<Bodies, ContactId> id_of_named_;
  std::vector<Member> members_;
  Makers makers_;
  std::optional<Bodies> left_out_;
  std::int64_t size_ = 0;
  std::vector<ContactId> selves_, kinds_;
  std::vector<char> touches_;
};

}  // namespace articular::sim
