#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/contact_friction.hpp"
#include "sim/contact_patch.hpp"
#include "sim/contact_search.hpp"
#include "sim/system_matrix.hpp"

/// The penalty response on contact candidates: patches of a side's triangles opposite the other
/// side's faces (contact_patch.hpp) make an energy of their depths.
///
/// In statics depths are averaged at the nodes a of one side,
///
///   g_a = G_a / A_a,   E = ½ Σ k_a A_a <g_a>²,   p_a = k_a <g_a>,
///
/// G_a summed over the patches around a, A_a = Σ √(W_a T/3) over the triangles (area T) there: the
/// node's share of them where they are covered; a covered sliver counts little. A mean depth lets a
/// faceted soft surface rest on a round bone where a pointwise one would carry on a few spots only,
/// so that k may be large: a mortar method whose multipliers p_a the penalty gives [Puso 2004].
///
/// Where a g_a exceeds the contact's max_penetration all the same, multipliers λ_a take over what
/// the penalty carried, p_a = <λ_a + k_a g_a> (augment(): Uzawa's method).
///
/// In time depths count pointwise, E = ½ k ∫ <d>² dA, from either side with half of k; where a
/// mean depth at a node exceeds a bound that the scenario sets, k is raised (set_stiffening()).
///
/// [Puso 2004] Puso, Laursen. A mortar segment-to-segment contact method for large deformation
/// solid mechanics. Comput Methods Appl Mech Eng 193:601.
namespace articular::sim {

/// One direction of a contact pair in a configuration.
struct DirectionMoment {
  struct Patch {
    ContactPatch patch;
    int triangle = 0, face = 0;
  };
  std::vector<Patch> stored;  // never shrinks: the patches are the first ones
  std::size_t num_patches = 0;
  std::span<const Patch> patches() const { return {stored.data(), num_patches}; }
  // By node of the side whose triangles these are; zero where it meets nothing:
  Eigen::VectorXd area;        // W [m²]
  Eigen::VectorXd measure;     // A [m²]
  Eigen::VectorXd depth;       // g [m]
  Eigen::VectorXd pressure;    // p [Pa], with that of damping
  Eigen::VectorXd multiplier;  // λ [Pa]; empty: none
  std::vector<int> nodes;      // that have an area
  /// Where depths are not averaged, of each point [Pa/m]; then g and p above are but means.
  double point_stiffness = 0;
  std::vector<NodalDrag> drag;  // empty: neither friction nor damping
};

/// Whether a node of the triangle has pressure.
bool carries(const DirectionMoment& direction, int triangle, const Eigen::Matrix3Xi& faces);

/// The six nodes of a patch: the triangle's, then the face's.
std::array<const NodeRef*, 6> nodes_of(const Collider& triangles, const Collider& faces,
                                       int triangle, int face);

/// What one contact pair carries; force and moment on body a, of a body with itself none.
struct ContactSummary {
  Vec3 force = Vec3::Zero();     // [N]
  Vec3 center = Vec3::Zero();    // ∫ p x dA / ∫ p dA [m]; where nothing carries, the origin
  Vec3 moment = Vec3::Zero();    // about that centre [N m]
  double area = 0;               // [m²] rest area of the nodes that carry
  double normal_force = 0;       // ∫ p dA over it [N]
  double max_pressure = 0;       // [Pa] at a node
  double max_face_pressure = 0;  // [Pa] normal force through a face, of either body, over its area
  double max_depth = 0;          // [m] mean depth at a node
  Vec3 deepest = Vec3::Zero();   // that node [m]
  double max_point_depth = 0;    // [m] of any point: facets can't follow a curve
  double energy = 0;             // [J]
};

/// What contact with all others puts on the surface of one body.
struct SurfaceContact {
  Eigen::VectorXd node_pressure;  // [Pa] mean of p around a node over what lies opposite another
                                  // surface: at nodes that depths are averaged at, their p
  Eigen::VectorXd face_pressure;  // [Pa] normal force through a face over its area now
  Eigen::VectorXd face_gap;       // [m] mean over what lies opposite another surface, < 0 in
                                  // penetration; NaN where nothing does within the open depth
};

class ContactResponse {
 public:
  explicit ContactResponse(const Model& model);
  /// From the next evaluate() on, with the soft stiffness of the ContactModel.
  void set_soft(bool soft) { soft_ = soft; }
  /// From the next evaluate() on, k of each contact is that of the model times these; empty: 1.
  void set_stiffening(const Eigen::VectorXd& factors) { stiffening_ = factors; }
  /// Where averaged depths exceed a bounded contact's max_penetration: from the next evaluate() on,
  /// λ = p. @return whether any does
  bool augment();
  /// From the next evaluate() on, λ = 0.
  void drop_multipliers();
  /// From the next evaluate() on, this part of each contact's depth is allowed [m]; empty: none.
  void set_allowances(std::vector<double> allowances) { allowances_ = std::move(allowances); }

  /// Depths and pressures of the candidates in a configuration; what follows is about it.
  void evaluate(const Configuration& configuration, const std::vector<CandidateList>& candidates);

  /// f += contact forces (block forces).
  void add_force(const Configuration& configuration, Eigen::VectorXd& f);
  /// A += contact stiffness: all of it, or (projected) the positive semidefinite part
  /// Σ k_a W_a ∇g_a ∇g_aᵀ; and the damping. How friction grows with the pressure is left out: it is
  /// not symmetric.
  void add_stiffness(const Configuration& configuration, fem::Tangent tangent,
                     const SystemScale& scale, fem::BlockMatrix& A);
  /// f += scale D u for block velocities u, with the D of friction and damping.
  void add_damping_product(const Configuration& configuration, const Eigen::VectorXd& u,
                           double scale, Eigen::VectorXd& f) const;
  /// What friction and damping lose [W].
  double damping_power() const;

  /// Of what acts between surfaces.
  const EvaluationCounts& evaluations() const { return evaluations_; }

  /// Something lies opposite a face within the depths that count.
  bool has_patches() const;
  /// By contact: how far any point of one body is behind a face of the other [m], whether or not
  /// the mean around a node is; 0 where none is.
  std::vector<double> point_depths() const;
  /// On one node [N]: what a residual is small against.
  double largest_force() const;
  /// By body [N]: the sizes of the forces from others, one a pair and side, of the last
  /// add_force().
  const std::vector<double>& force_on_bodies() const { return force_on_bodies_; }

  /// One a contact of the model.
  std::vector<ContactSummary> summaries(const Configuration& configuration) const;
  /// What one contact carries through a part of a body's surface.
  /// @param selected  by face of the body's collider; the body is one of the contact's two; empty:
  /// all
  ContactSummary summary_through(const Configuration& configuration, int contact, int body,
                                 const std::vector<char>& selected) const;
  /// Contact force at each node of each collider [N] (by body), for output.
  std::vector<Positions> nodal_forces() const;
  /// By body, over the nodes and faces of its collider; empty without one. For output.
  std::vector<SurfaceContact> surface_contacts(const Configuration& configuration) const;

 private:
  struct Sides;
  Sides sides(std::size_t direction) const;
  const ContactModel& contact_of(std::size_t direction) const;
  double stiffening_of(std::size_t direction) const;
  void find_patches(std::size_t direction, const Configuration& configuration);
  const FlatTriangle& face_now(const Configuration& configuration, const Collider& faces, int face);
  void find_patches_of_nodes(std::size_t direction);
  struct SummarySums;
  SummarySums no_summary(std::size_t contact) const;
  template <class Counts>
  void add_to_summary(std::size_t direction, const Configuration& configuration, Counts&& counts,
                      SummarySums& sums) const;
  ContactSummary finished(SummarySums sums, std::size_t contact,
                          const Configuration& configuration) const;
  template <class Gradient>
  void add_rank_one(std::size_t direction, int node, const Configuration& configuration,
                    double factor, Gradient&& gradient, fem::BlockMatrix& A);
  void add_node_stiffness(std::size_t direction, const Configuration& configuration,
                          fem::Tangent tangent, const SystemScale& scale, fem::BlockMatrix& A);

  const Model& model_;
  bool soft_ = false;
  std::vector<double> allowances_;
  Eigen::VectorXd stiffening_;
  const std::vector<CandidateList>* candidates_ = nullptr;
  std::vector<DirectionMoment> directions_;  // one a candidate list

  std::vector<double> force_on_bodies_;
  EvaluationCounts evaluations_;

  // Scratch of find_patches: the faces met so far.
  std::vector<FlatTriangle> faces_;
  std::vector<int> met_;  // by face: when it was computed last
  int now_ = 0;
  // Scratch of add_node_stiffness: the patches around each node, and a gradient by blocks.
  std::vector<int> patch_begin_, patch_of_node_;
  Positions gradient_;
  std::vector<int> blocks_;
  std::vector<char> has_gradient_;
};

/// Couplings between the nodes of candidates that `A` does not have yet.
void append_missing_stencils(const Model& model, const std::vector<CandidateList>& candidates,
                             const fem::BlockMatrix& A, Stencils& stencils);

}  // namespace articular::sim
