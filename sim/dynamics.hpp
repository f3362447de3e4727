#pragma once

#include <limits>

#include "fem/linear_solver.hpp"
#include "sim/contact_force.hpp"
#include "sim/line_force.hpp"

/// Forces, rates and the Newton matrix of the whole scene.
namespace articular::sim {

/// Wall time by phase [s].
struct DynamicsTimes {
  double elastic_force = 0, contact_force = 0, assembly = 0;
};

class Dynamics {
 public:
  explicit Dynamics(const Model& model);

  /// The candidates for the coming step; their couplings enter the pattern.
  void set_candidates(const std::vector<CandidateList>& candidates);
  /// Drops what depends on the past (couplings of earlier candidates).
  void forget();

  /// Reads y and computes all forces there. Block forces: 3 entries a block, reactions included.
  void evaluate(const double* y, double t);
  const Configuration& configuration() const { return configuration_; }
  const Eigen::VectorXd& forces() const { return f_; }
  /// Force [N] on a bone of the tissue that is tied to it, and its moment [N m] about the bone's
  /// reference point.
  std::pair<Vec3, Vec3> attachment_force(int tissue, int bone) const;
  const std::vector<LineState>& lines() const { return lines_; }
  const std::vector<ContactSummary>& contacts() const { return contacts_; }

  /// ẏ from the forces of the last evaluate().
  void rate(const double* y, double* y_dot) const;

  /// Mass, damping and stiffness at the last evaluate(), over the unknown blocks.
  const fem::BlockMatrix& matrix(const SystemScale& scale, fem::Tangent tangent);

  /// What smoothed tissues add to that matrix: pressures that couple all of their nodes. Refers to
  /// this object.
  fem::PressurePart pressure_part() const { return {pressure_terms_, nullptr}; }

  /// f += scale D u for block velocities u, of the dampers in tissue.
  void add_damping_product(const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f) const;

  /// The largest force on one node, bone or line that entered the last evaluate() [N]: what a
  /// residual is small against.
  double largest_force() const { return largest_force_; }

  /// How far anything may move in one correction of Newton's iteration, or stray from its path in
  /// one step: the smallest mean element size. Beyond, neither linearisation nor contact search
  /// holds.
  double trusted_motion() const { return trusted_motion_; }  // [m]

  std::uint64_t pattern_id() const { return A_.pattern_id(); }

  /// Mass of a free node [kg].
  double mass_of(int block) const;
  /// r = M b for block velocities b.
  void multiply_mass(const Eigen::VectorXd& b, Eigen::VectorXd& r) const;

  /// Time constant of a muscle's activation now [s].
  double activation_time(const double* y, double t, int muscle) const;

  double kinetic_energy() const;  // at the last evaluate() [J]
  double elastic_energy() const;  // of the tissues [J]
  /// What the tissues' dampers lose there [W].
  double damping_power() const;
  /// ∂W/∂a of a tissue's elastic energy there by its activation [J].
  double energy_per_activation(std::size_t tissue) const;
  double gravity_energy() const;  // [J], of all masses but fixed and driven bones' own
  DynamicsTimes& times() { return times_; }

 private:
  struct TissueWork {
    Positions x, f;
    fem::BlockMatrix K;
    std::vector<int> slot;            // of each block of K in the matrix; -1: a bone is involved
    fem::PressureGradient node_G, G;  // smoothed elements: by nodes, and by blocks of unknowns
  };
  void append_stencils(const Tissue& tissue);
  void build_pattern();
  void add_tissue_stiffness(std::size_t t, const SystemScale& scale, fem::Tangent tangent);
  void make_pressure_gradient(std::size_t t);
  void set_pressure_gradient(std::size_t t);
  double activation_of(std::size_t tissue) const;
  Mat3 world_inertia(int bone) const;
  /// All tissue nodes but those whose mass a rigid bone has taken over.
  bool carries_own_weight(const NodeRef& node) const;

  const Model& model_;
  const std::vector<CandidateList>* candidates_ = nullptr;
  Configuration configuration_;
  Eigen::VectorXd f_;
  mutable Positions v_, damping_;  // at the nodes of a tissue
  std::vector<fem::PressureTerm> pressure_terms_;
  double largest_force_ = 0;
  std::vector<LineState> lines_;
  std::vector<ContactSummary> contacts_;
  std::vector<TissueWork> tissues_;
  std::vector<std::pair<int, int>> mass_nodes_;  // tissue, node of each free block
  Stencils base_, contact_couplings_;
  fem::BlockMatrix A_;
  double trusted_motion_ = std::numeric_limits<double>::infinity();
  DynamicsTimes times_;
};

}  // namespace articular::sim
