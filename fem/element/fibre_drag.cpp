#include "fem/element/fibre_drag.hpp"

#include <algorithm>

#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/muscle_fibre.hpp"

namespace articular::fem {
namespace {

using Vec9 = Eigen::Vector<double, 9>;

Vec9 of_lane(const Eight* rows, int lane) {
  Vec9 values;
  for (int k = 0; k < 9; ++k) values[k] = rows[k].lane[lane];
  return values;
}

double on_line(const FibreDrag::Line& line, double w) {
  return std::clamp(line.factor + line.slope * (w - line.speed), 0.0, kMostForceOfVelocity);
}

std::size_t point(const MovingStencils::Octet& octet, int lane) {
  return static_cast<std::size_t>(octet.index) * kBatchSize + static_cast<std::size_t>(lane);
}

/// Those of the elements and domains in the order of the points.
FibreDirections of_points(const MovingStencils& stencils, const FibreDirections& of_element,
                          const FibreDirections& of_domain) {
  FibreDirections fibres(3, kBatchSize * stencils.stencils().num_batches());
  for (int i = 0; i < stencils.stencils().num_batches(); ++i) {
    const FibreDirections& source = stencils.are_elements(i) ? of_element : of_domain;
    for (int lane = 0; lane < kBatchSize; ++lane)
      fibres.col(kBatchSize * i + lane) = source.col(stencils.stencils().index(i).lane[lane]);
  }
  return fibres;
}

/// A line for a motion, from that of the matrix before.
FibreDrag::Line line_at(double w, const FibreDrag::Line* before) {
  if (before != nullptr && before->speed == w) return *before;  // asked once more
  const double factor = force_velocity(w).value;
  return {w, factor, force_velocity_slope(w, before != nullptr ? on_line(*before, w) : factor)};
}

/// C = B ⊗ (a₀ ⊗ a₀) at one point: ∂P/∂F where P = p ⊗ a₀, and B = ∂p/∂(F a₀)
void set_tangent(const Mat3& B, const Vec3& rest, int lane, Eight* C) {
  for (int l = 0; l < 3; ++l)
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          C[(3 * j + i) + 9 * (3 * l + k)].lane[lane] = B(i, k) * rest[j] * rest[l];
}

}  // namespace

/// One of a point, as it moves on.
struct FibreDrag::Fibre {
  Vec3 rest, direction;  // a₀ and F a₀/λ
  double stretch;        // λ
  Vec3 turning;          // [1/s], of the direction: its derivative by time
  Vec9 slope;            // ∂λ/∂F
  double share;          // density times the share of the point
  MuscleFibre::Drag drag;
  double speed;  // w [-]

  double damping(double slope_of_factor) const {
    return share * drag.pull * drag.per_rate * slope_of_factor;
  }
};

FibreDrag::FibreDrag(const Positions& X, const Tetrahedra& tets, const FibreDirections& fibres,
                     const MuscleFibre& law, const BlockMatrix& matrix)
    : law_(std::make_shared<const MuscleFibre>(law)),
      stencils_(X, tets, matrix),
      fibres_(of_points(stencils_, fibres, {})) {}

FibreDrag::FibreDrag(const SmoothedElasticity& smoothed, const MuscleFibre& law)
    : law_(std::make_shared<const MuscleFibre>(law)),
      stencils_(smoothed),
      fibres_(of_points(stencils_, smoothed.fibres(), smoothed.domain_fibres())) {}

FibreDrag::Fibre FibreDrag::fibre(const Octet& octet, int lane, double activation) const {
  const Vec3 fibre = fibres_.col(static_cast<Eigen::Index>(point(octet, lane)));
  const double density = fibre.norm();
  Fibre f;
  f.rest = fibre / density;
  const Vec3 now = of_lane(octet.F, lane).reshaped<Eigen::ColMajor>(3, 3) * f.rest,
             rate = of_lane(octet.rate, lane).reshaped<Eigen::ColMajor>(3, 3) * f.rest;
  f.stretch = now.norm();
  f.direction = now / f.stretch;
  f.turning = (rate - f.direction.dot(rate) * f.direction) / f.stretch;
  f.slope = (f.direction * f.rest.transpose()).reshaped();
  f.share = octet.share * density;
  f.drag = law_->drag(f.stretch, activation);
  f.speed = f.drag.per_rate * f.direction.dot(rate);
  return f;
}

/// P = pull (f_v − 1) ∂λ/∂F
auto FibreDrag::stress(double activation) const {
  return [this, activation](const Octet& octet, Eight* P) {
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const Fibre f = fibre(octet, lane, activation);
      const double pull = f.share * f.drag.pull * (force_velocity(f.speed).value - 1);
      for (int k = 0; k < 9; ++k) P[k].lane[lane] = pull * f.slope[k];
    }
  };
}

void FibreDrag::add_force(const Positions& x, const Positions& v, double activation,
                          Positions& f) const {
  if (activation > 0) stencils_.add_force(x, v, stress(activation), f);
}

/// P = p ⊗ a₀ with p = pull (f_v − 1) d, at the rate λ̇ = d · Ḟ a₀:
///
///   ∂p/∂(Ḟ a₀) = pull f_v' w/λ̇ d ⊗ d
///   ∂p/∂(F a₀) = (f_v − 1) (pull' d ⊗ d + pull/λ (1 − d ⊗ d)) + pull f_v' w/λ̇ d ⊗ ḋ
///
/// @param by_rate  pull f_v' w/λ̇ [Pa s]
Mat3 FibreDrag::stiffness(const Fibre& f, double activation, double by_rate) const {
  const double slope = law_->stiffness(f.stretch, activation) - law_->stiffness(f.stretch, 0),
               across = f.drag.pull / f.stretch,
               lacking = f.share * (force_velocity(f.speed).value - 1);
  const Mat3 along = f.direction * f.direction.transpose(),
             turning = 0.5 * by_rate * f.direction * f.turning.transpose();
  return lacking * (slope * along + across * (Mat3::Identity() - along)) + turning +
         turning.transpose();
}

void FibreDrag::add_tangent(const Positions& x, const Positions& v, double activation,
                            double damping, double stiffness, Lines& lines, BlockMatrix& K) const {
  if (activation == 0) return;
  const bool had_lines = !lines.empty();
  lines.resize(static_cast<std::size_t>(fibres_.cols()));
  const auto tangent = [&](const Octet& octet, Eight* C) {
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const Fibre f = fibre(octet, lane, activation);
      Line& line = lines[point(octet, lane)];
      line = line_at(f.speed, had_lines ? &line : nullptr);
      const double by_rate = f.damping(line.slope);
      Mat3 B = damping * by_rate * f.direction * f.direction.transpose();
      if (stiffness != 0) B += stiffness * this->stiffness(f, activation, by_rate);
      set_tangent(B, f.rest, lane, C);
    }
  };
  stencils_.add_tangent(x, v, tangent, K);
}

void FibreDrag::add_plain_damping(const Positions& x, const Positions& v, double activation,
                                  double damping, const Lines& lines, BlockMatrix& K) const {
  if (activation == 0) return;
  const auto tangent = [&](const Octet& octet, Eight* C) {
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const Fibre f = fibre(octet, lane, activation);
      const double by_rate = damping * f.damping(lines[point(octet, lane)].slope);
      set_tangent(by_rate * f.direction * f.direction.transpose(), f.rest, lane, C);
    }
  };
  stencils_.add_plain_tangent(x, v, tangent, K);
}

void FibreDrag::add_product(const Positions& x, const Positions& v, double activation,
                            const Positions& u, Positions& f) const {
  if (activation == 0) return;
  const StencilKernels& kernels = stencil_kernels(stencils_.instruction_set());
  const auto stress = [&](const Octet& octet, Eight* P) {
    Eight change[9];
    kernels.deformation_gradient(octet.batch, u.data(), change);
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const Fibre f = fibre(octet, lane, activation);
      const double pull =
          f.damping(force_velocity(f.speed).slope) * f.slope.dot(of_lane(change, lane));
      for (int k = 0; k < 9; ++k) P[k].lane[lane] = pull * f.slope[k];
    }
  };
  stencils_.add_force(x, v, stress, f);
}

double FibreDrag::power(const Positions& x, const Positions& v, double activation) const {
  return activation > 0 ? stencils_.power(x, v, stress(activation)) : 0;
}

}  // namespace articular::fem
