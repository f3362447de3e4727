#include "sim/model/mass_properties.hpp"

#include <Eigen/LU>

namespace articular::sim {

MassProperties solid_mass_properties(const Positions& X, const Triangles& surface, double density) {
  // Sum over the tetrahedra (origin, a, b, c); moments of a tetrahedron with one corner at the
  // origin: ∫x dV = V/4 Σx, ∫x xᵀ dV = V/20 (Σ x xᵀ + (Σx)(Σx)ᵀ).
  const Vec3 origin = X.rowwise().mean();  // near the body: less cancellation
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (Eigen::Index f = 0; f < surface.cols(); ++f) {
    Mat3 corner;
    for (int k = 0; k < 3; ++k) corner.col(k) = X.col(surface(k, f)) - origin;
    const double v = corner.determinant() / 6;
    const Vec3 sum = corner.rowwise().sum();
    volume += v;
    first += v / 4 * sum;
    second += v / 20 * (corner * corner.transpose() + sum * sum.transpose());
  }
  MassProperties result;
  result.mass = density * volume;
  const Vec3 center = first / volume;
  const Mat3 central = density * (second - volume * center * center.transpose());
  result.center = origin + center;
  result.inertia = central.trace() * Mat3::Identity() - central;
  return result;
}

MassProperties join(const MassProperties& a, const MassProperties& b) {
  MassProperties result;
  result.mass = a.mass + b.mass;
  if (result.mass == 0) return a;
  result.center = (a.mass * a.center + b.mass * b.center) / result.mass;
  result.inertia = Mat3::Zero();
  for (const MassProperties* part : {&a, &b}) {
    const Vec3 r = part->center - result.center;  // parallel axes
    result.inertia +=
        part->inertia + part->mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return result;
}

}  // namespace articular::sim
