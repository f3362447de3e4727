#include "sim/model/ignored_overlaps.hpp"

#include <algorithm>
#include <map>

#include "collision/mesh/box_tree.hpp"
#include "collision/mesh/surface.hpp"
#include "sim/mesh/own_nodes.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/tied_bodies.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Of an element of tissue; of the diagonal of a rigid body's box. What is less deep is a matter of
/// rounded corners, and of meshes that don't match.
constexpr double kDeepInTissue = 0.5, kDeepInRigid = 0.02;

const BodyModel& body_of(const Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)];
}

const Tissue& tissue_of(const Model& model, const BodyModel& body) {
  return model.tissues[static_cast<std::size_t>(body.tissue)];
}

/// Whether it can give way.
bool is_free(const Model& model, const BodyModel& body) {
  return body.tissue >= 0 || (body.rigid >= 0 && body.rigid < model.layout.num_rigid);
}

/// Whichever of the two lies in the other.
bool are_of_same_bodies(const IgnoredOverlap& a, const IgnoredOverlap& b) {
  return std::minmax(a.inner, a.outer) == std::minmax(b.inner, b.outer);
}

}  // namespace

IgnoredOverlaps::IgnoredOverlaps(const Scenario& scenario, const Model& model)
    : model_(model), surfaces_(model.bodies.size()) {
  if (!scenario.contact || scenario.contacts.empty()) return;  // nothing, or all may touch
  for (std::size_t b = 0; b < surfaces_.size(); ++b)
    if (scenario.bodies[b].collides && model.bodies[b].touches_as_drawn)
      add_surface(static_cast<int>(b));
}

bool IgnoredOverlaps::is_ignored(int a, int b) const {
  const BodyModel &p = body_of(model_, a), &q = body_of(model_, b);
  return (is_free(model_, p) || is_free(model_, q)) && !model_.contacts.between(a, b) &&
         !are_tied(model_, a, b);
}

void IgnoredOverlaps::add_surface(int b) {
  const BodyModel& body = body_of(model_, b);
  Surface& surface = surfaces_[static_cast<std::size_t>(b)];
  surface.triangles = body.triangles;
  if (body.tissue >= 0) {
    const Tissue& tissue = tissue_of(model_, body);
    const auto num_nodes = static_cast<int>(tissue.nodes.size());
    surface.triangles = collision::build_surface(tissue.elements.tets(), num_nodes).faces;
    for (const int node : keep_own_nodes(surface.triangles))
      surface.nodes.push_back(tissue.nodes[static_cast<std::size_t>(node)]);
    surface.deep = kDeepInTissue * element_size(tissue);
  } else {
    const Positions X = body.X(Eigen::all, keep_own_nodes(surface.triangles));
    for (const Vec3 local : X.colwise()) surface.nodes.push_back({0, body.rigid, local});
    surface.solid.emplace(X, surface.triangles);
    surface.deep = kDeepInRigid * surface.solid->box.diagonal().norm();
  }
  surface.is_closed = is_closed(surface.triangles);
}

/// At one moment.
class IgnoredOverlaps::Look {
 public:
  Look(const IgnoredOverlaps& all, const Configuration& now)
      : all_(all), now_(now), x_(all.surfaces_.size()), boxes_(x_.size()) {
    for (std::size_t b = 0; b < x_.size(); ++b) {
      positions_of(now, all.surfaces_[b].nodes, x_[b]);
      for (const Vec3 x : x_[b].colwise()) boxes_[b].include(x);
    }
  }

  const std::vector<collision::Aabb>& boxes() const { return boxes_; }

  /// The deeper one of either in the other; depth 0 where none is.
  IgnoredOverlap between(int a, int b) {
    const double least = least_depth(a, b);
    const IgnoredOverlap of_a = deepest(a, b, least), of_b = deepest(b, a, least);
    return of_b.depth > of_a.depth ? of_b : of_a;
  }

 private:
  static std::size_t index(int body) { return static_cast<std::size_t>(body); }
  const Surface& surface(int body) const { return all_.surfaces_[index(body)]; }

  double least_depth(int a, int b) const {
    const bool of_a = !surface(a).solid, of_b = !surface(b).solid;  // of tissue, which is finer
    if (of_a != of_b) return surface(of_a ? a : b).deep;
    return std::min(surface(a).deep, surface(b).deep);
  }

  IgnoredOverlap deepest(int inner, int outer, double least) {
    if (!surface(outer).is_closed) return {};
    const Solid& around = solid(outer);
    const Pose frame = frame_of(outer);
    const Positions x = frame.R.transpose() * (x_[index(inner)].colwise() - frame.p);
    const auto found = deepest_inside(x, around, least);
    if (!found) return {};
    const bool is_whole = std::all_of(x.colwise().begin(), x.colwise().end(),
                                      [&](const auto& point) { return around.contains(point); });
    return {inner, outer, frame.R * found->x + frame.p, found->depth, is_whole, now_.t};
  }

  /// That of a rigid body; of tissue the world's.
  Pose frame_of(int body) const {
    if (!surface(body).solid) return {};
    return now_.poses[index(body_of(all_.model_, body).rigid)];
  }
  const Solid& solid(int body) {
    if (surface(body).solid) return *surface(body).solid;
    const auto found = of_tissue_.find(body);
    if (found != of_tissue_.end()) return found->second;
    return of_tissue_.emplace(body, Solid(x_[index(body)], surface(body).triangles)).first->second;
  }

  const IgnoredOverlaps& all_;
  const Configuration& now_;
  std::vector<Positions> x_;  // by body
  std::vector<collision::Aabb> boxes_;
  std::map<int, Solid> of_tissue_;
};

std::vector<IgnoredOverlap> IgnoredOverlaps::find(const Configuration& now) const {
  std::vector<IgnoredOverlap> overlaps;
  Look look(*this, now);
  collision::BoxTree near;
  for (const auto& [a, b] : near.overlapping_bodies(look.boxes())) {
    if (!is_ignored(a, b)) continue;
    const IgnoredOverlap overlap = look.between(a, b);
    if (overlap.depth > 0) overlaps.push_back(overlap);
  }
  return overlaps;
}

std::vector<IgnoredOverlap> IgnoredOverlaps::at_start() const {
  Configuration start;
  const Eigen::VectorXd y = initial_state(model_);
  read_state(model_, y.data(), 0, start);
  return find(start);
}

OverlapWatch::OverlapWatch(const Scenario& scenario, const Model& model)
    : overlaps_(scenario, model), at_start_(overlaps_.at_start()) {}

void OverlapWatch::look(const Configuration& now) {
  for (const IgnoredOverlap& found : overlaps_.find(now)) {
    const auto is_known = [&](const IgnoredOverlap& other) {
      return are_of_same_bodies(found, other);
    };
    if (std::ranges::none_of(at_start_, is_known) && std::ranges::none_of(since_start_, is_known))
      since_start_.push_back(found);
  }
}

}  // namespace articular::sim
