#include "sim/build/region.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_sets.hpp"

namespace articular::sim {
namespace {

TriangleTree surface_of(const BodyGeometry& geometry) {
  const MeshData& mesh = geometry.contact.X.cols() > 0 ? geometry.contact : geometry.mesh;
  if (mesh.tets.cols() == 0) return {mesh.X, mesh.triangles};
  return {mesh.X, collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols())).faces};
}

std::array<int, 3> in_order(std::array<int, 3> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

RegionTest::RegionTest(const Region& region, int body, const Model& model,
                       const std::vector<BodyGeometry>& geometry)
    : region_(region) {
  if (region.near_body)
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (model.bodies[b].name == region.near_body->first) near_ = surface_of(geometry[b]);
  if (!region.set) return;
  const MeshData& mesh = geometry[static_cast<std::size_t>(body)].mesh;
  const MeshSet* const set = find_set(mesh, *region.set);
  if (set == nullptr)
    throw InputError(region.where, fmt::format("the mesh of `{}` has no set {}{}",
                                               model.bodies[static_cast<std::size_t>(body)].name,
                                               in_ticks(*region.set), known_sets(mesh)));
  in_set_.resize(static_cast<std::size_t>(mesh.X.cols()));
  for (const int node : set->nodes) in_set_[static_cast<std::size_t>(node)] = 1;
  for (const auto& face : set->faces) faces_of_set_.insert(in_order(face));
}

bool RegionTest::contains_node(int node, const Vec3& x, bool on_surface) const {
  return (!region_.set || in_set_[static_cast<std::size_t>(node)] != 0) && contains(x, on_surface);
}

bool RegionTest::contains_face(const Eigen::Vector3i& nodes, const Vec3& middle) const {
  if (region_.set) {
    const bool is_in =
        faces_of_set_.empty()
            ? std::all_of(nodes.begin(), nodes.end(),
                          [&](int a) { return in_set_[static_cast<std::size_t>(a)] != 0; })
            : faces_of_set_.contains(in_order({nodes[0], nodes[1], nodes[2]}));
    if (!is_in) return false;
  }
  return contains(middle, true);
}

bool RegionTest::contains_element(const Eigen::Vector4i& nodes, const Vec3& middle) const {
  const auto is_in_set = [&](int a) { return in_set_[static_cast<std::size_t>(a)] != 0; };
  return (!region_.set || std::all_of(nodes.begin(), nodes.end(), is_in_set)) &&
         contains(middle, false);
}

bool RegionTest::contains(const Vec3& x, bool on_surface) const {
  if (region_.surface_only && !on_surface) return false;
  if (region_.box && !lies_in(*region_.box, x)) return false;
  if (region_.sphere && (x - region_.sphere->first).norm() > region_.sphere->second) return false;
  return !region_.near_body || near_.is_within(x, region_.near_body->second);
}

std::vector<int> faces_in(const Region& region, int body, const Model& model,
                          const std::vector<BodyGeometry>& geometry, const Tissue& tissue,
                          const Triangles& faces) {
  const RegionTest test(region, body, model, geometry);
  std::vector<int> columns;
  for (int i = 0; i < faces.cols(); ++i) {
    const Eigen::Vector3i nodes = faces.col(i);
    const Mat3 corners = tissue.X(Eigen::all, nodes);
    if (test.contains_face(nodes, corners.rowwise().mean())) columns.push_back(i);
  }
  return columns;
}

}  // namespace articular::sim
