#include "sim/contact/contact_friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/contact/contact_pair_state.hpp"

namespace articular::sim {
namespace {

using SixVectors = Eigen::Matrix<double, 3, 6>;

/// Rates at the groups of a contact pair: in `closing` and `slip`, sums over patches.
struct Rates {
  Eigen::VectorXd closing;  // A ġ [m³/s]
  Positions slip;           // W V [m³/s]
};

/// @param velocity_of  a NodeRef's [m/s]
template <class Velocity>
Rates rates_of(const ContactPairState& pair_state, const Collider& triangles, const Collider& faces,
               Velocity&& velocity_of) {
  const std::ptrdiff_t num_groups = std::ssize(triangles.group_node);
  Rates rates{Eigen::VectorXd::Zero(num_groups), Positions::Zero(3, num_groups)};
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    if (!carries(pair_state, entry.triangle, triangles.groups)) continue;
    const auto nodes = nodes_of(triangles, faces, entry.triangle, entry.face);
    SixVectors v;
    for (Eigen::Index k = 0; k < 6; ++k)
      v.col(k) = velocity_of(*nodes[static_cast<std::size_t>(k)]);
    const Mat3 slip = slip_integrals(entry.patch, v);
    for (int i = 0; i < 3; ++i) {
      const int group = triangles.groups(i, entry.triangle);
      rates.closing[group] +=
          patch_gradient(entry.patch,
                         mean_depths(pair_state, entry, triangles.groups, Vec3::Unit(i)))
              .dot(v.reshaped());
      rates.slip.col(group) += slip.col(i);
    }
  }
  return rates;
}

/// The same for velocities of the blocks.
Rates rates_of(const ContactPairState& pair_state, const Collider& triangles, const Collider& faces,
               const Configuration& configuration, const Eigen::VectorXd& u) {
  return rates_of(pair_state, triangles, faces, [&](const NodeRef& node) {
    Vec3 velocity = u.segment<3>(3 * node.block);
    if (node.rigid >= 0)
      velocity += u.segment<3>(3 * node.block + 3).cross(configuration.lever(node));
    return velocity;
  });
}

/// Sums of w N_a n over the patches.
Positions normals_of(const ContactPairState& pair_state, const Collider& triangles) {
  Positions normals = Positions::Zero(3, std::ssize(triangles.group_node));
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    const Vec3 areas = nodal_areas(entry.patch);
    for (int i = 0; i < 3; ++i)
      normals.col(triangles.groups(i, entry.triangle)) += areas[i] * entry.patch.normal;
  }
  return normals;
}

Vec3 tangential(const Vec3& v, const Vec3& normal) { return v - normal.dot(v) * normal; }

std::optional<Vec3> grip_of(const ContactPairState& pair_state, int group) {
  if (pair_state.friction_dual.cols() == 0) return std::nullopt;
  return pair_state.friction_dual.col(group);
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
                     const Vec3& normal, const std::optional<Vec3>& friction_dual) {
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
  const Axes axes = axes_of(friction_dual ? tangential(*friction_dual, normal) : own, own, normal);
  drag.along = axes.along;
  drag.across = axes.across;
  drag.drag_along = limit / regular * axes.value_along;
  drag.drag_across = limit / regular * axes.value_across;
  return drag;
}

Vec3 next_friction_dual(const SurfaceLaw& law, const Vec3& slip, const Vec3& change,
                        const std::optional<Vec3>& friction_dual) {
  const double regular = std::hypot(slip.norm(), law.slip_velocity);
  const Vec3 own = slip / regular;
  const Vec3 next = own + (change - friction_dual.value_or(own) * own.dot(change)) / regular;
  return next / std::max(1.0, next.norm());
}

// u_i = v_i − d_i ṅ − Σ β_mi ḟ_m at the triangle's nodes, with ṅ = −Σ ∇N_j (n·v_j).

Vec18 slip_gradient(const ContactPatch& patch, const Mat3& t) {
  const Mat3 q = t * patch.counted;  // of u_i
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
  return u * patch.counted;
}

void find_drag(const SurfaceLaw& law, const Collider& triangles, const Collider& faces,
               const Configuration& configuration, ContactPairState& pair_state) {
  const Rates rates = rates_of(pair_state, triangles, faces,
                               [&](const NodeRef& node) { return configuration.velocity(node); });
  const Positions normals = normals_of(pair_state, triangles);
  pair_state.drag.assign(triangles.group_node.size(), {});
  for (const int group : pair_state.groups) {
    if (!(pair_state.pressure[group] > 0)) continue;
    NodalDrag& drag = pair_state.drag[static_cast<std::size_t>(group)];
    drag = nodal_drag(law, pair_state.pressure[group],
                      rates.closing[group] / pair_state.measure[group],
                      rates.slip.col(group) / pair_state.area[group],
                      normals.col(group).normalized(), grip_of(pair_state, group));
    pair_state.pressure[group] += drag.pressure;
  }
}

void add_drag_product(const ContactPairState& pair_state, const Collider& triangles,
                      const Collider& faces, const Configuration& configuration,
                      const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f) {
  const Rates rates = rates_of(pair_state, triangles, faces, configuration, u);
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    if (!carries(pair_state, entry.triangle, triangles.groups)) continue;
    Vec3 p;
    Mat3 t;
    for (int i = 0; i < 3; ++i) {
      const int group = triangles.groups(i, entry.triangle);
      const NodalDrag& drag = pair_state.drag[static_cast<std::size_t>(group)];
      const Vec3 slip = rates.slip.col(group) / pair_state.area[group];
      p[i] = drag.damping * rates.closing[group] / pair_state.measure[group];
      t.col(i) = drag.drag_along * drag.along.dot(slip) * drag.along +
                 drag.drag_across * drag.across.dot(slip) * drag.across;
    }
    const Vec18 product =
        patch_gradient(entry.patch, mean_depths(pair_state, entry, triangles.groups, p)) +
        slip_gradient(entry.patch, t);
    const auto nodes = nodes_of(triangles, faces, entry.triangle, entry.face);
    for (Eigen::Index k = 0; k < 6; ++k)
      add_force(configuration, *nodes[static_cast<std::size_t>(k)],
                scale * product.segment<3>(3 * k), f);
  }
}

void update_friction_duals(const SurfaceLaw& law, const Collider& triangles, const Collider& faces,
                           const Configuration& configuration, const Eigen::VectorXd& change,
                           ContactPairState& pair_state) {
  const Rates rates = rates_of(pair_state, triangles, faces, configuration, change);
  Positions next = Positions::Zero(3, std::ssize(triangles.group_node));
  for (const int group : pair_state.groups) {
    if (!(pair_state.pressure[group] > 0)) continue;
    const NodalDrag& drag = pair_state.drag[static_cast<std::size_t>(group)];
    const Vec3 normal = drag.along.cross(drag.across);
    std::optional<Vec3> friction_dual = grip_of(pair_state, group);
    if (friction_dual) friction_dual = tangential(*friction_dual, normal);
    const Vec3 slip = rates.slip.col(group) / pair_state.area[group];
    next.col(group) = next_friction_dual(law, drag.slip, tangential(slip, normal), friction_dual);
  }
  pair_state.friction_dual = std::move(next);
}

double drag_power(const ContactPairState& pair_state) {
  double power = 0;
  if (pair_state.drag.empty()) return power;
  for (const int group : pair_state.groups) {
    const NodalDrag& drag = pair_state.drag[static_cast<std::size_t>(group)];
    power += drag.pressure * drag.closing * pair_state.measure[group] -
             drag.traction.dot(drag.slip) * pair_state.area[group];
  }
  return power;
}

}  // namespace articular::sim
