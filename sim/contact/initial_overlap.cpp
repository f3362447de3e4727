#include "sim/contact/initial_overlap.hpp"

#include <Eigen/LU>

#include "collision/blocks/block_collide.hpp"
#include "sim/mesh/triangle_tree.hpp"
#include "sim/model/near_contacts.hpp"

namespace articular::sim {
namespace {

/// Less than this part of an element is round-off between surfaces that lie flush.
constexpr double kLeastDepth = 1e-6;

bool is_inside(const Vec3& x, const Collider& body, int tetrahedron) {
  Eigen::Matrix4d corners;
  for (int k = 0; k < 4; ++k) corners.col(k) << body.X.col(body.tets(k, tetrahedron)), 1;
  const Eigen::FullPivLU<Eigen::Matrix4d> lu(corners);
  return lu.isInvertible() && lu.solve(x.homogeneous()).minCoeff() >= 0;
}

/// The nodes of a surface that lie in another body, from the pairs that meet.
void add_nodes_inside(const std::vector<collision::Penetration>& pairs, const Collider& surface,
                      const Collider& body, int rigid_of_body, InitialOverlap& overlap) {
  if (pairs.empty()) return;
  const TriangleTree faces(body.X, body.surface.faces);
  std::vector<char> counted(static_cast<std::size_t>(surface.X.cols()), 0);
  for (const collision::Penetration& pair : pairs)
    for (const int i : surface.surface.faces.col(pair.face)) {
      const auto node = static_cast<std::size_t>(i);
      const bool tied = rigid_of_body >= 0 && surface.nodes[node].rigid == rigid_of_body;
      const Vec3 x = surface.X.col(i);
      if (tied || counted[node] != 0 || !is_inside(x, body, pair.tetrahedron)) continue;
      counted[node] = 1;
      const double depth = faces.distance(x);
      if (depth < kLeastDepth * body.size) continue;
      ++overlap.num_nodes;
      if (depth > overlap.depth) {
        overlap.depth = depth;
        overlap.place = x;
      }
    }
}

}  // namespace

std::vector<InitialOverlap> initial_overlaps(const Model& model) {
  std::vector<InitialOverlap> overlaps;
  collision::BlockQueryScratch scratch;
  collision::BlockQueryCounts counts;
  std::vector<collision::Penetration> pairs;
  for (const ContactId id : contacts_near_at_start(model, kLeastDepth)) {
    const ContactModel contact = model.contacts[id];
    if (contact.a == contact.b) continue;
    const BodyModel& a = model.bodies[static_cast<std::size_t>(contact.a)];
    const BodyModel& b = model.bodies[static_cast<std::size_t>(contact.b)];
    collision::BlockTree tree_a(a.collider->tets, a.collider->surface, a.collider->X);
    collision::BlockTree tree_b(b.collider->tets, b.collider->surface, b.collider->X);
    tree_a.update(a.collider->X);
    tree_b.update(b.collider->X);
    InitialOverlap overlap;
    overlap.contact = id;
    overlap.a = contact.a;
    overlap.b = contact.b;
    collision::faces_in_body(tree_a, tree_b, pairs, counts, scratch);
    add_nodes_inside(pairs, *a.collider, *b.collider, b.rigid, overlap);
    collision::faces_in_body(tree_b, tree_a, pairs, counts, scratch);
    add_nodes_inside(pairs, *b.collider, *a.collider, a.rigid, overlap);
    if (overlap.num_nodes > 0) overlaps.push_back(overlap);
  }
  return overlaps;
}

}  // namespace articular::sim
