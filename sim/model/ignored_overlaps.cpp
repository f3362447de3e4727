#include "sim/model/ignored_overlaps.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "collision/mesh/surface.hpp"
#include "sim/mesh/deepest_inside.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Of an element of tissue; of the diagonal of a rigid body's box.
constexpr double kDeepInTissue = 0.5, kDeepInRigid = 0.02;

/// Bodies as they are now: surfaces are made for those that may lie in others alone.
class Bodies {
 public:
  Bodies(const Model& model, const Configuration& now) : model_(model) {
    for (const BodyModel& body : model.bodies) {
      Positions& x = x_.emplace_back(body.X);
      if (body.tissue >= 0) {
        positions_of(now, tissue(body).nodes, x);
      } else if (body.rigid >= 0) {
        const Pose& pose = now.poses[static_cast<std::size_t>(body.rigid)];
        x = (pose.R * body.X).colwise() + pose.p;
      }
      Eigen::AlignedBox3d& box = boxes_.emplace_back();
      if (x.cols() > 0) box = {x.rowwise().minCoeff(), x.rowwise().maxCoeff()};
    }
  }

  const Eigen::AlignedBox3d& box(int body) const { return boxes_[index(body)]; }

  /// Deeper is no matter of rounded corners and meshes that don't match [m].
  double least_depth(int a, int b) const { return std::min(least_depth(a), least_depth(b)); }

  /// Of one body in another; depth 0 where no node lies there deeper than `least`, or in an open
  /// surface.
  IgnoredOverlap deepest(int inner, int outer, double least) {
    const Solid &body = solid(inner), &around = solid(outer);
    const auto found = is_closed_[outer] ? deepest_inside(body.X, around, least) : std::nullopt;
    if (!found) return {};
    const bool is_whole = std::all_of(body.X.colwise().begin(), body.X.colwise().end(),
                                      [&](const auto& x) { return around.contains(x); });
    return {inner, outer, found->x, found->depth, is_whole};
  }

 private:
  static std::size_t index(int body) { return static_cast<std::size_t>(body); }
  const Tissue& tissue(const BodyModel& body) const { return model_.tissues[index(body.tissue)]; }

  double least_depth(int b) const {
    const BodyModel& body = model_.bodies[index(b)];
    if (body.tissue >= 0) return kDeepInTissue * element_size(tissue(body));
    return kDeepInRigid * boxes_[index(b)].diagonal().norm();
  }

  /// Of nodes that are on the surface alone.
  const Solid& solid(int b) {
    const auto found = solids_.find(b);
    if (found != solids_.end()) return found->second;
    const BodyModel& body = model_.bodies[index(b)];
    const Positions& x = x_[index(b)];
    Triangles faces = body.triangles;
    if (body.tissue >= 0)
      faces =
          collision::build_surface(tissue(body).elements.tets(), static_cast<int>(x.cols())).faces;
    std::map<int, int> of_node;
    for (int& node : faces.reshaped())
      node = of_node.emplace(node, static_cast<int>(of_node.size())).first->second;
    Positions on_surface(3, static_cast<Eigen::Index>(of_node.size()));
    for (const auto& [node, number] : of_node) on_surface.col(number) = x.col(node);
    is_closed_[b] = is_closed(faces);
    return solids_.emplace(b, Solid(std::move(on_surface), std::move(faces))).first->second;
  }

  const Model& model_;
  std::vector<Positions> x_;  // by body
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::map<int, Solid> solids_;
  std::map<int, bool> is_closed_;
};

/// Whether one of them can give way.
bool is_free(const Model& model, const BodyModel& body) {
  return body.tissue >= 0 || (body.rigid >= 0 && body.rigid < model.layout.num_rigid);
}

bool is_tied_to(const Model& model, const BodyModel& body, const BodyModel& other) {
  if (body.tissue < 0 || other.rigid < 0) return false;
  const std::vector<NodeRef>& nodes = model.tissues[static_cast<std::size_t>(body.tissue)].nodes;
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](const NodeRef& node) { return node.rigid == other.rigid; });
}

}  // namespace

bool are_of_same_bodies(const IgnoredOverlap& a, const IgnoredOverlap& b) {
  return std::minmax(a.inner, a.outer) == std::minmax(b.inner, b.outer);
}

std::vector<IgnoredOverlap> ignored_overlaps(const Scenario& scenario, const Model& model,
                                             const Configuration& now) {
  std::vector<IgnoredOverlap> overlaps;
  if (!scenario.contact) return overlaps;
  Bodies bodies(model, now);
  const int count = static_cast<int>(model.bodies.size());
  const auto may_be_ignored = [&](int a, int b) {
    const BodyModel &p = model.bodies[static_cast<std::size_t>(a)],
                    &q = model.bodies[static_cast<std::size_t>(b)];
    return (is_free(model, p) || is_free(model, q)) && !is_tied_to(model, p, q) &&
           !is_tied_to(model, q, p) && !model.contacts.between(a, b);
  };
  const auto is_solid = [&](int body) {
    const auto b = static_cast<std::size_t>(body);
    return scenario.bodies[b].collides && model.bodies[b].touches_as_drawn;
  };
  for (int a = 0; a < count; ++a) {
    if (!is_solid(a)) continue;
    for (int b = a + 1; b < count; ++b) {
      if (!is_solid(b) || !bodies.box(a).intersects(bodies.box(b)) || !may_be_ignored(a, b))
        continue;
      const double least = bodies.least_depth(a, b);
      const IgnoredOverlap of_a = bodies.deepest(a, b, least), of_b = bodies.deepest(b, a, least);
      const IgnoredOverlap& worst = of_b.depth > of_a.depth ? of_b : of_a;
      if (worst.depth > 0) overlaps.push_back(worst);
    }
  }
  return overlaps;
}

}  // namespace articular::sim
