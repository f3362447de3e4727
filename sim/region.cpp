#include "sim/region.hpp"

#include "sim/triangle_distance.hpp"

namespace articular::sim {
namespace {

bool is_near(const MeshData& mesh, const Vec3& x, double distance) {
  for (Eigen::Index f = 0; f < mesh.triangles.cols(); ++f) {
    const Vec3 a = mesh.X.col(mesh.triangles(0, f)), b = mesh.X.col(mesh.triangles(1, f)),
               c = mesh.X.col(mesh.triangles(2, f));
    if (squared_distance(x, a, b, c) <= distance * distance) return true;
  }
  return false;
}

}  // namespace

RegionTest::RegionTest(const Region& region, const Model& model,
                       const std::vector<BodyGeometry>& geometry)
    : region_(region) {
  if (!region.near_body) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].name != region.near_body->first) continue;
    const BodyGeometry& near = geometry[b];
    near_ = near.contact.X.cols() > 0 ? near.contact : near.mesh;
    if (near_.tets.cols() > 0)
      near_.triangles =
          collision::build_surface(near_.tets, static_cast<int>(near_.X.cols())).faces;
  }
}

bool RegionTest::contains(const Vec3& x, bool on_surface) const {
  if (region_.surface_only && !on_surface) return false;
  if (region_.box &&
      ((x - region_.box->first).minCoeff() < 0 || (region_.box->second - x).minCoeff() < 0))
    return false;
  if (region_.sphere && (x - region_.sphere->first).norm() > region_.sphere->second) return false;
  return !region_.near_body || is_near(near_, x, region_.near_body->second);
}

}  // namespace articular::sim
