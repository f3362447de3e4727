#include "sim/contact/contact_summary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace articular::sim {
namespace {

/// A summary on its way: its center is still Σ p x dA.
struct SummarySums {
  ContactSummary summary;
  Vec3 moment = Vec3::Zero();            // about the origin
  Eigen::VectorXd through_a, through_b;  // normal force through each face of the two bodies [N]
};

SummarySums no_summary(const Model& model, int contact) {
  const auto faces = [&](int body) {
    return Eigen::VectorXd::Zero(
        model.bodies[static_cast<std::size_t>(body)].collider->surface.faces.cols());
  };
  const ContactModel& pair = model.contacts[static_cast<std::size_t>(contact)];
  SummarySums sums;
  sums.summary.contact = contact;
  sums.through_a = faces(pair.a);
  sums.through_b = faces(pair.b);
  return sums;
}

/// Adds the patches that count. What nodes have is summed over their patches too, so that parts add
/// up to the whole.
template <class Counts>
void add_to_summary(const Model& model, const ContactPairState& pair_state,
                    const Configuration& configuration, Counts&& counts, SummarySums& sums) {
  ContactSummary& sum = sums.summary;
  const ContactSides side = sides_of(model, pair_state);
  const ContactModel& contact = model.contacts[static_cast<std::size_t>(pair_state.contact)];
  const double share = contact.share;
  const bool is_self = side.is_self();
  Eigen::VectorXd& through_triangle = contact.reversed ? sums.through_b : sums.through_a;
  Eigen::VectorXd& through_face = contact.reversed || is_self ? sums.through_a : sums.through_b;
  const auto& groups = side.triangles.groups;
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    if (!carries(pair_state, entry.triangle, groups) || !counts(entry)) continue;
    const Mat3 x = corners_of(configuration, side.triangles, entry.triangle);
    const Vec3 area = nodal_areas(entry.patch);
    for (int i = 0; i < 3; ++i) {
      const int group = groups(i, entry.triangle);
      if (!(pair_state.pressure[group] > 0)) continue;
      if (!(area[i] > 0)) continue;
      sum.area += area[i] * share;
      if (!(pair_state.point_stiffness > 0)) {  // of the group's energy its part by area
        const double damping =
            pair_state.drag.empty() ? 0 : pair_state.drag[static_cast<std::size_t>(group)].pressure;
        sum.energy += 0.5 * (pair_state.pressure[group] - damping) *
                      std::max(0.0, pair_state.depth[group]) * pair_state.measure[group] * area[i] /
                      pair_state.area[group];
      }
      sum.max_pressure = std::max(sum.max_pressure, pair_state.pressure[group] / share);
      if (pair_state.depth[group] > sum.max_depth) {
        sum.max_depth = pair_state.depth[group];
        sum.deepest = x.col(i);
      }
    }
    sum.max_point_depth = std::max(sum.max_point_depth, entry.patch.depth_max);
    sum.energy += value(entry.patch, point_energy(entry.patch, pair_state.point_stiffness));
    const Vec3 q = normal_forces(entry.patch, nodal_pressures(pair_state, entry, groups));
    sum.normal_force += q.sum();
    sum.center += x * q;
    through_triangle[entry.triangle] += q.sum();
    through_face[entry.face] += q.sum() / -entry.patch.cosine;  // it acts along the face's normal
    if (is_self) continue;
    const Vec18 on_nodes = forces_on_nodes(pair_state, entry, groups);
    for (int i = 0; i < 3; ++i) {
      const Vec3 force = (contact.reversed ? -1 : 1) * on_nodes.segment<3>(3 * i);
      sum.force += force;
      sums.moment += x.col(i).cross(force);
    }
  }
}

ContactSummary finished(const Model& model, SummarySums sums, const Configuration& configuration) {
  ContactSummary& sum = sums.summary;
  if (sum.normal_force > 0) sum.center /= sum.normal_force;
  sum.moment = sums.moment - sum.center.cross(sum.force);
  const auto add_faces = [&](const Eigen::VectorXd& through, int body) {
    const Collider& collider = *model.bodies[static_cast<std::size_t>(body)].collider;
    for (Eigen::Index f = 0; f < through.size(); ++f) {
      if (!(through[f] > 0)) continue;
      const Mat3 x = corners_of(configuration, collider, static_cast<int>(f));
      const double area = 0.5 * flat_triangle(x).twice_area;
      if (area > 0) sum.max_face_pressure = std::max(sum.max_face_pressure, through[f] / area);
    }
  };
  const ContactModel& pair = model.contacts[static_cast<std::size_t>(sum.contact)];
  add_faces(sums.through_a, pair.a);
  add_faces(sums.through_b, pair.b);
  return sum;
}

}  // namespace

std::vector<ContactSummary> contact_summaries(const Model& model, const ContactResponse& response,
                                              const Configuration& configuration) {
  const auto all = [](const ContactPairState::Patch&) { return true; };
  const auto pair_states = response.pair_states();  // those of a contact lie side by side
  std::vector<ContactSummary> result;
  for (std::size_t d = 0; d < pair_states.size();) {
    const int contact = pair_states[d]->contact;
    SummarySums sums = no_summary(model, contact);
    for (; d < pair_states.size() && pair_states[d]->contact == contact; ++d)
      add_to_summary(model, *pair_states[d], configuration, all, sums);
    result.push_back(finished(model, std::move(sums), configuration));
  }
  return result;
}

ContactSummary summary_through(const Model& model, const ContactResponse& response,
                               const Configuration& configuration, int contact, int body,
                               const std::vector<char>& selected) {
  SummarySums sums = no_summary(model, contact);
  for (const ContactPairState* pair_state : response.pair_states()) {
    if (pair_state->contact != contact) continue;
    const bool is_triangle = sides_of(model, *pair_state).triangle_body == body;
    const auto counts = [&](const ContactPairState::Patch& entry) {
      return selected.empty() ||
             selected[static_cast<std::size_t>(is_triangle ? entry.triangle : entry.face)] != 0;
    };
    add_to_summary(model, *pair_state, configuration, counts, sums);
  }
  return finished(model, std::move(sums), configuration);
}

std::vector<Positions> nodal_contact_forces(const Model& model, const ContactResponse& response) {
  std::vector<Positions> forces(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].collider)
      forces[b] = Positions::Zero(3, model.bodies[b].collider->X.cols());
  for (const ContactPairState* pair_state : response.pair_states()) {
    const ContactSides side = sides_of(model, *pair_state);
    const auto &triangles = side.triangles.surface.faces, &faces = side.faces.surface.faces;
    const auto& groups = side.triangles.groups;
    for (const ContactPairState::Patch& entry : pair_state->patches()) {
      if (!carries(*pair_state, entry.triangle, groups)) continue;
      const Vec18 on_nodes = forces_on_nodes(*pair_state, entry, groups);
      for (int i = 0; i < 3; ++i) {
        forces[static_cast<std::size_t>(side.triangle_body)].col(triangles(i, entry.triangle)) +=
            on_nodes.segment<3>(3 * i);
        forces[static_cast<std::size_t>(side.face_body)].col(faces(i, entry.face)) +=
            on_nodes.segment<3>(9 + 3 * i);
      }
    }
  }
  return forces;
}

namespace {

/// Sums over the patches at the nodes and faces of a body.
struct SurfaceSums {
  Eigen::VectorXd node_force, node_area;            // ∫ N p dA [N], ∫ N dA [m²]
  Eigen::VectorXd face_force, face_gap, face_area;  // [N], [m³], [m²]
};

/// Of one patch, with N at the triangle's nodes and β at the face's.
void add_nodes(const ContactPairState::Patch& entry, const Vec3& p, double share,
               const Collider& triangles, const Collider& faces, SurfaceSums& of_triangles,
               SurfaceSums& of_faces) {
  const Vec3 area = nodal_areas(entry.patch);
  const Vec3 reaction = entry.patch.beta * entry.patch.Q * p, opposite = entry.patch.beta * area;
  for (int i = 0; i < 3; ++i) {
    const int node = triangles.surface.faces(i, entry.triangle);
    of_triangles.node_force[node] += p[i] * area[i];  // gives p[i] back where all is one contact's
    of_triangles.node_area[node] += share * area[i];
    const int other = faces.surface.faces(i, entry.face);
    of_faces.node_force[other] += reaction[i];
    of_faces.node_area[other] += share * opposite[i];
  }
}

void add_faces(const ContactPairState::Patch& entry, const Vec3& p, SurfaceSums& of_triangles,
               SurfaceSums& of_faces) {
  const double force = normal_forces(entry.patch, p).sum(),
               gap = -depth_integrals(entry.patch).sum();
  const auto add = [&](int face, double normal_force, SurfaceSums& sums) {
    sums.face_force[face] += normal_force;
    sums.face_gap[face] += gap;
    sums.face_area[face] += entry.patch.area;
  };
  add(entry.triangle, force, of_triangles);
  add(entry.face, force / -entry.patch.cosine, of_faces);  // what acts is along the face's normal
}

SurfaceSums no_sums(const Collider& collider) {
  const Eigen::VectorXd nodes = Eigen::VectorXd::Zero(collider.X.cols());
  const Eigen::VectorXd faces = Eigen::VectorXd::Zero(collider.surface.faces.cols());
  return {nodes, nodes, faces, faces, faces};
}

SurfaceContact means(const SurfaceSums& sums, const Collider& collider,
                     const Configuration& configuration) {
  // Of a face: where less than this lies opposite, it does so by round-off, and means are noise.
  constexpr double kLeastPart = 1e-9;
  double largest = 0;
  Eigen::VectorXd area_now(sums.face_area.size());
  for (Eigen::Index f = 0; f < area_now.size(); ++f) {
    largest = std::max(largest, collider.face_area[static_cast<std::size_t>(f)]);
    const int face = static_cast<int>(f);
    area_now[f] = 0.5 * flat_triangle(corners_of(configuration, collider, face)).twice_area;
  }
  const auto mean = [least = kLeastPart * largest](const Eigen::VectorXd& sum,
                                                   const Eigen::VectorXd& area, double nothing) {
    return Eigen::VectorXd((area.array() > least).select(sum.array() / area.array(), nothing));
  };
  return {mean(sums.node_force, sums.node_area, 0), mean(sums.face_force, area_now, 0),
          mean(sums.face_gap, sums.face_area, std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace

std::vector<SurfaceContact> surface_contacts(const Model& model, const ContactResponse& response,
                                             const Configuration& configuration) {
  std::vector<SurfaceSums> sums(model.bodies.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (model.bodies[b].collider) sums[b] = no_sums(*model.bodies[b].collider);
  for (const ContactPairState* pair_state : response.pair_states()) {
    const ContactSides side = sides_of(model, *pair_state);
    const double share = model.contacts[static_cast<std::size_t>(pair_state->contact)].share;
    SurfaceSums& of_triangles = sums[static_cast<std::size_t>(side.triangle_body)];
    SurfaceSums& of_faces = sums[static_cast<std::size_t>(side.face_body)];
    const auto& groups = side.triangles.groups;
    for (const ContactPairState::Patch& entry : pair_state->patches()) {
      const Vec3 p = nodal_pressures(*pair_state, entry, groups);
      add_faces(entry, p, of_triangles, of_faces);
      // What is near, but carries nothing, must not thin out another contact at the same node. Of a
      // body with itself both directions count, or half the pressure would stand for all of it.
      if (carries(*pair_state, entry.triangle, groups) || side.is_self())
        add_nodes(entry, p, share, side.triangles, side.faces, of_triangles, of_faces);
    }
  }
  std::vector<SurfaceContact> result(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (model.bodies[b].collider)
      result[b] = means(sums[b], *model.bodies[b].collider, configuration);
  return result;
}

}  // namespace articular::sim
