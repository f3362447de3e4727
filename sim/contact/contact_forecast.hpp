#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"
#include "sim/contact/group_gradient.hpp"

/// Which smoothing groups a Newton correction δ opens and closes.
///
/// The pressure <λ + k g> of a group has a kink where it begins, and the matrix knows but one side
/// of it. A correction that leads to the other meets no stiffness there, or too much; the line
/// search stops it at the kink, and the iteration creeps from one kink to the next. With depths
/// that are linear along the correction, g_a + ∇g_a·δ, it is known beforehand which side each group
/// will be on. The matrix and the right-hand side take groups as they will be: K ± k_a A_a ∇g_a
/// ∇g_aᵀ, and the forces −A_a (λ_a + k_a g_a) ∇g_a of those that will press, which may pull now.
/// That is the primal–dual active set method [Hüeber 2005]; the line search on the energy goes on
/// to judge where it leads. Groups stay as they were foreseen until another correction says
/// otherwise: where one was taken in part, the next begins with a set that is right but for a few.
///
/// Depths averaged at nodes, without friction and damping: else nothing is foreseen.
///
/// [Hüeber 2005] Hüeber, Wohlmuth. A primal–dual active set strategy for non-linear multibody
/// contact problems. Comput Methods Appl Mech Eng 194:3147.
namespace articular::sim {

/// Σ stiffness ∇g ∇gᵀ of groups that enter (stiffness > 0) and leave (< 0) a matrix.
struct GroupChanges {
  std::vector<double> stiffness;  // ± k A, by change [N/m]
  std::vector<int> begin{0};      // of each change in the following, and the end of the last
  std::vector<int> block;         // of unknowns
  std::vector<Vec3> gradient;     // ∇g, of free freedoms [1, m]

  std::size_t size() const { return stiffness.size(); }
  void clear();
};

class ContactForecast {
 public:
  explicit ContactForecast(const Model& model);

  /// Takes each group to be on the side of its kink that a correction of the unknown blocks [m,
  /// rad] leads to, in all matrices and forces from now on.
  /// @return the groups that were taken to be on the other side; valid until the next call
  const GroupChanges& foresee(ContactResponse& response, const Configuration& configuration,
                              const Eigen::VectorXd& correction);
  /// The norm of the forces on free freedoms by which the linear ones that led to the correction
  /// differ from those that are then, to first order [N, N m].
  double missed() const { return missed_.norm(); }
  /// Whether any group is taken for something else than it is.
  static bool is_made(const ContactResponse& response);
  /// f += the linear forces of groups that are taken to press and do not, less the forces of those
  /// that press and are taken not to, on the unknown blocks [N, N m]. What is held takes part.
  void add_force(const ContactResponse& response, const Configuration& configuration,
                 Eigen::VectorXd& f);

 private:
  void gather(const ContactPairState& pair_state, int group, const Configuration& configuration);
  void note(double stiffness, double pressure, double measure);

  const Model& model_;
  PatchesOfGroups patches_;
  GroupGradient gradient_;
  std::vector<int> held_;  // of each unknown block its place in Model::held_blocks, or -1
  GroupChanges changes_;
  Eigen::VectorXd missed_;  // of the unknown blocks
};

}  // namespace articular::sim
