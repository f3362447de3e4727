#pragma once

#include <limits>

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
  double gravity_energy() const;  // [J], of all masses but fixed and driven bones' own
  DynamicsTimes& times() { return times_; }

 private:
  struct TissueWork {
    Positions x, f;
    fem::BlockMatrix K;
    std::vector<int> slot;  // of each block of K in the matrix; -1: a bone is involved
  };
  void build_pattern();
  void add_tissue_stiffness(std::size_t t, double scale, fem::Tangent tangent);
  Mat3 world_inertia(int bone) const;
  /// All tissue nodes but those whose mass a rigid bone has taken over.
  bool carries_own_weight(const NodeRef& node) const;

  const Model& model_;
  const std::vector<CandidateList>* candidates_ = nullptr;
  Configuration configuration_;
  Eigen::VectorXd f_;
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
