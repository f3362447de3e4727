#pragma once

#include <deque>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/contact/contact_pair_state.hpp"
#include "sim/contact/contact_search.hpp"

/// The penalty response on contact candidates: patches of a side's triangles opposite the other
/// side's faces (contact_patch.hpp) make an energy of their depths.
///
/// Averaged (in statics, or where the scenario asks for it) depths count at the nodes a of one
/// side,
///
///   g_a = G_a / A_a,   E = ½ Σ k_a A_a <g_a>²,   p_a = k_a <g_a>,
///
/// G_a and W_a summed over the patches around a, A_a = √(W_a T_a) with the node's share T_a of all
/// triangles there: where they are covered A = W = T; a covered sliver counts little. A node
/// between creases has several a, one for each smoothing group around it (smoothing_groups.hpp). A
/// mean depth lets a faceted soft surface rest on a round bone where a pointwise one would carry on
/// a few spots only, so that k may be large: a mortar method whose multipliers p_a the penalty
/// gives [Puso 2004].
///
/// Where a g_a exceeds the contact's max_penetration all the same, multipliers λ_a take over what
/// the penalty carried, p_a = <λ_a + k_a g_a> (augment(): Uzawa's method).
///
/// Else they count point by point, E = ½ k ∫ <d>² dA, on one side's triangles.
///
/// [Puso 2004] Puso, Laursen. A mortar segment-to-segment contact method for large deformation
/// solid mechanics. Comput Methods Appl Mech Eng 193:601.
namespace articular::sim {

/// Of contacts in ascending order; 0 of all others.
class ContactDepths {
 public:
  /// @param contact  greater than those before
  void add(ContactId contact, double depth) { depths_.emplace_back(contact, depth); }
  double of(ContactId contact) const;
  const std::vector<std::pair<ContactId, double>>& all() const { return depths_; }

 private:
  std::vector<std::pair<ContactId, double>> depths_;  // [m]
};

struct ContactConditions {
  bool soft = false;                          // with the soft stiffness of the ContactModel
  const ContactDepths* allowances = nullptr;  // that contacts may have; none: 0
};

/// Faces of one body where they are now, each computed when it is met first.
struct MetFaces {
  std::vector<FlatTriangle> face;
  std::vector<int> met;  // by face: when it was computed last
  int now = 0;
  double steepness = 1;  // of their rim heights, by the pair
};

class ContactResponse {
 public:
  explicit ContactResponse(const Model& model);
  ContactResponse(const ContactResponse&) = delete;
  ContactResponse& operator=(const ContactResponse&) = delete;
  /// Where averaged depths exceed a bounded contact's max_penetration: from the next evaluate() on,
  /// λ = p. @return whether any does
  bool augment();
  /// From the next evaluate() on, λ = 0.
  void drop_multipliers();
  /// From the next evaluate() on, friction duals are those after a change of the blocks'
  /// velocities.
  void update_friction_duals(const Configuration& configuration, const Eigen::VectorXd& change);
  /// From the next evaluate() on, there are none.
  void drop_friction_duals();
  /// From the next evaluate() on there are neither multipliers nor friction duals. What pairs that
  /// were near once took of memory is given back.
  void forget();

  /// Depths and pressures of the candidates in a configuration; what follows is about it.
  void evaluate(const Configuration& configuration, std::span<const CandidateList> candidates,
                const ContactConditions& conditions);

  /// Those that have candidates, in the order of the contacts.
  std::span<const ContactPairState* const> pair_states() const { return near_; }
  /// For what is foreseen of them.
  std::span<ContactPairState* const> pair_states() { return near_; }
  /// From the next matrix on, groups do what they do now.
  void forget_foreseen();

  /// f += contact forces (block forces).
  void add_force(const Configuration& configuration, Eigen::VectorXd& f);
  /// f += scale D u for block velocities u, with the D of friction and damping.
  void add_damping_product(const Configuration& configuration, const Eigen::VectorXd& u,
                           double scale, Eigen::VectorXd& f) const;
  /// What friction and damping lose [W].
  double damping_power() const;

  /// Of what acts between surfaces.
  const EvaluationCounts& evaluations() const { return evaluations_; }

  /// Something lies opposite a face within the depths that count.
  bool has_patches() const;
  /// How far any point of one body is behind a face of the other [m], whether or not the mean
  /// around a node is.
  ContactDepths point_depths() const;
  /// Of each contact, the largest mean depth around a node that presses [m].
  ContactDepths node_depths() const;
  double stored_energy() const;  // [J]
  /// On one node [N]: what a residual is small against.
  double largest_force() const;
  /// By body [N]: the sizes of the forces from others, one a pair and side, of the last
  /// add_force().
  const std::vector<double>& force_on_bodies() const { return force_on_bodies_; }

 private:
  ContactPairState& pair_state_of(const CandidateList& list);
  /// Sets what belongs to the last configuration to nothing.
  void clear(ContactPairState& pair_state) const;
  void count(const ContactModel& contact);
  void find_pressures(const Configuration& configuration, bool soft,
                      ContactPairState& pair_state) const;

  const Model& model_;
  std::deque<ContactPairState> pair_states_;  // all that have had candidates so far
  std::unordered_map<ContactId, ContactPairState*> of_contact_;
  std::vector<ContactPairState*> near_;  // those that have some now

  std::vector<double> force_on_bodies_;
  EvaluationCounts evaluations_;
  std::vector<MetFaces> met_;  // by worker
};

}  // namespace articular::sim
