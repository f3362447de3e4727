#include "sim/assembly/tissue_damping.hpp"

namespace articular::sim {

double TissueDamping::power(const Moment& now) {
  double power = 0;
  for (std::size_t t = 0; t < now.tissues.size(); ++t) {
    const Tissue& tissue = now.model.tissues[t];
    if (tissue.dashpots) {
      velocities_of(now.configuration, tissue.nodes, v_);
      power += tissue.dashpots->power(now.tissues[t].x, v_);
    }
    if (tissue.fibre_drag) {
      velocities_of(now.configuration, tissue.nodes, v_);
      power +=
          tissue.fibre_drag->power(now.tissues[t].x, v_, activation_of(tissue, now.configuration));
    }
    if (tissue.relaxation && !now.model.is_static) {
      velocities_of(now.configuration, tissue.nodes, v_);
      f_.setZero(3, v_.cols());
      tissue.relaxation->add_force(now.tissues[t].x, now.tissues[t].internal_variables, 1, f_);
      power += f_.cwiseProduct(v_).sum();
    }
    if (tissue.mass_damping == 0) continue;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].rigid < 0)
        power += tissue.mass_damping * tissue.lumped_mass[static_cast<Eigen::Index>(i)] *
                 now.configuration.velocity(tissue.nodes[i]).squaredNorm();
  }
  return power;
}

void TissueDamping::add_product(const Moment& now, const Eigen::VectorXd& u, double scale,
                                Eigen::VectorXd& f) {
  for (std::size_t t = 0; t < now.tissues.size(); ++t) {
    const Tissue& tissue = now.model.tissues[t];
    if (!tissue.dashpots && !tissue.fibre_drag && tissue.mass_damping == 0) continue;
    const auto count = static_cast<Eigen::Index>(tissue.nodes.size());
    displacements_of(now, t, u, v_);
    f_.setZero(3, count);
    for (Eigen::Index i = 0; i < count; ++i)
      if (tissue.nodes[static_cast<std::size_t>(i)].rigid < 0)
        f_.col(i) = tissue.mass_damping * tissue.lumped_mass[i] * v_.col(i);
    if (tissue.dashpots) tissue.dashpots->add_force(now.tissues[t].x, v_, f_);
    if (tissue.fibre_drag) {
      velocities_of(now.configuration, tissue.nodes, velocities_);
      tissue.fibre_drag->add_product(now.tissues[t].x, velocities_,
                                     activation_of(tissue, now.configuration), v_, f_);
    }
    for (Eigen::Index i = 0; i < count; ++i)
      add_force(now.configuration, tissue.nodes[static_cast<std::size_t>(i)], scale * f_.col(i), f);
  }
}

}  // namespace articular::sim
