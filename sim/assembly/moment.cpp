#include "sim/assembly/moment.hpp"

namespace articular::sim {

double activation_of(const Tissue& tissue, const Configuration& now) {
  return tissue.muscle < 0 ? 0 : now.activation[tissue.muscle];
}

Eigen::MatrixXd cauchy_stress(const Tissue& tissue, const TissueMoment& moment,
                              const Configuration& now) {
  Eigen::MatrixXd stress = tissue.elements.cauchy_stress(moment.x, activation_of(tissue, now));
  if (tissue.relaxation)
    tissue.relaxation->add_cauchy_stress(moment.x, moment.internal_variables, stress);
  return stress;
}

void displacements_of(const Moment& now, std::size_t tissue, const Eigen::VectorXd& dx,
                      Positions& u) {
  const std::vector<NodeRef>& nodes = now.model.tissues[tissue].nodes;
  u.setZero(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeRef& node = nodes[i];
    if (node.rigid >= now.model.layout.num_rigid) continue;
    const auto column = static_cast<Eigen::Index>(i);
    u.col(column) = dx.segment<3>(3 * node.block);
    if (node.rigid >= 0)
      u.col(column) += dx.segment<3>(3 * node.block + 3).cross(now.configuration.lever(node));
  }
}

}  // namespace articular::sim
