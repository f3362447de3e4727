#include "fem/element/fibre_drag.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "fem/material/muscle_fibre.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

using Drag = MuscleFibre::Drag;

/// What fibres pull more at a rate [Pa], and its slope by the rate.
ValueSlope at_rate(const Drag& drag, double rate) {
  const ValueSlope factor = force_velocity(drag.per_rate * rate);
  return {drag.pull * (factor.value - 1), drag.pull * drag.per_rate * factor.slope};
}

double on_line(const FibreDrag::Line& line, double w) {
  return std::clamp(line.factor + line.slope * (w - line.speed), 0.0, kMostForceOfVelocity);
}

}  // namespace

FibreDrag::FibreDrag(const Positions& X, const Tetrahedra& tets, const FibreDirections& fibres,
                     const MuscleFibre& law, const BlockMatrix& matrix)
    : tets_(tets),
      law_(std::make_shared<const MuscleFibre>(law)),
      along_(4, tets.cols()),
      volume_(tets.cols()) {
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const double density = fibres.col(e).norm();
    volume_[e] = density * checked_volume(X, tets, e);
    along_.col(e) = shape_gradients(edge_matrix(gather(X, tets, e)).inverse()).transpose() *
                    fibres.col(e) / density;
    for (const int b : tets.col(e))
      for (const int a : tets.col(e)) slots_.push_back(matrix.slot(a, b));
  }
}

template <class Function>
void FibreDrag::for_each_fibre(const Positions& x, const Positions& v, double activation,
                               Function&& function) const {
  if (activation == 0) return;
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    const Vec3 fibre = gather(x, tets_, e) * along_.col(e);
    const double stretch = fibre.norm();
    const Vec3 direction = fibre / stretch;
    const double rate = direction.dot(gather(v, tets_, e) * along_.col(e));
    function(e, direction, law_->drag(stretch, activation), rate);
  }
}

void FibreDrag::add_force(const Positions& x, const Positions& v, double activation,
                          Positions& f) const {
  for_each_fibre(x, v, activation,
                 [&](Eigen::Index e, const Vec3& direction, const Drag& drag, double rate) {
                   const Vec3 pull = volume_[e] * at_rate(drag, rate).value * direction;
                   for (int a = 0; a < 4; ++a) f.col(tets_(a, e)) += along_(a, e) * pull;
                 });
}

void FibreDrag::add_damping(const Positions& x, const Positions& v, double activation, double scale,
                            Lines& lines, BlockMatrix& D) const {
  const bool had_lines = !lines.empty();
  lines.resize(static_cast<std::size_t>(tets_.cols()));
  for_each_fibre(
      x, v, activation, [&](Eigen::Index e, const Vec3& direction, const Drag& drag, double rate) {
        const double w = drag.per_rate * rate, factor = force_velocity(w).value;
        Line& line = lines[static_cast<std::size_t>(e)];
        if (!had_lines || line.speed != w)  // else asked once more
          line = {w, factor, force_velocity_slope(w, had_lines ? on_line(line, w) : factor)};
        const double slope = drag.pull * drag.per_rate * line.slope;
        const Mat3 damping = scale * volume_[e] * slope * direction * direction.transpose();
        const int* slot = slots_.data() + 16 * e;
        for (int b = 0; b < 4; ++b)
          for (int a = 0; a < 4; ++a) D.block(*slot++) += along_(a, e) * along_(b, e) * damping;
      });
}

void FibreDrag::add_product(const Positions& x, const Positions& v, double activation,
                            const Positions& u, Positions& f) const {
  for_each_fibre(x, v, activation,
                 [&](Eigen::Index e, const Vec3& direction, const Drag& drag, double rate) {
                   const double change = direction.dot(gather(u, tets_, e) * along_.col(e));
                   const Vec3 pull = volume_[e] * at_rate(drag, rate).slope * change * direction;
                   for (int a = 0; a < 4; ++a) f.col(tets_(a, e)) += along_(a, e) * pull;
                 });
}

double FibreDrag::power(const Positions& x, const Positions& v, double activation) const {
  double sum = 0;
  for_each_fibre(x, v, activation, [&](Eigen::Index e, const Vec3&, const Drag& drag, double rate) {
    sum += volume_[e] * at_rate(drag, rate).value * rate;
  });
  return sum;
}

}  // namespace articular::fem
