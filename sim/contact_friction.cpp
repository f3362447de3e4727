#include "sim/contact_friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/contact_direction.hpp"

namespace articular::sim {
namespace {

using SixVectors = Eigen::Matrix<double, 3, 6>;

/// Rates at the sheets of a direction: in `closing` and `slip`, sums over patches.
struct Rates {
  Eigen::VectorXd closing;  // A ġ [m³/s]
  Positions slip;           // W V [m³/s]
};

/// @param velocity_of  a NodeRef's [m/s]
template <class Velocity>
Rates rates_of(const ContactDirection& direction, const Collider& triangles, const Collider& faces,
               Velocity&& velocity_of) {
  const std::ptrdiff_t num_sheets = std::ssize(triangles.sheet_node);
  Rates rates{Eigen::VectorXd::Zero(num_sheets), Positions::Zero(3, num_sheets)};
  for (const ContactDirection::Patch& entry : direction.patches()) {
    if (!carries(direction, entry.triangle, triangles.sheets)) continue;
    const auto nodes = nodes_of(triangles, faces, entry.triangle, entry.face);
    SixVectors v;
    for (Eigen::Index k = 0; k < 6; ++k)
      v.col(k) = velocity_of(*nodes[static_cast<std::size_t>(k)]);
    const Mat3 slip = slip_integrals(entry.patch, v);
    const Vec3 turning = turning_depths(direction, entry, triangles.sheets);
    for (int i = 0; i < 3; ++i) {
      const int sheet = triangles.sheets(i, entry.triangle);
      rates.closing[sheet] +=
          patch_gradient(entry.patch, Vec3::Unit(i), turning[i]).dot(v.reshaped());
      rates.slip.col(sheet) += slip.col(i);
    }
  }
  return rates;
}

/// Sums of w N_a n over the patches.
Positions normals_of(const ContactDirection& direction, const Collider& triangles) {
  Positions normals = Positions::Zero(3, std::ssize(triangles.sheet_node));
  for (const ContactDirection::Patch& entry : direction.patches()) {
    const Vec3 areas = nodal_areas(entry.patch);
    for (int i = 0; i < 3; ++i)
      normals.col(triangles.sheets(i, entry.triangle)) += areas[i] * entry.patch.normal;
  }
  return normals;
}

}  // namespace

NodalDrag nodal_drag(const SurfaceLaw& law, double pressure, double closing, const Vec3& slip,
                     const Vec3& normal) {
  NodalDrag drag;
  drag.closing = closing;
  // No more than the penalty gives: pressure rises from 0 where surfaces meet, and never pulls.
  drag.pressure = std::clamp(law.damping * closing, -pressure, pressure);
  if (std::abs(law.damping * closing) < pressure)
    drag.damping = law.damping;
  else
    drag.stiffening = closing > 0 ? 2 : 0;
  if (!(law.friction > 0)) return drag;
  const double limit = law.friction * (pressure + drag.pressure);
  drag.slip = slip - normal.dot(slip) * normal;
  const double speed = drag.slip.norm(), regular = std::hypot(speed, law.slip_velocity);
  drag.traction = -limit / regular * drag.slip;
  drag.along = speed > 0 ? Vec3(drag.slip / speed) : Vec3(normal.unitOrthogonal());
  drag.across = normal.cross(drag.along);
  drag.drag_across = limit / regular;
  drag.drag_along = drag.drag_across * std::pow(law.slip_velocity / regular, 2);
  return drag;
}

// u_i = v_i − d_i ṅ − Σ β_mi ḟ_m at the triangle's nodes, with ṅ = −Σ ∇N_j (n·v_j).

Vec18 slip_gradient(const ContactPatch& patch, const Mat3& t) {
  const Mat3 q = t * patch.Q;  // of u_i
  const Vec3 lever = q * patch.height;
  Vec18 g;
  for (int i = 0; i < 3; ++i) {
    g.segment<3>(3 * i) = q.col(i) + lever.dot(patch.g.col(i)) * patch.normal;
    g.segment<3>(9 + 3 * i) = -q * patch.beta.row(i).transpose();
  }
  return g;
}

Mat3 slip_integrals(const ContactPatch& patch, const SixVectors& v) {
  const Vec3 turning = -patch.g * (v.leftCols<3>().transpose() * patch.normal);
  const Mat3 u =
      v.leftCols<3>() - turning * patch.height.transpose() - v.rightCols<3>() * patch.beta;
  return u * patch.Q;
}

void find_drag(const SurfaceLaw& law, const Collider& triangles, const Collider& faces,
               const Configuration& configuration, ContactDirection& direction) {
  const Rates rates = rates_of(direction, triangles, faces,
                               [&](const NodeRef& node) { return configuration.velocity(node); });
  const Positions normals = normals_of(direction, triangles);
  direction.drag.assign(triangles.sheet_node.size(), {});
  for (const int sheet : direction.sheets) {
    if (!(direction.pressure[sheet] > 0)) continue;
    NodalDrag& drag = direction.drag[static_cast<std::size_t>(sheet)];
    drag =
        nodal_drag(law, direction.pressure[sheet], rates.closing[sheet] / direction.measure[sheet],
                   rates.slip.col(sheet) / direction.area[sheet], normals.col(sheet).normalized());
    direction.pressure[sheet] += drag.pressure;
  }
}

void add_drag_product(const ContactDirection& direction, const Collider& triangles,
                      const Collider& faces, const Configuration& configuration,
                      const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f) {
  const Rates rates = rates_of(direction, triangles, faces, [&](const NodeRef& node) {
    Vec3 velocity = u.segment<3>(3 * node.block);
    if (node.bone >= 0)
      velocity += u.segment<3>(3 * node.block + 3).cross(configuration.lever(node));
    return velocity;
  });
  for (const ContactDirection::Patch& entry : direction.patches()) {
    if (!carries(direction, entry.triangle, triangles.sheets)) continue;
    Vec3 p;
    Mat3 t;
    for (int i = 0; i < 3; ++i) {
      const int sheet = triangles.sheets(i, entry.triangle);
      const NodalDrag& drag = direction.drag[static_cast<std::size_t>(sheet)];
      const Vec3 slip = rates.slip.col(sheet) / direction.area[sheet];
      p[i] = drag.damping * rates.closing[sheet] / direction.measure[sheet];
      t.col(i) = drag.drag_along * drag.along.dot(slip) * drag.along +
                 drag.drag_across * drag.across.dot(slip) * drag.across;
    }
    const double turning = p.dot(turning_depths(direction, entry, triangles.sheets));
    const Vec18 product = patch_gradient(entry.patch, p, turning) + slip_gradient(entry.patch, t);
    const auto nodes = nodes_of(triangles, faces, entry.triangle, entry.face);
    for (Eigen::Index k = 0; k < 6; ++k)
      add_force(configuration, *nodes[static_cast<std::size_t>(k)],
                scale * product.segment<3>(3 * k), f);
  }
}

double drag_power(const ContactDirection& direction) {
  double power = 0;
  if (direction.drag.empty()) return power;
  for (const int sheet : direction.sheets) {
    const NodalDrag& drag = direction.drag[static_cast<std::size_t>(sheet)];
    power += drag.pressure * drag.closing * direction.measure[sheet] -
             drag.traction.dot(drag.slip) * direction.area[sheet];
  }
  return power;
}

}  // namespace articular::sim
