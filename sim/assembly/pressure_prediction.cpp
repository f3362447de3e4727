#include "sim/assembly/pressure_prediction.hpp"

#include "fem/element/smoothed_elasticity.hpp"

namespace articular::sim {

void PressurePrediction::predict(const Moment& now, const NewtonMatrix& matrix,
                                 const Eigen::VectorXd& dx) {
  of_tissue_.resize(now.tissues.size());
  for (std::size_t t = 0; t < now.tissues.size(); ++t) {
    const fem::SmoothedElasticity* smoothed = now.model.tissues[t].elements.smoothed();
    if (smoothed == nullptr) continue;
    displacements_of(now, t, dx, u_);
    of_tissue_[t].before = now.tissues[t].pressure;
    smoothed->predicted_pressure(now.tissues[t].x, matrix.pressure_gradient(t), u_,
                                 of_tissue_[t].after);
  }
}

Eigen::VectorXd PressurePrediction::at(std::size_t tissue, double part) const {
  const Way& way = of_tissue_[tissue];
  return way.before + part * (way.after - way.before);
}

}  // namespace articular::sim
