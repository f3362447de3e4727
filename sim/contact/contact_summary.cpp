#include "sim/contact/contact_summary.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/contact/contact_area.hpp"
#include "sim/contact/contact_pressure.hpp"

namespace articular::sim {
namespace {

/// A contact's surface of one body: what all patches put on it, and where those that count do.
struct CountedLoad {
  PressureLoad all;
  Eigen::VectorXd through;     // by face: normal force of what counts [N]
  std::vector<char> is_group;  // that something of it presses on
};

/// A summary on its way: its centers are still Σ p x dA.
struct SummarySums {
  ContactSummary summary;
  Vec3 moment = Vec3::Zero();  // about the origin
  CountedLoad on_a, on_b;      // of a body with itself all is on a
};

SummarySums no_summary(const Model& model, const Configuration& configuration, ContactId contact) {
  const auto nothing_on = [&](int body) -> CountedLoad {
    const Collider& collider = *model.bodies[static_cast<std::size_t>(body)].collider;
    return {no_load(configuration, collider), Eigen::VectorXd::Zero(collider.surface.faces.cols()),
            std::vector<char>(collider.group_node.size(), 0)};
  };
  const ContactModel pair = model.contacts[contact];
  SummarySums sums;
  sums.summary.contact = contact;
  sums.on_a = nothing_on(pair.a);
  sums.on_b = nothing_on(pair.b);
  return sums;
}

Mat3 corners_at_start(const Collider& collider, int face) {
  return collider.X(Eigen::all, collider.surface.faces.col(face));
}

/// A sum shared out to a face's corners as its force is, which has the last three of a patch's
/// nodes.
Vec3 shares_of_face(const Vec18& on_nodes, double sum) {
  const Mat3 forces = on_nodes.tail<9>().reshaped(3, 3);
  const Vec3 total = forces.rowwise().sum();
  if (!(total.squaredNorm() > 0)) return Vec3::Zero();
  return forces.transpose() * total * (sum / total.squaredNorm());
}

/// Adds the patches that count. What nodes have is summed over their patches too, so that parts add
/// up to the whole.
template <class Counts>
void add_to_summary(const Model& model, const ContactPairState& pair_state,
                    const Configuration& configuration, Counts&& counts, SummarySums& sums) {
  ContactSummary& sum = sums.summary;
  const ContactSides side = sides_of(model, pair_state);
  const ContactModel& contact = pair_state.pair;
  const double share = contact.share;
  const bool is_self = side.is_self();
  CountedLoad& on_triangles = contact.reversed ? sums.on_b : sums.on_a;
  CountedLoad& on_faces = contact.reversed || is_self ? sums.on_a : sums.on_b;
  const auto& groups = side.triangles.groups;
  const bool averaged = !(pair_state.point_stiffness > 0);
  Eigen::VectorXd phi;
  if (averaged) phi = signed_pressures(model, pair_state);
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    add_load(side, pair_state, share, entry, on_triangles.all, on_faces.all);
    if (!carries(pair_state, entry.triangle, groups) || !counts(entry)) continue;
    const Mat3 x = corners_of(configuration, side.triangles, entry.triangle);
    if (averaged)
      sum.area += share * area_that_carries(entry.patch, phi(groups.col(entry.triangle)));
    const Vec3 area = nodal_areas(entry.patch);
    for (int i = 0; i < 3; ++i) {
      const int group = groups(i, entry.triangle);
      if (!(pair_state.pressure[group] > 0)) continue;
      if (!(area[i] > 0)) continue;
      if (averaged)  // of the group's energy its part by area
        sum.energy += group_energy(pair_state, group) * area[i] / pair_state.area[group];
      else
        sum.area += area[i] * share;
      if (pair_state.depth[group] > sum.max_depth) {
        sum.max_depth = pair_state.depth[group];
        sum.deepest = x.col(i);
      }
    }
    sum.max_point_depth = std::max(sum.max_point_depth, entry.patch.depth_max);
    sum.energy += value(entry.patch, point_energy(entry.patch, pair_state.point_stiffness));
    const Vec3 q = pressure_integrals(pair_state, entry, groups);
    sum.normal_force += q.sum();
    sum.center += x * q;
    const Vec18& on_nodes = entry.forces;
    (contact.reversed ? sum.center_on_b : sum.center_on_a) +=
        corners_at_start(side.triangles, entry.triangle) * q;
    if (!is_self)
      (contact.reversed ? sum.center_on_a : sum.center_on_b) +=
          corners_at_start(side.faces, entry.face) * shares_of_face(on_nodes, q.sum());
    on_triangles.through[entry.triangle] += q.sum();
    on_faces.through[entry.face] +=
        q.sum() / -entry.patch.cosine;  // it acts along the face's normal
    for (int i = 0; i < 3; ++i) {
      on_triangles.is_group[static_cast<std::size_t>(groups(i, entry.triangle))] = 1;
      on_faces.is_group[static_cast<std::size_t>(side.faces.groups(i, entry.face))] = 1;
    }
    if (is_self) continue;
    for (int i = 0; i < 3; ++i) {
      const Vec3 force = (contact.reversed ? -1 : 1) * on_nodes.segment<3>(3 * i);
      sum.force += force;
      sums.moment += x.col(i).cross(force);
    }
  }
}

/// The pressures of a body's surface in the summary: those of faces too only where all corners have
/// one. @return around how many nodes they are resolved
int add_pressures(const CountedLoad& on_body, const Collider& collider, ContactSummary& sum) {
  const Eigen::VectorXd pressures = group_pressures(collider, on_body.all),
                        areas = group_areas(collider, on_body.all);
  int num_resolved = 0;
  for (Eigen::Index g = 0; g < pressures.size(); ++g) {
    if (on_body.is_group[static_cast<std::size_t>(g)] == 0 || !(pressures[g] > 0)) continue;
    if (on_body.all.covered[g] >= kLeastShare * areas[g]) ++num_resolved;
    sum.max_pressure = std::max(sum.max_pressure, pressures[g]);
  }
  for (Eigen::Index f = 0; f < on_body.through.size(); ++f) {
    if (!(on_body.through[f] > 0)) continue;
    const auto corners = collider.groups.col(f);
    if (std::any_of(corners.begin(), corners.end(),
                    [&](int g) { return std::isnan(pressures[g]); }))
      continue;
    sum.max_face_pressure =
        std::max(sum.max_face_pressure, on_body.through[f] / on_body.all.face_area[f]);
  }
  return num_resolved;
}

ContactSummary finished(const Model& model, SummarySums sums) {
  ContactSummary& sum = sums.summary;
  if (sum.normal_force > 0)
    for (Vec3* center : {&sum.center, &sum.center_on_a, &sum.center_on_b})
      *center /= sum.normal_force;
  sum.moment = sums.moment - sum.center.cross(sum.force);
  const ContactModel pair = model.contacts[sum.contact];
  const auto collider = [&](int body) -> const Collider& {
    return *model.bodies[static_cast<std::size_t>(body)].collider;
  };
  const int num_resolved = std::max(add_pressures(sums.on_a, collider(pair.a), sum),
                                    add_pressures(sums.on_b, collider(pair.b), sum));
  sum.is_resolved = !(sum.normal_force > 0) ||
                    (num_resolved >= kResolvedNodes && sum.max_face_pressure > 0 && sum.area > 0);
  return sum;
}

}  // namespace

std::vector<ContactSummary> contact_summaries(const Model& model, const ContactResponse& response,
                                              const Configuration& configuration) {
  const auto all = [](const ContactPairState::Patch&) { return true; };
  const auto pair_states = response.pair_states();  // those of a contact lie side by side
  std::vector<ContactSummary> result;
  for (std::size_t d = 0; d < pair_states.size();) {
    const ContactId contact = pair_states[d]->contact;
    SummarySums sums = no_summary(model, configuration, contact);
    for (; d < pair_states.size() && pair_states[d]->contact == contact; ++d)
      add_to_summary(model, *pair_states[d], configuration, all, sums);
    result.push_back(finished(model, std::move(sums)));
  }
  return result;
}

ContactSummary summary_through(const Model& model, const ContactResponse& response,
                               const Configuration& configuration, ContactId contact, int body,
                               const std::vector<char>& selected) {
  SummarySums sums = no_summary(model, configuration, contact);
  for (const ContactPairState* pair_state : response.pair_states()) {
    if (pair_state->contact != contact) continue;
    const ContactSides sides = sides_of(model, *pair_state);
    const auto counts = [&](const ContactPairState::Patch& entry) {
      return is_selected(sides, entry, body, selected);
    };
    add_to_summary(model, *pair_state, configuration, counts, sums);
  }
  return finished(model, std::move(sums));
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
      const Vec18& on_nodes = entry.forces;
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

/// What lies opposite a body's faces: the gap's integral [m³] by its area [m²].
struct GapSums {
  Eigen::VectorXd gap, area;
};

Eigen::VectorXd mean_gaps(const GapSums& sums, const Collider& collider) {
  // Of a face: where less than this lies opposite, it does so by round-off, and means are noise.
  constexpr double kLeastPart = 1e-9;
  double largest = 0;
  for (const double area : collider.face_area) largest = std::max(largest, area);
  return (sums.area.array() > kLeastPart * largest)
      .select(sums.gap.array() / sums.area.array(), std::numeric_limits<double>::quiet_NaN());
}

/// By body, of its faces.
std::vector<Eigen::VectorXd> face_gaps(const Model& model, const ContactResponse& response) {
  std::vector<GapSums> sums(model.bodies.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (model.bodies[b].collider)
      sums[b].gap = sums[b].area =
          Eigen::VectorXd::Zero(model.bodies[b].collider->surface.faces.cols());
  for (const ContactPairState* pair_state : response.pair_states()) {
    const ContactSides side = sides_of(model, *pair_state);
    for (const ContactPairState::Patch& entry : pair_state->patches()) {
      const double gap = -depth_integrals(entry.patch).sum();
      const auto add = [&](int face, GapSums& of_body) {
        of_body.gap[face] += gap;
        of_body.area[face] += entry.patch.area;
      };
      add(entry.triangle, sums[static_cast<std::size_t>(side.triangle_body)]);
      add(entry.face, sums[static_cast<std::size_t>(side.face_body)]);
    }
  }
  std::vector<Eigen::VectorXd> gaps(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (model.bodies[b].collider) gaps[b] = mean_gaps(sums[b], *model.bodies[b].collider);
  return gaps;
}

}  // namespace

std::vector<SurfaceContact> surface_contacts(const Model& model, const ContactResponse& response,
                                             const Configuration& configuration) {
  const std::vector<PressureLoad> loads = pressure_loads(model, response, configuration);
  std::vector<Eigen::VectorXd> gaps = face_gaps(model, response);
  std::vector<SurfaceContact> result(loads.size());
  for (std::size_t b = 0; b < result.size(); ++b)
    if (model.bodies[b].collider)
      result[b] = {node_pressures(*model.bodies[b].collider, loads[b]), face_pressures(loads[b]),
                   std::move(gaps[b])};
  return result;
}

}  // namespace articular::sim
