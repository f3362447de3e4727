#include "sim/contact_response.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace articular::sim {

/// The side whose triangles are averaged over, and the side whose faces they meet.
struct ContactResponse::Sides {
  const Collider& triangles;
  const Collider& faces;
  int triangle_body, face_body;
  const Eigen::VectorXd& stiffness;  // at the nodes of the triangles' side [Pa/m]
};

std::array<const NodeRef*, 6> nodes_of(const Collider& triangles, const Collider& faces,
                                       int triangle, int face) {
  std::array<const NodeRef*, 6> nodes{};
  for (int i = 0; i < 3; ++i) {
    nodes[static_cast<std::size_t>(i)] =
        &triangles.nodes[static_cast<std::size_t>(triangles.surface.faces(i, triangle))];
    nodes[static_cast<std::size_t>(3 + i)] =
        &faces.nodes[static_cast<std::size_t>(faces.surface.faces(i, face))];
  }
  return nodes;
}

bool carries(const DirectionMoment& direction, int triangle, const Eigen::Matrix3Xi& faces) {
  return direction.pressure[faces(0, triangle)] > 0 || direction.pressure[faces(1, triangle)] > 0 ||
         direction.pressure[faces(2, triangle)] > 0;
}

namespace {

Mat3 corners(const Configuration& configuration, const Collider& collider, int face) {
  Mat3 x;
  for (int i = 0; i < 3; ++i)
    x.col(i) = configuration.position(
        collider.nodes[static_cast<std::size_t>(collider.surface.faces(i, face))]);
  return x;
}

/// Pressures at the nodes of a patch's triangle [Pa].
Vec3 nodal_pressures(const DirectionMoment& direction, const DirectionMoment::Patch& entry,
                     const Eigen::Matrix3Xi& faces) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) {
    const int node = faces(i, entry.triangle);
    p[i] = direction.pressure[node];
    if (!(direction.point_stiffness > 0)) continue;
    p[i] = direction.point_stiffness * entry.patch.depth[i];
    if (!direction.drag.empty()) p[i] += direction.drag[static_cast<std::size_t>(node)].pressure;
  }
  return p;
}

/// Forces on a patch's six nodes.
Vec18 forces_on_nodes(const DirectionMoment& direction, const DirectionMoment::Patch& entry,
                      const Eigen::Matrix3Xi& faces) {
  Vec18 forces = -patch_gradient(entry.patch, nodal_pressures(direction, entry, faces));
  if (direction.drag.empty()) return forces;
  Mat3 t;
  for (int i = 0; i < 3; ++i)
    t.col(i) = direction.drag[static_cast<std::size_t>(faces(i, entry.triangle))].traction;
  return forces + slip_gradient(entry.patch, t);
}

}  // namespace

ContactResponse::ContactResponse(const Model& model) : model_(model) {
  gradient_.setZero(3, model.num_blocks);
  has_gradient_.assign(static_cast<std::size_t>(model.num_blocks), 0);
}

const ContactModel& ContactResponse::contact_of(std::size_t direction) const {
  return model_.contacts[static_cast<std::size_t>((*candidates_)[direction].contact)];
}

ContactResponse::Sides ContactResponse::sides(std::size_t direction) const {
  const CandidateList& list = (*candidates_)[direction];
  const ContactModel& contact = model_.contacts[static_cast<std::size_t>(list.contact)];
  const Collider& a = *model_.bodies[static_cast<std::size_t>(contact.a)].collider;
  const Collider& b = *model_.bodies[static_cast<std::size_t>(contact.b)].collider;
  if (list.reversed)
    return {b, a, contact.b, contact.a, soft_ ? contact.soft_b : contact.stiffness_b};
  return {a, b, contact.a, contact.b, soft_ ? contact.soft_a : contact.stiffness_a};
}

void ContactResponse::evaluate(const Configuration& configuration,
                               const std::vector<CandidateList>& candidates) {
  candidates_ = &candidates;
  directions_.resize(candidates.size());
  for (std::size_t d = 0; d < candidates.size(); ++d) {
    DirectionMoment& direction = directions_[d];
    const Eigen::Index num_nodes = sides(d).triangles.X.cols();
    for (Eigen::VectorXd* values :
         {&direction.area, &direction.measure, &direction.depth, &direction.pressure}) {
      if (values->size() == 0) values->setZero(num_nodes);
      for (const int node : direction.nodes) (*values)[node] = 0;
    }
    direction.nodes.clear();
    find_patches(d, configuration);
    const Eigen::VectorXd& stiffness = sides(d).stiffness;
    direction.point_stiffness = contact_of(d).averaged ? 0 : stiffness[0] * stiffening_of(d);
    for (const int node : direction.nodes) {
      direction.depth[node] /= direction.measure[node];
      const double k = stiffness[node] * stiffening_of(d);
      const double multiplier = direction.multiplier.size() > 0 ? direction.multiplier[node] : 0;
      direction.pressure[node] = std::max(0.0, multiplier + k * direction.depth[node]);
    }
    direction.drag.clear();
    if (candidates[d].pairs.empty()) continue;
    ++evaluations_[Term::ContactForce];
    const SurfaceLaw& law = contact_of(d).law;
    if (!law.acts()) continue;
    find_drag(law, sides(d).triangles, sides(d).faces, configuration, direction);
    if (law.friction > 0) ++evaluations_[Term::Friction];
    if (law.damping > 0) ++evaluations_[Term::ContactDamping];
  }
}

double ContactResponse::stiffening_of(std::size_t direction) const {
  return stiffening_.size() > 0 ? stiffening_[(*candidates_)[direction].contact] : 1;
}

bool ContactResponse::augment() {
  bool any = false;
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    DirectionMoment& direction = directions_[d];
    const ContactModel& contact = contact_of(d);
    if (!contact.is_bounded || !contact.averaged) continue;
    const bool exceeds = std::any_of(direction.nodes.begin(), direction.nodes.end(), [&](int node) {
      return direction.pressure[node] > 0 && direction.depth[node] > contact.max_penetration;
    });
    if (!exceeds) continue;
    direction.multiplier = direction.pressure;
    any = true;
  }
  return any;
}

void ContactResponse::drop_multipliers() {
  for (DirectionMoment& direction : directions_) direction.multiplier.resize(0);
}

const FlatTriangle& ContactResponse::face_now(const Configuration& configuration,
                                              const Collider& faces, int face) {
  const auto f = static_cast<std::size_t>(face);
  if (met_[f] != now_) {
    met_[f] = now_;
    faces_[f] = flat_triangle(corners(configuration, faces, face));
  }
  return faces_[f];
}

/// Patches of a direction, and what they sum to at nodes: W, A and (in place of g) G.
void ContactResponse::find_patches(std::size_t d, const Configuration& configuration) {
  const Sides side = sides(d);
  DirectionMoment& direction = directions_[d];
  direction.num_patches = 0;
  ++now_;
  if (faces_.size() < side.faces.face_area.size()) {
    faces_.resize(side.faces.face_area.size());
    met_.resize(side.faces.face_area.size(), 0);
  }
  const bool averaged = contact_of(d).averaged;
  DepthRange range = depth_range(side.triangles, side.faces, averaged);
  if (!allowances_.empty())
    range.allowance = allowances_[static_cast<std::size_t>((*candidates_)[d].contact)];
  const std::vector<ContactCandidate>& pairs = (*candidates_)[d].pairs;
  for (std::size_t first = 0; first < pairs.size();) {  // they come sorted by triangle
    const int triangle = pairs[first].triangle;
    const FlatTriangle s = flat_triangle(corners(configuration, side.triangles, triangle));
    const double rest_area = side.triangles.face_area[static_cast<std::size_t>(triangle)];
    Vec3 covered = Vec3::Zero(), integrals = Vec3::Zero();
    for (; first < pairs.size() && pairs[first].triangle == triangle; ++first) {
      const int face = pairs[first].face;
      range.reach = pairs[first].reach;
      if (direction.num_patches == direction.stored.size()) direction.stored.emplace_back();
      DirectionMoment::Patch& entry = direction.stored[direction.num_patches];
      if (!contact_patch(s, face_now(configuration, side.faces, face), rest_area, range,
                         entry.patch))
        continue;
      ++direction.num_patches;
      entry.triangle = triangle;
      entry.face = face;
      covered += nodal_areas(entry.patch);
      integrals += depth_integrals(entry.patch);
    }
    for (int i = 0; i < 3; ++i) {
      if (!(covered[i] > 0)) continue;
      const int node = side.triangles.surface.faces(i, triangle);
      if (direction.measure[node] == 0) direction.nodes.push_back(node);
      direction.measure[node] += averaged ? std::sqrt(covered[i] * rest_area / 3) : covered[i];
      direction.area[node] += covered[i];
      direction.depth[node] += integrals[i];
    }
  }
}

void ContactResponse::add_force(const Configuration& configuration, Eigen::VectorXd& f) {
  force_on_bodies_.assign(model_.bodies.size(), 0);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const Sides side = sides(d);
    Vec3 on_triangles = Vec3::Zero();
    for (const DirectionMoment::Patch& entry : directions_[d].patches()) {
      if (!carries(directions_[d], entry.triangle, side.triangles.surface.faces)) continue;
      const Vec18 forces = forces_on_nodes(directions_[d], entry, side.triangles.surface.faces);
      const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
      for (std::size_t i = 0; i < 6; ++i)
        sim::add_force(configuration, *nodes[i],
                       forces.segment<3>(3 * static_cast<Eigen::Index>(i)), f);
      on_triangles += forces.segment<3>(0) + forces.segment<3>(3) + forces.segment<3>(6);
    }
    if (side.triangle_body == side.face_body) continue;
    for (const int body : {side.triangle_body, side.face_body})
      force_on_bodies_[static_cast<std::size_t>(body)] += on_triangles.norm();
  }
}

bool ContactResponse::has_patches() const {
  return std::any_of(directions_.begin(), directions_.end(),
                     [](const DirectionMoment& direction) { return direction.num_patches > 0; });
}

std::vector<double> ContactResponse::point_depths() const {
  std::vector<double> deepest(model_.contacts.size(), 0);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    double& depth = deepest[static_cast<std::size_t>((*candidates_)[d].contact)];
    for (const DirectionMoment::Patch& entry : directions_[d].patches())
      depth = std::max(depth, entry.patch.depth_max);
  }
  return deepest;
}

double ContactResponse::largest_force() const {
  double largest = 0;
  for (const DirectionMoment& direction : directions_)
    for (const int node : direction.nodes)
      largest = std::max(largest, direction.pressure[node] * direction.area[node]);
  return largest;
}

std::vector<Positions> ContactResponse::nodal_forces() const {
  std::vector<Positions> forces(model_.bodies.size());
  for (std::size_t b = 0; b < model_.bodies.size(); ++b)
    if (model_.bodies[b].collider)
      forces[b] = Positions::Zero(3, model_.bodies[b].collider->X.cols());
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const Sides side = sides(d);
    const auto &triangles = side.triangles.surface.faces, &faces = side.faces.surface.faces;
    for (const DirectionMoment::Patch& entry : directions_[d].patches()) {
      if (!carries(directions_[d], entry.triangle, triangles)) continue;
      const Vec18 on_nodes = forces_on_nodes(directions_[d], entry, triangles);
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

/// A summary on its way: its center is still Σ p x dA.
struct ContactResponse::SummarySums {
  ContactSummary summary;
  Vec3 moment = Vec3::Zero();            // about the origin
  Eigen::VectorXd through_a, through_b;  // normal force through each face of the two bodies [N]
};

ContactResponse::SummarySums ContactResponse::no_summary(std::size_t c) const {
  const auto faces = [&](int body) {
    return Eigen::VectorXd::Zero(
        model_.bodies[static_cast<std::size_t>(body)].collider->surface.faces.cols());
  };
  SummarySums sums;
  sums.through_a = faces(model_.contacts[c].a);
  sums.through_b = faces(model_.contacts[c].b);
  return sums;
}

/// Adds the patches that count. What nodes have is summed over their patches too, so that parts add
/// up to the whole.
template <class Counts>
void ContactResponse::add_to_summary(std::size_t d, const Configuration& configuration,
                                     Counts&& counts, SummarySums& sums) const {
  ContactSummary& sum = sums.summary;
  const DirectionMoment& direction = directions_[d];
  const CandidateList& list = (*candidates_)[d];
  const Sides side = sides(d);
  const double share = contact_of(d).share;
  const bool is_self = side.triangle_body == side.face_body;
  Eigen::VectorXd& through_triangle = list.reversed && !is_self ? sums.through_b : sums.through_a;
  Eigen::VectorXd& through_face = list.reversed || is_self ? sums.through_a : sums.through_b;
  const auto& triangles = side.triangles.surface.faces;
  for (const DirectionMoment::Patch& entry : direction.patches()) {
    if (!carries(direction, entry.triangle, triangles) || !counts(entry)) continue;
    const Mat3 x = corners(configuration, side.triangles, entry.triangle);
    const Vec3 area = nodal_areas(entry.patch);
    for (int i = 0; i < 3; ++i) {
      const int node = triangles(i, entry.triangle);
      if (!(direction.pressure[node] > 0)) continue;
      if (!(area[i] > 0)) continue;
      sum.area += area[i] * share;
      if (!(direction.point_stiffness > 0)) {  // of the node's energy its part by area
        const double damping =
            direction.drag.empty() ? 0 : direction.drag[static_cast<std::size_t>(node)].pressure;
        sum.energy += 0.5 * (direction.pressure[node] - damping) *
                      std::max(0.0, direction.depth[node]) * direction.measure[node] * area[i] /
                      direction.area[node];
      }
      sum.max_pressure = std::max(sum.max_pressure, direction.pressure[node] / share);
      if (direction.depth[node] > sum.max_depth) {
        sum.max_depth = direction.depth[node];
        sum.deepest = x.col(i);
      }
    }
    sum.max_point_depth = std::max(sum.max_point_depth, entry.patch.depth_max);
    sum.energy +=
        0.5 * direction.point_stiffness * entry.patch.depth.dot(depth_integrals(entry.patch));
    const Vec3 q = entry.patch.Q * nodal_pressures(direction, entry, triangles);
    sum.normal_force += q.sum();
    sum.center += x * q;
    through_triangle[entry.triangle] += q.sum();
    through_face[entry.face] += q.sum() / -entry.patch.cosine;  // it acts along the face's normal
    if (is_self) continue;
    const Vec18 on_nodes = forces_on_nodes(direction, entry, triangles);
    for (int i = 0; i < 3; ++i) {
      const Vec3 force = (list.reversed ? -1 : 1) * on_nodes.segment<3>(3 * i);
      sum.force += force;
      sums.moment += x.col(i).cross(force);
    }
  }
}

ContactSummary ContactResponse::finished(SummarySums sums, std::size_t c,
                                         const Configuration& configuration) const {
  ContactSummary& sum = sums.summary;
  if (sum.normal_force > 0) sum.center /= sum.normal_force;
  sum.moment = sums.moment - sum.center.cross(sum.force);
  const auto add_faces = [&](const Eigen::VectorXd& through, int body) {
    const Collider& collider = *model_.bodies[static_cast<std::size_t>(body)].collider;
    for (Eigen::Index f = 0; f < through.size(); ++f) {
      if (!(through[f] > 0)) continue;
      const Mat3 x = corners(configuration, collider, static_cast<int>(f));
      const double area = 0.5 * flat_triangle(x).twice_area;
      if (area > 0) sum.max_face_pressure = std::max(sum.max_face_pressure, through[f] / area);
    }
  };
  add_faces(sums.through_a, model_.contacts[c].a);
  add_faces(sums.through_b, model_.contacts[c].b);
  return sum;
}

std::vector<ContactSummary> ContactResponse::summaries(const Configuration& configuration) const {
  std::vector<SummarySums> sums;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) sums.push_back(no_summary(c));
  for (std::size_t d = 0; d < directions_.size(); ++d)
    add_to_summary(
        d, configuration, [](const DirectionMoment::Patch&) { return true; },
        sums[static_cast<std::size_t>((*candidates_)[d].contact)]);
  std::vector<ContactSummary> result;
  for (std::size_t c = 0; c < sums.size(); ++c)
    result.push_back(finished(std::move(sums[c]), c, configuration));
  return result;
}

ContactSummary ContactResponse::summary_through(const Configuration& configuration, int contact,
                                                int body, const std::vector<char>& selected) const {
  const auto c = static_cast<std::size_t>(contact);
  SummarySums sums = no_summary(c);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    if ((*candidates_)[d].contact != contact) continue;
    const bool is_triangle = sides(d).triangle_body == body;
    const auto counts = [&](const DirectionMoment::Patch& entry) {
      return selected.empty() ||
             selected[static_cast<std::size_t>(is_triangle ? entry.triangle : entry.face)] != 0;
    };
    add_to_summary(d, configuration, counts, sums);
  }
  return finished(std::move(sums), c, configuration);
}

namespace {

/// Sums over the patches at the nodes and faces of a body.
struct SurfaceSums {
  Eigen::VectorXd node_force, node_area;            // ∫ N p dA [N], ∫ N dA [m²]
  Eigen::VectorXd face_force, face_gap, face_area;  // [N], [m³], [m²]
};

/// Of one patch, with N at the triangle's nodes and β at the face's.
void add_nodes(const DirectionMoment::Patch& entry, const Vec3& p, double share,
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

void add_faces(const DirectionMoment::Patch& entry, const Vec3& p, SurfaceSums& of_triangles,
               SurfaceSums& of_faces) {
  const double force = (entry.patch.Q * p).sum(), gap = -depth_integrals(entry.patch).sum();
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
    area_now[f] = 0.5 * flat_triangle(corners(configuration, collider, face)).twice_area;
  }
  const auto mean = [least = kLeastPart * largest](const Eigen::VectorXd& sum,
                                                   const Eigen::VectorXd& area, double nothing) {
    return Eigen::VectorXd((area.array() > least).select(sum.array() / area.array(), nothing));
  };
  return {mean(sums.node_force, sums.node_area, 0), mean(sums.face_force, area_now, 0),
          mean(sums.face_gap, sums.face_area, std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace

std::vector<SurfaceContact> ContactResponse::surface_contacts(
    const Configuration& configuration) const {
  std::vector<SurfaceSums> sums(model_.bodies.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (model_.bodies[b].collider) sums[b] = no_sums(*model_.bodies[b].collider);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const Sides side = sides(d);
    const double share = model_.contacts[static_cast<std::size_t>((*candidates_)[d].contact)].share;
    SurfaceSums& of_triangles = sums[static_cast<std::size_t>(side.triangle_body)];
    SurfaceSums& of_faces = sums[static_cast<std::size_t>(side.face_body)];
    const auto& triangles = side.triangles.surface.faces;
    for (const DirectionMoment::Patch& entry : directions_[d].patches()) {
      const Vec3 p = nodal_pressures(directions_[d], entry, triangles);
      add_faces(entry, p, of_triangles, of_faces);
      // What is near, but carries nothing, must not thin out another contact at the same node. Of a
      // body with itself both directions count, or half the pressure would stand for all of it.
      if (carries(directions_[d], entry.triangle, triangles) ||
          side.triangle_body == side.face_body)
        add_nodes(entry, p, share, side.triangles, side.faces, of_triangles, of_faces);
    }
  }
  std::vector<SurfaceContact> result(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
    if (model_.bodies[b].collider)
      result[b] = means(sums[b], *model_.bodies[b].collider, configuration);
  return result;
}

void ContactResponse::add_damping_product(const Configuration& configuration,
                                          const Eigen::VectorXd& u, double scale,
                                          Eigen::VectorXd& f) const {
  for (std::size_t d = 0; d < directions_.size(); ++d)
    if (!directions_[d].drag.empty())
      add_drag_product(directions_[d], sides(d).triangles, sides(d).faces, configuration, u, scale,
                       f);
}

double ContactResponse::damping_power() const {
  double power = 0;
  for (const DirectionMoment& direction : directions_) power += drag_power(direction);
  return power;
}

void ContactResponse::add_stiffness(const Configuration& configuration, fem::Tangent tangent,
                                    const SystemScale& scale, fem::BlockMatrix& A) {
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    if (directions_[d].num_patches == 0) continue;
    ++evaluations_[Term::ContactStiffness];
    add_node_stiffness(d, configuration, tangent, scale, A);
    const double k = scale.stiffness * directions_[d].point_stiffness;
    if (tangent != fem::Tangent::Consistent && k == 0) continue;
    const Sides side = sides(d);
    const auto& triangles = side.triangles.surface.faces;
    for (const DirectionMoment::Patch& entry : directions_[d].patches()) {
      if (!carries(directions_[d], entry.triangle, triangles)) continue;
      PatchStiffness stiffness = patch_stiffness(entry.patch, k);
      if (tangent == fem::Tangent::Consistent)
        add_curvature(entry.patch,
                      scale.stiffness * nodal_pressures(directions_[d], entry, triangles),
                      stiffness);
      add_product(model_, configuration,
                  nodes_of(side.triangles, side.faces, entry.triangle, entry.face), stiffness.left,
                  stiffness.right, A);
    }
  }
}

/// The patches around node i: patch_of_node_[patch_begin_[i] .. patch_begin_[i + 1]).
void ContactResponse::find_patches_of_nodes(std::size_t d) {
  const DirectionMoment& direction = directions_[d];
  const Sides side = sides(d);
  const auto& triangles = side.triangles.surface.faces;
  patch_begin_.assign(static_cast<std::size_t>(side.triangles.X.cols()) + 2, 0);
  for (const DirectionMoment::Patch& entry : direction.patches())
    for (const int node : triangles.col(entry.triangle))
      ++patch_begin_[static_cast<std::size_t>(node) + 2];
  for (std::size_t i = 1; i < patch_begin_.size(); ++i) patch_begin_[i] += patch_begin_[i - 1];
  patch_of_node_.resize(3 * direction.num_patches);
  for (std::size_t e = 0; e < direction.num_patches; ++e)
    for (const int node : triangles.col(direction.stored[e].triangle))
      patch_of_node_[static_cast<std::size_t>(patch_begin_[static_cast<std::size_t>(node) + 1]++)] =
          static_cast<int>(e);
}

/// A += factor g gᵀ, where g sums gradient(patch, place of the node in its triangle) over the
/// patches around a node.
template <class Gradient>
void ContactResponse::add_rank_one(std::size_t d, int a, const Configuration& configuration,
                                   double factor, Gradient&& gradient, fem::BlockMatrix& A) {
  const DirectionMoment& direction = directions_[d];
  const Sides side = sides(d);
  const auto& triangles = side.triangles.surface.faces;
  const auto add = [&](const NodeRef& node, const Vec3& g) {
    if (node.bone >= model_.layout.num_rigid) return;
    const auto put = [&](int block, const Vec3& part) {
      if (has_gradient_[static_cast<std::size_t>(block)] == 0) {
        has_gradient_[static_cast<std::size_t>(block)] = 1;
        blocks_.push_back(block);
      }
      gradient_.col(block) += part;
    };
    put(node.block, g);
    if (node.bone >= 0) put(node.block + 1, configuration.lever(node).cross(g));
  };
  for (int k = patch_begin_[static_cast<std::size_t>(a)];
       k < patch_begin_[static_cast<std::size_t>(a) + 1]; ++k) {
    const DirectionMoment::Patch& entry =
        direction.stored[static_cast<std::size_t>(patch_of_node_[static_cast<std::size_t>(k)])];
    int local = 0;
    while (triangles(local, entry.triangle) != a) ++local;
    const Vec18 g = gradient(entry.patch, local);
    const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
    for (std::size_t i = 0; i < 6; ++i)
      add(*nodes[i], g.segment<3>(3 * static_cast<Eigen::Index>(i)));
  }
  for (const int i : blocks_)
    for (const int j : blocks_)
      A.block(A.slot(i, j)) += factor * gradient_.col(i) * gradient_.col(j).transpose();
  for (const int block : blocks_) {
    gradient_.col(block).setZero();
    has_gradient_[static_cast<std::size_t>(block)] = 0;
  }
  blocks_.clear();
}

/// Σ k_a/A_a ∇G_a ∇G_aᵀ, the same with the damping, and −∂t_a/∂V_a.
void ContactResponse::add_node_stiffness(std::size_t d, const Configuration& configuration,
                                         fem::Tangent tangent, const SystemScale& scale,
                                         fem::BlockMatrix& A) {
  const DirectionMoment& direction = directions_[d];
  const Sides side = sides(d);
  const bool averaged = !(direction.point_stiffness > 0);
  if (!averaged && direction.drag.empty()) return;
  find_patches_of_nodes(d);
  const auto of_depth = [](const ContactPatch& patch, int local) {
    return patch_gradient(patch, Vec3::Unit(local));
  };
  for (const int a : direction.nodes) {
    if (!(direction.pressure[a] > 0)) continue;
    const double penalty =
        scale.stiffness * side.stiffness[a] * stiffening_of(d) / direction.measure[a];
    if (direction.drag.empty()) {
      add_rank_one(d, a, configuration, penalty, of_depth, A);
      continue;
    }
    const NodalDrag& drag = direction.drag[static_cast<std::size_t>(a)];
    add_rank_one(d, a, configuration,
                 (averaged ? drag.stiffening * penalty : 0) +
                     scale.damping * drag.damping / direction.measure[a],
                 of_depth, A);
    // Friction grows with the slip ever more slowly: the secant is an upper bound of the tangent.
    const double along = tangent == fem::Tangent::Consistent ? drag.drag_along : drag.drag_across;
    for (const auto& [direction_of_slip, strength] :
         {std::pair(drag.along, along), std::pair(drag.across, drag.drag_across)}) {
      if (!(scale.damping * strength > 0)) continue;
      const Vec3& unit = direction_of_slip;
      add_rank_one(
          d, a, configuration, scale.damping * strength / direction.area[a],
          [&unit](const ContactPatch& patch, int local) {
            return slip_gradient(patch, unit * Vec3::Unit(local).transpose());
          },
          A);
    }
  }
}

namespace {

void sort_unique(std::vector<int>& blocks) {
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

/// Blocks of three nodes, each once.
void find_blocks(const Model& model, const Collider& collider, int face, std::vector<int>& blocks) {
  blocks.clear();
  for (const int node : collider.surface.faces.col(face))
    append_blocks(model, collider.nodes[static_cast<std::size_t>(node)], blocks);
  sort_unique(blocks);
}

bool lacks(const fem::BlockMatrix& A, std::span<const int> rows, std::span<const int> columns) {
  return std::any_of(rows.begin(), rows.end(), [&](int i) {
    return std::any_of(columns.begin(), columns.end(), [&](int j) { return A.slot(i, j) < 0; });
  });
}

/// Pointwise, a candidate couples the triangle with the face; each is coupled in itself as part of
/// an element or a bone.
void append_missing_pairs(const Model& model, const CandidateList& list, const Collider& triangles,
                          const Collider& faces, const fem::BlockMatrix& A, Stencils& stencils) {
  std::vector<int> of_triangle, of_face;
  for (const ContactCandidate& candidate : list.pairs) {
    find_blocks(model, triangles, candidate.triangle, of_triangle);
    find_blocks(model, faces, candidate.face, of_face);
    if (!lacks(A, of_triangle, of_face)) continue;
    of_triangle.insert(of_triangle.end(), of_face.begin(), of_face.end());
    sort_unique(of_triangle);
    stencils.blocks.insert(stencils.blocks.end(), of_triangle.begin(), of_triangle.end());
    stencils.close();
  }
}

/// An average couples all around its node.
void append_missing_averages(const Model& model, const CandidateList& list,
                             const Collider& triangles, const Collider& faces,
                             const fem::BlockMatrix& A, Stencils& stencils) {
  std::vector<std::vector<int>> blocks_of_node(static_cast<std::size_t>(triangles.X.cols()));
  for (const ContactCandidate& candidate : list.pairs)
    for (const int a : triangles.surface.faces.col(candidate.triangle))
      for (const NodeRef* node : nodes_of(triangles, faces, candidate.triangle, candidate.face))
        append_blocks(model, *node, blocks_of_node[static_cast<std::size_t>(a)]);
  for (std::vector<int>& blocks : blocks_of_node) {
    if (blocks.empty()) continue;
    sort_unique(blocks);
    if (!lacks(A, blocks, blocks)) continue;
    stencils.blocks.insert(stencils.blocks.end(), blocks.begin(), blocks.end());
    stencils.close();
  }
}

}  // namespace

void append_missing_stencils(const Model& model, const std::vector<CandidateList>& candidates,
                             const fem::BlockMatrix& A, Stencils& stencils) {
  for (const CandidateList& list : candidates) {
    const ContactModel& contact = model.contacts[static_cast<std::size_t>(list.contact)];
    const auto collider = [&](bool second) -> const Collider& {
      return *model.bodies[static_cast<std::size_t>(second ? contact.b : contact.a)].collider;
    };
    const auto append =
        contact.averaged || contact.law.acts() ? append_missing_averages : append_missing_pairs;
    append(model, list, collider(list.reversed), collider(!list.reversed), A, stencils);
  }
}

}  // namespace articular::sim
