#include "sim/loads/surface_load.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "sim/model/system_matrix.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::sim {
namespace {

using FaceCorners = Mat3;  // one a column

FaceCorners corner_positions(const std::array<NodeRef, 3>& face, const Configuration& now) {
  FaceCorners x;
  for (int a = 0; a < 3; ++a) x.col(a) = now.position(face[static_cast<std::size_t>(a)]);
  return x;
}

/// Twice the area vector of a face, outwards.
Vec3 doubled_area(const FaceCorners& x) { return (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)); }

/// On one corner, for the factor 1.
Vec3 corner_force(const SurfaceLoadModel& load, std::size_t face, const FaceCorners& x) {
  if (const auto* traction = std::get_if<Vec3>(&load.stress))
    return load.area[face] / 3 * *traction;
  return -std::get<double>(load.stress) / 6 * doubled_area(x);
}

}  // namespace

double add_surface_force(const SurfaceLoadModel& load, const Configuration& now,
                         Eigen::VectorXd& f) {
  const double factor = value_at(load.profile, now.t);
  double largest = 0;
  for (std::size_t i = 0; i < load.faces.size(); ++i) {
    const Vec3 force = factor * corner_force(load, i, corner_positions(load.faces[i], now));
    for (const NodeRef& corner : load.faces[i]) add_force(now, corner, force, f);
    largest = std::max(largest, 3 * force.norm());
  }
  return largest;
}

void add_surface_stiffness(const Model& model, const SurfaceLoadModel& load,
                           const Configuration& now, double scale, fem::BlockMatrix& A) {
  const auto* pressure = std::get_if<double>(&load.stress);
  if (pressure == nullptr) return;
  const double p = scale * value_at(load.profile, now.t) * *pressure;
  if (p == 0) return;
  for (const std::array<NodeRef, 3>& face : load.faces) {
    const FaceCorners x = corner_positions(face, now);
    FaceCorners e;  // opposite edges
    for (int a = 0; a < 3; ++a) e.col(a) = x.col((a + 1) % 3) - x.col((a + 2) % 3);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        if (a != b)
          add_stiffness(model, now, face[static_cast<std::size_t>(a)],
                        face[static_cast<std::size_t>(b)], -p / 12 * skew(e.col(b) - e.col(a)), A);
  }
}

double surface_work(const SurfaceLoadModel& load, const Configuration& from,
                    const Configuration& to, double first, double last) {
  double work = 0;
  for (std::size_t i = 0; i < load.faces.size(); ++i) {
    const FaceCorners x = corner_positions(load.faces[i], from),
                      y = corner_positions(load.faces[i], to);
    const Vec3 way = (y - x).rowwise().sum();
    work += way.dot(first * corner_force(load, i, x) +
                    2 * (first + last) * corner_force(load, i, 0.5 * (x + y)) +
                    last * corner_force(load, i, y)) /
            6;
  }
  return work;
}

}  // namespace articular::sim
