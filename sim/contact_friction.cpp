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
    for (int i = 0; i < 3; ++i) {
      const int sheet = triangles.sheets(i, entry.triangle);
      rates.closing[sheet] +=
          patch_gradient(entry.patch,
                         mean_depths(direction, entry, triangles.sheets, Vec3::Unit(i)))
              .dot(v.reshaped());
      rates.slip.col(sheet) += slip.col(i);
    }
  }
  return rates;
}

/// The same for velocities of the blocks.
Rates rates_of(const ContactDirection& direction, const Collider& triangles, const Collider& faces,
               const Configuration& configuration, const Eigen::VectorXd& u) {
  return rates_of(direction, triangles, faces, [&](const NodeRef& node) {
    Vec3 velocity = u.segment<3>(3 * node.block);
    if (node.bone >= 0)
      velocity += u.segment<3>(3 * node.block + 3).cross(configuration.lever(node));
    return velocity;
  });
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

Vec3 tangential(const Vec3& v, const Vec3& normal) { return v - normal.dot(v) * normal; }

std::optional<Vec3> grip_of(const ContactDirection& direction, int sheet) {
  if (direction.grip.cols() == 0) return std::nullopt;
  return direction.grip.col(sheet);
}

/// Of a matrix I − (a bᵀ + b aᵀ)/2 in the plane across the normal.
struct Axes {
  Vec3 along, across;
  double value_along, value_across;
};

Axes axes_of(const Vec3& a, const Vec3& b, const Vec3& normal) {
  constexpr double kOpposite = 1e-6;
  const double sizes = a.norm() * b.norm(), product = a.dot(b);
  Vec3 along = b.norm() * a + a.norm() * b;
  if (!(along.norm() > kOpposite * sizes)) along = normal.cross(b);
  along = along.isZero(0) ? normal.unitOrthogonal() : along.normalized();
  return {along, normal.cross(along), 1 - 0.5 * (product + sizes), 1 - 0.5 * (product - sizes)};
}

}  // namespace

NodalDrag nodal_drag(const SurfaceLaw& law, double pressure, double closing, const Vec3& slip,
                     const Vec3& normal, const std::optional<Vec3>& grip) {
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
  drag.slip = tangential(slip, normal);
  const double regular = std::hypot(drag.slip.norm(), law.slip_velocity);
  const Vec3 own = drag.slip / regular;
  drag.traction = -limit * own;
  const Axes axes = axes_of(grip ? tangential(*grip, normal) : own, own, normal);
  drag.along = axes.along;
  drag.across = axes.across;
  drag.drag_along = limit / regular * axes.value_along;
  drag.drag_across = limit / regular * axes.value_across;
  return drag;
}

Vec3 next_grip(const SurfaceLaw& law, const Vec3& slip, const Vec3& change,
               const std::optional<Vec3>& grip) {
  const double regular = std::hypot(slip.norm(), law.slip_velocity);
  const Vec3 own = slip / regular;
  const Vec3 next = own + (change - grip.value_or(own) * own.dot(change)) / regular;
  return next / std::max(1.0, next.norm());
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
                   rates.slip.col(sheet) / direction.area[sheet], normals.col(sheet).normalized(),
                   grip_of(direction, sheet));
    direction.pressure[sheet] += drag.pressure;
  }
}

void add_drag_product(const ContactDirection& direction, const Collider& triangles,
                      const Collider& faces, const Configuration& configuration,
                      const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f) {
  const Rates rates = rates_of(direction, triangles, faces, configuration, u);
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
    const Vec18 product =
        patch_gradient(entry.patch, mean_depths(direction, entry, triangles.sheets, p)) +
        slip_gradient(entry.patch, t);
    const auto nodes = nodes_of(triangles, faces, entry.triangle, entry.face);
    for (Eigen::Index k = 0; k < 6; ++k)
      add_force(configuration, *nodes[static_cast<std::size_t>(k)],
                scale * product.segment<3>(3 * k), f);
  }
}

void update_grips(const SurfaceLaw& law, const Collider& triangles, const Collider& faces,
                  const Configuration& configuration, const Eigen::VectorXd& change,
                  ContactDirection& direction) {
  const Rates rates = rates_of(direction, triangles, faces, configuration, change);
  Positions next = Positions::Zero(3, std::ssize(triangles.sheet_node));
  for (const int sheet : direction.sheets) {
    if (!(direction.pressure[sheet] > 0)) continue;
    const NodalDrag& drag = direction.drag[static_cast<std::size_t>(sheet)];
    const Vec3 normal = drag.along.cross(drag.across);
    std::optional<Vec3> grip = grip_of(direction, sheet);
    if (grip) grip = tangential(*grip, normal);
    const Vec3 slip = rates.slip.col(sheet) / direction.area[sheet];
    next.col(sheet) = next_grip(law, drag.slip, tangential(slip, normal), grip);
  }
  direction.grip = std::move(next);
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
