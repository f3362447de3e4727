#include "sim/assembly/pressure_prediction.hpp"

#include "fem/element/smoothed_elasticity.hpp"
#include "sim/assembly/side_by_side.hpp"

namespace articular::sim {

void PressurePrediction::predict(const Moment& now, const NewtonMatrix& matrix,
                                 const Eigen::VectorXd& dx) {
  of_tissue_.resize(now.tissues.size());
  for_each_smoothed(now.model, [&](std::size_t t) {
    Way& way = of_tissue_[t];
    displacements_of(now, t, dx, way.u);
    way.before = now.tissues[t].pressure;
    now.model.tissues[t].elements.smoothed()->predicted_pressure(
        now.tissues[t].x, matrix.pressure_gradient(t), way.u, way.after);
  });
}

void PressurePrediction::keep(const Moment& now) {
  of_tissue_.resize(now.tissues.size());
  for_each_smoothed(now.model, [&](std::size_t t) {
    of_tissue_[t].before = of_tissue_[t].after = now.tissues[t].pressure;
  });
}

Eigen::VectorXd PressurePrediction::at(std::size_t tissue, double part) const {
  const Way& way = of_tissue_[tissue];
  return way.before + part * (way.after - way.before);
}

}  // namespace articular::sim
