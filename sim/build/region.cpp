#include "sim/build/region.hpp"

namespace articular::sim {
namespace {

TriangleTree surface_of(const BodyGeometry& geometry) {
  const MeshData& mesh = geometry.contact.X.cols() > 0 ? geometry.contact : geometry.mesh;
  if (mesh.tets.cols() == 0) return {mesh.X, mesh.triangles};
  return {mesh.X, collision::build_surface(mesh.tets, static_cast<int>(mesh.X.cols())).faces};
}

}  // namespace

RegionTest::RegionTest(const Region& region, const Model& model,
                       const std::vector<BodyGeometry>& geometry)
    : region_(region) {
  if (!region.near_body) return;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].name == region.near_body->first) near_ = surface_of(geometry[b]);
}

bool RegionTest::contains(const Vec3& x, bool on_surface) const {
  if (region_.surface_only && !on_surface) return false;
  if (region_.box &&
      ((x - region_.box->first).minCoeff() < 0 || (region_.box->second - x).minCoeff() < 0))
    return false;
  if (region_.sphere && (x - region_.sphere->first).norm() > region_.sphere->second) return false;
  return !region_.near_body || near_.is_within(x, region_.near_body->second);
}

}  // namespace articular::sim
