#include "sim/assembly/relaxation_rows.hpp"

namespace articular::sim {

void RelaxationRows::add_known_force(const Moment& now, const double* b, double gamma,
                                     Eigen::VectorXd& f) {
  for (std::size_t t = 0; t < now.tissues.size(); ++t) {
    const Tissue& tissue = now.model.tissues[t];
    if (!tissue.relaxation) continue;
    known_ = Eigen::Map<const Eigen::VectorXd>(
        b + now.model.layout.internal_variables() + tissue.first_internal_variable,
        tissue.relaxation->num_internal_variables());
    const Eigen::Index n = known_.size() / tissue.relaxation->num_terms();
    for (Eigen::Index i = 0; i < tissue.relaxation->num_terms(); ++i)
      known_.segment(n * i, n) /=
          1 + gamma / tissue.relaxation->terms()[static_cast<std::size_t>(i)].time;
    f_.setZero(3, static_cast<Eigen::Index>(tissue.nodes.size()));
    tissue.relaxation->add_force(now.tissues[t].x, known_, -1, f_);
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      add_force(now.configuration, tissue.nodes[i], f_.col(static_cast<Eigen::Index>(i)), f);
  }
}

/// δS0 is that of the law, not of its tangent: it costs less, and the internal variables' rows are
/// met at once.
void RelaxationRows::correct(const Moment& now, const double* b, double gamma,
                             const Eigen::VectorXd& w, double* x) {
  for (std::size_t t = 0; t < now.tissues.size(); ++t) {
    const Tissue& tissue = now.model.tissues[t];
    if (!tissue.relaxation) continue;
    displacements_of(now, t, w, x_);
    x_ = now.tissues[t].x + gamma * x_;
    tissue.relaxation->stress(x_, activation_of(tissue, now.configuration), stress_);
    stress_ -= now.tissues[t].stress;
    const Eigen::Index n = stress_.size();
    for (Eigen::Index i = 0; i < tissue.relaxation->num_terms(); ++i) {
      const Eigen::Index at =
          now.model.layout.internal_variables() + tissue.first_internal_variable + n * i;
      const double ratio = gamma / tissue.relaxation->terms()[static_cast<std::size_t>(i)].time;
      Eigen::Map<Eigen::VectorXd>(x + at, n) =
          (Eigen::Map<const Eigen::VectorXd>(b + at, n) + ratio * stress_) / (1 + ratio);
    }
  }
}

}  // namespace articular::sim
