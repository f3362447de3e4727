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

/// ∂P/∂Ḟ = damping ∂λ/∂F ⊗ ∂λ/∂F
/// @param fibre_at  fibre_at(octet, lane)
/// @param slope     slope(point, w): that of f_v
template <class FibreAt, class Slope>
auto tangent(FibreAt fibre_at, double scale, Slope slope) {
  return [=](const MovingStencils::Octet& octet, Eight* C) {
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const auto f = fibre_at(octet, lane);
      const double damping = scale * f.damping(slope(point(octet, lane), f.speed));
      for (int n = 0; n < 9; ++n)
        for (int m = 0; m < 9; ++m) C[m + 9 * n].lane[lane] = damping * f.slope[m] * f.slope[n];
    }
  };
}

}  // namespace

/// One of a point, as it moves on.
struct FibreDrag::Fibre {
  Vec9 slope;    // ∂λ/∂F
  double share;  // density times the share of the point
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
  const Vec3 rest = fibre / density;
  const Vec3 now = of_lane(octet.F, lane).reshaped<Eigen::ColMajor>(3, 3) * rest;
  const double stretch = now.norm();
  Fibre result;
  result.slope = (now / stretch * rest.transpose()).reshaped();
  result.share = octet.share * density;
  result.drag = law_->drag(stretch, activation);
  result.speed = result.drag.per_rate * result.slope.dot(of_lane(octet.rate, lane));
  return result;
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

void FibreDrag::add_damping(const Positions& x, const Positions& v, double activation, double scale,
                            Lines& lines, BlockMatrix& D) const {
  if (activation == 0) return;
  const bool had_lines = !lines.empty();
  lines.resize(static_cast<std::size_t>(fibres_.cols()));
  const auto slope = [&lines, had_lines](std::size_t point, double w) {
    Line& line = lines[point];
    line = line_at(w, had_lines ? &line : nullptr);
    return line.slope;
  };
  const auto fibre_at = [&](const Octet& o, int lane) { return fibre(o, lane, activation); };
  stencils_.add_tangent(x, v, tangent(fibre_at, scale, slope), D);
}

void FibreDrag::add_plain_damping(const Positions& x, const Positions& v, double activation,
                                  double scale, const Lines& lines, BlockMatrix& D) const {
  if (activation == 0) return;
  const auto slope = [&lines](std::size_t point, double) { return lines[point].slope; };
  const auto fibre_at = [&](const Octet& o, int lane) { return fibre(o, lane, activation); };
  stencils_.add_plain_tangent(x, v, tangent(fibre_at, scale, slope), D);
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
