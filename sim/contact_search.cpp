#include "sim/contact_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

namespace articular::sim {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Extent extent(const Mat3& triangle, const Vec3& direction) {
  const double p = direction.dot(triangle.col(0)), q = direction.dot(triangle.col(1)),
               r = direction.dot(triangle.col(2));
  return {std::min({p, q, r}), std::max({p, q, r})};
}

bool apart(const Extent& a, const Extent& b, double distance) {
  return a.low - b.high > distance || b.low - a.high > distance;
}

/// The face F can't come to lie opposite the triangle s by motion over a distance: it is farther
/// in front of it or deeper behind it than the range goes, or beside it when seen along the
/// triangle's normal.
bool cannot_meet(const FacePlace& s, const FacePlace& F, const DepthRange& range, double distance) {
  const double plane = s.normal.dot(s.corners.col(0));
  const Extent height = extent(F.corners, s.normal);
  if (height.low - plane > range.open + distance || plane - height.high > range.reach + distance)
    return true;
  for (int k = 0; k < 3; ++k)
    if (apart(s.along[static_cast<std::size_t>(k)], extent(F.corners, s.sides.col(k)), distance))
      return true;
  for (int k = 0; k < 3; ++k) {
    const Vec3 side =
        (F.corners.col((k + 1) % 3) - F.corners.col(k)).cross(s.normal);  // of any length
    if (apart(extent(s.corners, side), extent(F.corners, side), distance * side.norm()))
      return true;
  }
  return false;
}

/// A triangle and a face that move with the same bone, or share a node, do not touch: tissue tied
/// to a bone, or neighbours in one tissue.
bool tied(const Collider& a, int triangle, const Collider& b, int face) {
  for (const int i : a.surface.faces.col(triangle))
    for (const int j : b.surface.faces.col(face)) {
      const NodeRef &p = a.nodes[static_cast<std::size_t>(i)],
                    &q = b.nodes[static_cast<std::size_t>(j)];
      if (p.bone == q.bone && (p.bone >= 0 || p.block == q.block)) return true;
    }
  return false;
}

/// Keeps the candidates whose face itself meets the triangle's body. A triangle that passes the
/// edge of a body also faces that body's far side, which it can't have come through: that side is
/// outside.
void drop_far_faces(const std::vector<collision::Penetration>& faces_in_triangles_body,
                    std::size_t num_faces, std::vector<ContactCandidate>& pairs) {
  if (pairs.empty()) return;
  std::vector<char> meets(num_faces, 0);
  for (const collision::Penetration& p : faces_in_triangles_body)
    meets[static_cast<std::size_t>(p.face)] = 1;
  std::erase_if(pairs, [&](const ContactCandidate& candidate) {
    return meets[static_cast<std::size_t>(candidate.face)] == 0;
  });
}

}  // namespace

DepthRange depth_range(const Collider& triangles, const Collider& faces, bool averaged) {
  return {averaged ? triangles.open_depth : 0, std::min(2 * triangles.reach, faces.reach)};
}

ContactSearch::ContactSearch(const Model& model)
    : model_(model), moving_of_body_(model.bodies.size(), -1) {
  options_.narrow = model.scenario.detection.narrow_test;
  options_.threads = model.scenario.threads;
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const ContactModel& contact = model.contacts[c];
    for (const int body : {contact.a, contact.b}) {
      int& index = moving_of_body_[static_cast<std::size_t>(body)];
      if (index >= 0) continue;
      index = static_cast<int>(moving_.size());
      const Collider& collider = *model.bodies[static_cast<std::size_t>(body)].collider;
      Moving moving;
      moving.body = body;
      moving.tree =
          std::make_unique<collision::BlockTree>(collider.tets, collider.surface, collider.X);
      moving_.push_back(std::move(moving));
      seen_.resize(std::max(seen_.size(), collider.face_area.size()));
    }
    for (const bool reversed : {false, true}) {
      if ((reversed ? contact.stiffness_b : contact.stiffness_a).size() == 0) continue;
      candidates_.push_back({static_cast<int>(c), reversed, {}});
      const auto side = static_cast<std::size_t>(reversed ? contact.b : contact.a);
      if (contact.averaged)
        open_depth_ = std::max(open_depth_, model.bodies[side].collider->open_depth);
    }
  }
}

bool ContactSearch::needs_update(const Moving& moving, double margin) const {
  if (moving.tree->num_updates() == 0 || moving.tree->margin() != margin) return true;
  const BodyModel& body = model_.bodies[static_cast<std::size_t>(moving.body)];
  if (body.bone < 0) return true;
  // Fixed bones are mapped once (for a margin).
  const Bone& bone = model_.bones[static_cast<std::size_t>(body.bone)];
  return bone.unknown || bone.motion.has_value();
}

void ContactSearch::fit(Moving& moving) {
  if (moving.tree->is_fitted()) return;
  moving.tree->fit();
  const BodyModel& body = model_.bodies[static_cast<std::size_t>(moving.body)];
  const Eigen::Matrix3Xi& faces = body.collider->surface.faces;
  moving.faces.resize(static_cast<std::size_t>(faces.cols()));
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    FacePlace& face = moving.faces[static_cast<std::size_t>(f)];
    for (int k = 0; k < 3; ++k) face.corners.col(k) = moving.x.col(faces(k, f));
    const Mat3& p = face.corners;
    face.normal = (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).normalized();
    for (int k = 0; k < 3; ++k) {
      face.sides.col(k) = (p.col((k + 1) % 3) - p.col(k)).cross(face.normal).normalized();
      face.along[static_cast<std::size_t>(k)] = extent(p, face.sides.col(k));
    }
  }
}

void ContactSearch::update(Moving& moving, const Configuration& configuration, double margin) {
  if (!needs_update(moving, margin)) return;
  const Collider& collider = *model_.bodies[static_cast<std::size_t>(moving.body)].collider;
  positions_of(configuration, collider.nodes, moving.x);
  moving.tree->move(moving.x, margin);
  ++counts_.tree_updates;
}

void ContactSearch::find(const Configuration& configuration, double margin) {
  const auto start = Clock::now();
  for (Moving& moving : moving_) update(moving, configuration, margin + open_depth_);
  counts_.update_seconds += seconds_since(start);

  const auto query_start = Clock::now();
  collision::BlockQueryCounts query;
  for (CandidateList& list : candidates_) list.pairs.clear();
  int searched = -1;  // the contact that what was found belongs to
  for (CandidateList& list : candidates_) {
    const ContactModel& contact = model_.contacts[static_cast<std::size_t>(list.contact)];
    Moving& a =
        moving_[static_cast<std::size_t>(moving_of_body_[static_cast<std::size_t>(contact.a)])];
    Moving& b =
        moving_[static_cast<std::size_t>(moving_of_body_[static_cast<std::size_t>(contact.b)])];
    if (contact.a == contact.b) {
      fit(a);
      collision::faces_in_own_body(*a.tree, faces_of_a_, query, scratch_, options_);
      collision::sort_pairs(faces_of_a_, *a.tree, *a.tree, sort_scratch_);
      fill(list, faces_of_a_, faces_of_a_, a, a, margin);
      continue;
    }
    if (!overlap(a.tree->bounds(), b.tree->bounds())) continue;
    if (searched != list.contact) {
      fit(a);
      fit(b);
      collision::faces_in_body(*a.tree, *b.tree, faces_of_a_, query, scratch_, options_);
      collision::faces_in_body(*b.tree, *a.tree, faces_of_b_, query, scratch_, options_);
      collision::sort_pairs(faces_of_a_, *a.tree, *b.tree, sort_scratch_);
      collision::sort_pairs(faces_of_b_, *b.tree, *a.tree, sort_scratch_);
      searched = list.contact;
    }
    if (list.reversed)
      fill(list, faces_of_b_, faces_of_a_, b, a, margin);
    else
      fill(list, faces_of_a_, faces_of_b_, a, b, margin);
  }
  counts_.narrow_tests += query.candidates;
  counts_.reported_pairs += query.pairs;
  counts_.narrow_seconds += query.narrow_seconds;
  counts_.traversal_seconds += seconds_since(query_start) - query.narrow_seconds;
}

void ContactSearch::fill(CandidateList& list, const std::vector<collision::Penetration>& found,
                         const std::vector<collision::Penetration>& reverse, const Moving& a,
                         const Moving& b, double margin) {
  const bool averaged = model_.contacts[static_cast<std::size_t>(list.contact)].averaged;
  collect(found, a, b, averaged, margin, list.pairs);
  const auto& faces = model_.bodies[static_cast<std::size_t>(b.body)].collider->face_area;
  drop_far_faces(reverse, faces.size(), list.pairs);
}

void ContactSearch::collect(const std::vector<collision::Penetration>& found, const Moving& a,
                            const Moving& b, bool averaged, double margin,
                            std::vector<ContactCandidate>& pairs) {
  const Collider& A = *model_.bodies[static_cast<std::size_t>(a.body)].collider;
  const Collider& B = *model_.bodies[static_cast<std::size_t>(b.body)].collider;
  const DepthRange range = depth_range(A, B, averaged);
  std::fill(seen_.begin(), seen_.end(), -1);
  for (const collision::Penetration& p : found) {
    const FacePlace& s = a.faces[static_cast<std::size_t>(p.face)];
    const int begin = B.nearby_begin[static_cast<std::size_t>(p.tetrahedron)];
    const int end = B.nearby_begin[static_cast<std::size_t>(p.tetrahedron) + 1];
    for (int k = begin; k < end; ++k) {
      const int f = B.nearby[static_cast<std::size_t>(k)];
      if (seen_[static_cast<std::size_t>(f)] == p.face) continue;
      seen_[static_cast<std::size_t>(f)] = p.face;
      const FacePlace& face = b.faces[static_cast<std::size_t>(f)];
      // Not yet facing, but it may turn until the step's end.
      if (s.normal.dot(face.normal) > -0.5 * kFacingNone) continue;
      if (cannot_meet(s, face, range, margin)) continue;
      if (tied(A, p.face, B, f)) continue;
      pairs.push_back({p.face, f});
    }
  }
}

namespace {

/// What a collider sweeps, and the range of its nodes' displacements.
struct Sweep {
  Eigen::AlignedBox3d way, displacement;
};

Sweep sweep_of(const Collider& collider, const Configuration& from, const Configuration& to) {
  Sweep sweep;
  for (const NodeRef& node : collider.nodes) {
    const Vec3 a = from.position(node), b = to.position(node);
    sweep.way.extend(a).extend(b);
    sweep.displacement.extend(Vec3(b - a));
  }
  return sweep;
}

}  // namespace

bool ContactSearch::passes_unseen(const Configuration& from, const Configuration& to) const {
  std::vector<Sweep> sweeps;
  for (const Moving& moving : moving_)
    sweeps.push_back(
        sweep_of(*model_.bodies[static_cast<std::size_t>(moving.body)].collider, from, to));
  return std::any_of(model_.contacts.begin(), model_.contacts.end(), [&](const ContactModel& pair) {
    if (pair.a == pair.b) return false;
    const auto a = static_cast<std::size_t>(moving_of_body_[static_cast<std::size_t>(pair.a)]);
    const auto b = static_cast<std::size_t>(moving_of_body_[static_cast<std::size_t>(pair.b)]);
    if (!sweeps[a].way.intersects(sweeps[b].way)) return false;
    const Vec3 most = (sweeps[a].displacement.max() - sweeps[b].displacement.min())
                          .cwiseMax(sweeps[b].displacement.max() - sweeps[a].displacement.min());
    const Collider& A = *model_.bodies[static_cast<std::size_t>(pair.a)].collider;
    const Collider& B = *model_.bodies[static_cast<std::size_t>(pair.b)].collider;
    return most.norm() >
           std::max(depth_range(A, B, pair.averaged).reach, depth_range(B, A, pair.averaged).reach);
  });
}

double ContactSearch::motion_since(const Configuration& configuration) const {
  double largest = 0;
  for (const Moving& moving : moving_) {
    const Collider& collider = *model_.bodies[static_cast<std::size_t>(moving.body)].collider;
    for (std::size_t i = 0; i < collider.nodes.size(); ++i)
      largest = std::max(largest, (configuration.position(collider.nodes[i]) -
                                   moving.x.col(static_cast<Eigen::Index>(i)))
                                      .squaredNorm());
  }
  return std::sqrt(largest);
}

}  // namespace articular::sim
