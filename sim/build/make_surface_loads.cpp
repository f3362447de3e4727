#include "sim/build/make_surface_loads.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "sim/build/region.hpp"

namespace articular::sim {

SurfaceLoadModel make_surface_load(const SurfaceLoad& load, int body, const Model& model,
                                   const std::vector<BodyGeometry>& geometry,
                                   const std::vector<collision::Surface>& surfaces) {
  SurfaceLoadModel made{
      load.stress, load.profile, model.bodies[static_cast<std::size_t>(body)].tissue, {}, {}};
  const auto t = static_cast<std::size_t>(made.tissue);
  const Tissue& tissue = model.tissues[t];
  const Triangles& surface = surfaces[t].faces;
  for (const int i : faces_in(load.at.region, body, model, geometry, tissue, surface)) {
    const Eigen::Vector3i face = surface.col(i);
    const Mat3 x = tissue.X(Eigen::all, face);
    std::array<NodeRef, 3> corners;
    for (int a = 0; a < 3; ++a)
      corners[static_cast<std::size_t>(a)] = tissue.nodes[static_cast<std::size_t>(face[a])];
    made.faces.push_back(corners);
    made.area.push_back(0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm());
  }
  if (made.faces.empty())
    throw InputError(load.where, fmt::format("no face of the surface of tissue `{}` has its middle "
                                             "in the loaded region",
                                             load.at.tissue));
  return made;
}

}  // namespace articular::sim
