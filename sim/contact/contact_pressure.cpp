#include "sim/contact/contact_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/build/smoothing_groups.hpp"

namespace articular::sim {
namespace {

/// Of a patch whose points count: its pressure by k d, which dampers change.
double damping_factor(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                      const Eigen::Matrix3Xi& groups) {
  if (pair_state.drag.empty()) return 1;
  const Vec3 depths = depth_integrals(entry.patch).cwiseMax(0);
  if (!(depths.sum() > 0)) return 1;
  Vec3 factor = Vec3::Ones();
  for (int i = 0; i < 3; ++i) {
    const int group = groups(i, entry.triangle);
    const double elastic = pair_state.penalty(group);
    if (elastic > 0) factor[i] = pair_state.pressure[group] / elastic;
  }
  return factor.dot(depths) / depths.sum();
}

/// Around the neighbours of each smoothing group, the largest.
Eigen::VectorXd largest_beside(const Eigen::Matrix3Xi& groups, const Eigen::VectorXd& pressures) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(pressures.size());
  for (const auto& face : groups.colwise())
    for (int i = 0; i < 3; ++i)
      largest[face[i]] =
          std::max({largest[face[i]], pressures[face[(i + 1) % 3]], pressures[face[(i + 2) % 3]]});
  return largest;
}

/// The smoothing groups of peaks that one node alone has, and those around: their means are over
/// the same faces.
std::vector<char> around_lone_peaks(const Eigen::Matrix3Xi& groups,
                                    const Eigen::VectorXd& pressures) {
  const Eigen::VectorXd beside = largest_beside(groups, pressures);
  std::vector<char> result(static_cast<std::size_t>(pressures.size()), 0);
  for (const auto& face : groups.colwise())
    if (std::any_of(face.begin(), face.end(),
                    [&](int g) { return pressures[g] > kMostPeak * beside[g]; }))
      for (const int g : face) result[static_cast<std::size_t>(g)] = 1;
  return result;
}

}  // namespace

Vec3 pressure_integrals(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                        const Eigen::Matrix3Xi& groups) {
  Vec3 p;
  if (pair_state.point_stiffness > 0)
    p = damping_factor(pair_state, entry, groups) * pair_state.point_stiffness * entry.patch.depth;
  else
    for (int i = 0; i < 3; ++i) p[i] = pair_state.pressure[groups(i, entry.triangle)];
  return normal_forces(entry.patch, p).cwiseMax(0);  // by round-off
}

PressureLoad no_load(const Configuration& configuration, const Collider& collider) {
  PressureLoad load;
  load.through = load.face_area = Eigen::VectorXd::Zero(collider.surface.faces.cols());
  load.force = load.covered = Eigen::VectorXd::Zero(std::ssize(collider.group_node));
  for (int f = 0; f < load.face_area.size(); ++f)
    load.face_area[f] = 0.5 * flat_triangle(corners_of(configuration, collider, f)).twice_area;
  return load;
}

void add_load(const ContactSides& side, const ContactPairState& pair_state, double share,
              const ContactPairState::Patch& entry, PressureLoad& on_triangles,
              PressureLoad& on_faces) {
  const auto& groups = side.triangles.groups;
  if (is_beside_rim(entry.patch)) return;  // acts along the face
  // What is near, but carries nothing, must not thin out another contact at the same node. Of a
  // body with itself both directions count, or half the pressure would stand for all of it.
  if (!carries(pair_state, entry.triangle, groups) && !side.is_self()) return;
  const ContactPatch& patch = entry.patch;
  const auto t = static_cast<std::size_t>(entry.triangle);
  const double growth = on_triangles.face_area[entry.triangle] / side.triangles.face_area[t];
  const double oblique = -1 / patch.cosine;  // what acts on the face does along its normal
  const Vec3 q = pressure_integrals(pair_state, entry, groups);
  const Vec3 covered = share * growth * nodal_areas(patch);
  const Vec3 q_opposite = (oblique * (patch.beta * q)).cwiseMax(0),  // by round-off
      covered_opposite = (oblique * (patch.beta * covered)).cwiseMax(0);
  on_triangles.through[entry.triangle] += q.sum();
  on_faces.through[entry.face] += oblique * q.sum();
  for (int i = 0; i < 3; ++i) {
    const int group = groups(i, entry.triangle), other = side.faces.groups(i, entry.face);
    on_triangles.force[group] += q[i];
    on_triangles.covered[group] += covered[i];
    on_faces.force[other] += q_opposite[i];
    on_faces.covered[other] += covered_opposite[i];
  }
}

Eigen::VectorXd group_areas(const Collider& collider, const PressureLoad& load) {
  return areas_of_smoothing_groups(
      collider.groups, load.force.size(),
      {load.face_area.data(), static_cast<std::size_t>(load.face_area.size())});
}

Eigen::VectorXd group_pressures(const Collider& collider, const PressureLoad& load) {
  const Eigen::VectorXd areas = group_areas(collider, load);
  Eigen::VectorXd pressures = Eigen::VectorXd::Zero(areas.size());
  for (Eigen::Index g = 0; g < areas.size(); ++g)
    if (load.force[g] > 0)
      pressures[g] = load.force[g] / std::max(load.covered[g], kLeastShare * areas[g]);
  const std::vector<char> around_peak = around_lone_peaks(collider.groups, pressures);
  for (Eigen::Index g = 0; g < areas.size(); ++g)
    if (load.force[g] > 0 &&
        (load.covered[g] < kBlankShare * areas[g] || around_peak[static_cast<std::size_t>(g)] != 0))
      pressures[g] = std::numeric_limits<double>::quiet_NaN();
  return pressures;
}

Eigen::VectorXd node_pressures(const Collider& collider, const PressureLoad& load) {
  const Eigen::VectorXd of_groups = group_pressures(collider, load);
  Eigen::VectorXd pressures = Eigen::VectorXd::Zero(collider.X.cols());
  for (Eigen::Index g = 0; g < of_groups.size(); ++g) {
    double& p = pressures[collider.group_node[static_cast<std::size_t>(g)]];
    const double of_group = of_groups[g];
    const bool is_blank = std::isnan(of_group);
    if (is_blank ? !(p > 0) : of_group > 0 && !(of_group <= p)) p = of_group;
  }
  return pressures;
}

Eigen::VectorXd face_pressures(const PressureLoad& load) {
  return (load.through.array() > 0)
      .select(load.through.array() / load.face_area.array(),
              Eigen::ArrayXd::Zero(load.through.size()))
      .matrix();
}

std::vector<PressureLoad> pressure_loads(const Model& model, const ContactResponse& response,
                                         const Configuration& configuration) {
  std::vector<PressureLoad> loads(model.bodies.size());
  for (std::size_t b = 0; b < loads.size(); ++b)
    if (model.bodies[b].collider) loads[b] = no_load(configuration, *model.bodies[b].collider);
  for (const ContactPairState* pair_state : response.pair_states()) {
    const ContactSides side = sides_of(model, *pair_state);
    const double share = pair_state->pair.share;
    for (const ContactPairState::Patch& entry : pair_state->patches())
      add_load(side, *pair_state, share, entry, loads[static_cast<std::size_t>(side.triangle_body)],
               loads[static_cast<std::size_t>(side.face_body)]);
  }
  return loads;
}

}  // namespace articular::sim
