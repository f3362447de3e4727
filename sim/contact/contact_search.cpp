#include "sim/contact/contact_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>
#include <utility>

#include "fem/mesh/mesh_parts.hpp"

namespace articular::sim {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Or, not yet, but it may turn until the step's end.
bool may_face(const FaceBounds& s, const FaceBounds& face) {
  return s.normal.dot(face.normal) <= -0.5 * kFacingNone;
}

/// Keeps the candidates whose face itself meets the triangle's body. A triangle that passes the
/// edge of a body also faces that body's far side, which it can't have come through: that side is
/// outside.
void drop_far_faces(const Penetrations& faces_in_triangles_body, std::size_t num_faces,
                    std::vector<ContactCandidate>& pairs) {
  if (pairs.empty()) return;
  std::vector<char> meets(num_faces, 0);
  for (const collision::Penetration& p : faces_in_triangles_body)
    meets[static_cast<std::size_t>(p.face)] = 1;
  std::erase_if(pairs, [&](const ContactCandidate& candidate) {
    return meets[static_cast<std::size_t>(candidate.face)] == 0;
  });
}

std::vector<ContactCandidate> swapped(std::vector<ContactCandidate> pairs) {
  for (ContactCandidate& pair : pairs) std::swap(pair.triangle, pair.face);
  return pairs;
}

/// More candidates, sorted by triangle as the response takes them; of a pair that was found twice
/// the one that reaches deeper.
void merge(const std::vector<ContactCandidate>& more, std::vector<ContactCandidate>& pairs) {
  if (more.empty()) return;
  pairs.insert(pairs.end(), more.begin(), more.end());
  std::sort(pairs.begin(), pairs.end(), [](const ContactCandidate& p, const ContactCandidate& q) {
    return std::tuple(p.triangle, p.face, -p.reach) < std::tuple(q.triangle, q.face, -q.reach);
  });
  const auto same = [](const ContactCandidate& p, const ContactCandidate& q) {
    return p.triangle == q.triangle && p.face == q.face;
  };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
}

/// Of all sides that are averaged over [m]. The first bodies that are looked at have others that
/// make them such a side, or it takes as many questions as there are pairs.
double largest_open_depth(const Model& model) {
  if (!model.contacts.any([](const ContactModel& contact) { return contact.averaged; })) return 0;
  std::vector<int> bodies;
  for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body)
    if (model.contacts.touches(body)) bodies.push_back(body);
  const auto depth = [&](int body) {
    return model.bodies[static_cast<std::size_t>(body)].collider->open_depth;
  };
  std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) { return depth(a) > depth(b); });
  for (const int body : bodies)
    for (const int other : bodies) {
      const std::optional<ContactId> id = model.contacts.between(body, other);
      if (!id) continue;
      const ContactModel contact = model.contacts[*id];
      if (contact.averaged && (contact.reversed ? contact.b : contact.a) == body)
        return depth(body);
    }
  return 0;
}

}  // namespace

bool are_tied(const Collider& a, int triangle, const Collider& b, int face) {
  for (const int i : a.surface.faces.col(triangle))
    for (const int j : b.surface.faces.col(face)) {
      const NodeRef &p = a.nodes[static_cast<std::size_t>(i)],
                    &q = b.nodes[static_cast<std::size_t>(j)];
      if (p.rigid == q.rigid && (p.rigid >= 0 || p.block == q.block)) return true;
    }
  return false;
}

bool are_two_sides(const Collider& body, std::span<const int> part, int triangle, int face) {
  constexpr double kMostElements = 2;
  const auto part_of = [&](int k) {
    return part[static_cast<std::size_t>(body.surface.faces(0, k))];
  };
  if (part_of(triangle) != part_of(face)) return false;
  const auto corners = [&](int k) -> Mat3 { return body.X(Eigen::all, body.surface.faces.col(k)); };
  const auto radius = [](const Mat3& x, const Vec3& center) {
    return (x.colwise() - center).colwise().norm().maxCoeff();
  };
  const Mat3 s = corners(triangle), f = corners(face);
  const FlatTriangle at_s = flat_triangle(s), at_f = flat_triangle(f);
  if (at_s.normal.dot(at_f.normal) >= 0) return false;
  const Vec3 middle = s.rowwise().mean(), center = f.rowwise().mean(), way = middle - center;
  const double depth = -at_f.normal.dot(way);
  const double beside = (way + depth * at_f.normal).norm();
  return depth > 0 && depth <= kMostElements * body.size &&
         beside <= radius(s, middle) + radius(f, center);
}

DepthRange depth_range(const Collider& triangles, const Collider& faces, bool averaged) {
  return {averaged ? triangles.open_depth : 0, std::min(2 * triangles.reach, faces.reach)};
}

ContactSearch::ContactSearch(const Model& model, const StepSettings& settings)
    : model_(model), moving_of_body_(model.bodies.size(), -1), boxes_(model.bodies.size()) {
  std::vector<const Collider*> colliders;
  std::size_t most_faces = 0;
  for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body) {
    if (!model.contacts.touches(body)) continue;
    const Collider& collider = *model.bodies[static_cast<std::size_t>(body)].collider;
    moving_of_body_[static_cast<std::size_t>(body)] = static_cast<int>(moving_.size());
    Moving moving;
    moving.body = body;
    moving.index = moving_.size();
    if (model.contacts.between(body, body))
      moving.part = fem::parts_of_nodes(static_cast<int>(collider.X.cols()), collider.tets);
    moving_.push_back(std::move(moving));
    colliders.push_back(&collider);
    most_faces = std::max(most_faces, collider.face_area.size());
  }
  scratch_.resize(static_cast<std::size_t>(model.pool->num_threads()));
  for (Scratch& scratch : scratch_) scratch.seen.resize(most_faces, 0);
  open_depth_ = largest_open_depth(model);
  penetrations_ = make_penetration_search(colliders, settings.tree, model.pool);
}

bool ContactSearch::needs_update(const Moving& moving, double margin) const {
  // Fixed rigid bodies are mapped once (for a margin).
  return moving.margin != margin || moves(moving);
}

bool ContactSearch::moves(const Moving& moving) const {
  const BodyModel& body = model_.bodies[static_cast<std::size_t>(moving.body)];
  if (body.rigid < 0) return true;
  const RigidBody& rigid = model_.rigid_bodies[static_cast<std::size_t>(body.rigid)];
  return rigid.unknown || rigid.motion.has_value();
}

void ContactSearch::fit(Moving& moving) {
  if (!penetrations_->fit(moving.index)) return;
  // Of a fixed body a run that was resumed would count it once more.
  if (moves(moving)) ++counts_.evaluations[Term::TreeFit];
  const BodyModel& body = model_.bodies[static_cast<std::size_t>(moving.body)];
  const Eigen::Matrix3Xi& faces = body.collider->surface.faces;
  moving.faces.resize(static_cast<std::size_t>(faces.cols()));
  for (Eigen::Index f = 0; f < faces.cols(); ++f)
    moving.faces[static_cast<std::size_t>(f)] = face_bounds(moving.x(Eigen::all, faces.col(f)));
}

void ContactSearch::update(Moving& moving, const Configuration& configuration, double margin) {
  if (!needs_update(moving, margin)) return;
  const Collider& collider = *model_.bodies[static_cast<std::size_t>(moving.body)].collider;
  positions_of(configuration, collider.nodes, moving.x);
  penetrations_->move(moving.index, moving.x, margin);
  moving.margin = margin;
  ++counts_.tree_updates;
  ++counts_.evaluations[moves(moving) ? Term::BodyUpdate : Term::FixedBodyUpdate];
}

void ContactSearch::find(const Configuration& configuration, double margin) {
  const auto start = Clock::now();
  margin_ = margin;
  for (Moving& moving : moving_) update(moving, configuration, margin + open_depth_);
  counts_.update_seconds += seconds_since(start);

  const auto query_start = Clock::now();
  PenetrationCost cost;
  num_questions_ = 0;
  num_lists_ = 0;
  for (const Moving& moving : moving_)
    boxes_[static_cast<std::size_t>(moving.body)] = penetrations_->bounds(moving.index);
  for (const ContactId contact : near_.find(model_.contacts, boxes_)) ask(contact, cost);
  model_.pool->run(2 * static_cast<int>(num_questions_), [&](int k, int worker) {
    Question& question = questions_[static_cast<std::size_t>(k / 2)];
    const bool of_b = k % 2 == 1;
    if (!(of_b && question.is_self()))
      collect(question, of_b, scratch_[static_cast<std::size_t>(worker)]);
  });
  for (std::size_t q = 0; q < num_questions_; ++q) answer(questions_[q]);
  counts_.evaluations[Term::BoxTest] += near_.num_tests();
  counts_.narrow_tests += cost.narrow_tests;
  counts_.reported_pairs += cost.pairs;
  counts_.narrow_seconds += cost.narrow_seconds;
  counts_.traversal_seconds += seconds_since(query_start) - cost.narrow_seconds;
}

/// Which triangles lie in which tetrahedra of the other.
void ContactSearch::ask(ContactId contact, PenetrationCost& cost) {
  if (num_questions_ == questions_.size()) questions_.emplace_back();
  Question& question = questions_[num_questions_++];
  question.contact = contact;
  question.pair = model_.contacts[contact];
  Moving &a = moving_of(question.pair.a), &b = moving_of(question.pair.b);
  question.a.body = question.b.other = &a;
  question.b.body = question.a.other = &b;
  fit(a);
  if (question.is_self()) {
    ++counts_.evaluations[Term::SelfQuery];
    penetrations_->within(a.index, question.a.found, cost);
    return;
  }
  fit(b);
  ++counts_.evaluations[Term::PairQuery];
  penetrations_->between(a.index, b.index, question.a.found, question.b.found, cost);
}

/// The list of a contact, if it has candidates. In both directions, though one side alone looks for
/// the other: what lies deep shows in either.
void ContactSearch::answer(const Question& question) {
  const bool reversed = question.pair.reversed;
  const Side &own = reversed ? question.b : question.a, &other = reversed ? question.a : question.b;
  if (num_lists_ == lists_.size()) lists_.emplace_back();
  CandidateList& list = lists_[num_lists_];
  list.contact = question.contact;
  list.pairs = own.near;
  merge(own.deep, list.pairs);
  counts_.deep_pairs += std::ssize(own.deep);
  if (!question.is_self()) {
    merge(swapped(other.deep), list.pairs);
    counts_.deep_pairs += std::ssize(other.deep);
  }
  num_lists_ += list.pairs.empty() ? 0 : 1;
}

bool ContactSearch::may_touch(const Moving& a, int triangle, const Moving& b, int face) const {
  const Collider& A = *model_.bodies[static_cast<std::size_t>(a.body)].collider;
  const Collider& B = *model_.bodies[static_cast<std::size_t>(b.body)].collider;
  return !are_tied(A, triangle, B, face) && !(&a == &b && are_two_sides(A, a.part, triangle, face));
}

/// One side's candidates.
void ContactSearch::collect(Question& question, bool of_b, Scratch& scratch) const {
  Side& side = of_b ? question.b : question.a;
  const Side& reverse = of_b || question.is_self() ? question.a : question.b;
  const Moving &a = *side.body, &b = *side.other;
  const Collider& A = *model_.bodies[static_cast<std::size_t>(a.body)].collider;
  const Collider& B = *model_.bodies[static_cast<std::size_t>(b.body)].collider;
  const DepthRange range = depth_range(A, B, question.pair.averaged);
  const Penetrations& found = side.found;
  side.near.clear();
  side.deep.clear();
  scratch.deep.clear();
  for (std::size_t first = 0, end = 0; first < found.size(); first = end) {
    const int triangle = found[first].face;
    const FaceBounds& s = a.faces[static_cast<std::size_t>(triangle)];
    bool deep = false;
    ++scratch.now;
    for (end = first; end < found.size() && found[end].face == triangle; ++end) {
      const auto tetrahedron = static_cast<std::size_t>(found[end].tetrahedron);
      deep = deep || B.is_inner[tetrahedron] != 0;
      for (int k = B.nearby_begin[tetrahedron]; k < B.nearby_begin[tetrahedron + 1]; ++k) {
        const int f = B.nearby[static_cast<std::size_t>(k)];
        std::int64_t& seen = scratch.seen[static_cast<std::size_t>(f)];
        if (std::exchange(seen, scratch.now) == scratch.now) continue;
        const FaceBounds& face = b.faces[static_cast<std::size_t>(f)];
        if (!may_face(s, face)) continue;
        const FaceProximity what = face_proximity(s, face, range, margin_);
        deep = deep || what.deeper;
        if (what.may && may_touch(a, triangle, b, f))
          side.near.push_back({triangle, f, range.reach});
      }
    }
    if (deep) scratch.deep.push_back({first, end});
  }
  drop_far_faces(reverse.found, B.face_area.size(), side.near);
  add_deep_pairs(range, scratch, side);
}

/// For triangles that lie deeper below the other surface than the range reaches: the faces behind
/// them up to about that depth. Faces farther off are seen from beyond an edge.
void ContactSearch::add_deep_pairs(const DepthRange& range, const Scratch& scratch,
                                   Side& side) const {
  constexpr double kOfDepth = 1.5;  // along a triangle's normal it is farther than straight up
  const Moving &a = *side.body, &b = *side.other;
  const Collider& B = *model_.bodies[static_cast<std::size_t>(b.body)].collider;
  for (const Scratch::DeepTriangle& deep : scratch.deep) {
    const int triangle = side.found[deep.begin].face;
    const FaceBounds& s = a.faces[static_cast<std::size_t>(triangle)];
    const bool inside =
        std::any_of(side.found.begin() + static_cast<std::ptrdiff_t>(deep.begin),
                    side.found.begin() + static_cast<std::ptrdiff_t>(deep.end),
                    [&](const collision::Penetration& p) {
                      return has_corner_in(s, b.x(Eigen::all, B.tets.col(p.tetrahedron)));
                    });
    if (!inside) continue;
    const double depth = depth_below(s, b.faces);
    if (!(kOfDepth * depth > range.reach)) continue;
    const DepthRange deeper{range.open, kOfDepth * depth + margin_};
    for (std::size_t f = 0; f < b.faces.size(); ++f) {
      const auto face = static_cast<int>(f);
      if (!may_face(s, b.faces[f]) || !may_touch(a, triangle, b, face)) continue;
      if (face_proximity(s, b.faces[f], deeper, margin_).may)
        side.deep.push_back({triangle, face, deeper.reach});
    }
  }
}

bool ContactSearch::passes_unseen(const Configuration& from, const Configuration& to) {
  sweeps_.assign(model_.bodies.size(), {});
  for (const Moving& moving : moving_) {
    const auto body = static_cast<std::size_t>(moving.body);
    for (const NodeRef& node : model_.bodies[body].collider->nodes)
      sweeps_[body].add(from.position(node), to.position(node));
    boxes_[body] = box_of_way(sweeps_[body]);
  }
  for (const ContactId contact : near_.find(model_.contacts, boxes_)) {
    const ContactModel pair = model_.contacts[contact];
    if (pair.a == pair.b) continue;
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const Collider &A = *model_.bodies[a].collider, &B = *model_.bodies[b].collider;
    if (most_relative_motion(sweeps_[a], sweeps_[b]) >
        std::max(depth_range(A, B, pair.averaged).reach, depth_range(B, A, pair.averaged).reach))
      return true;
  }
  return false;
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
