#include "sim/contact/pressed_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "sim/contact/contact_area.hpp"
#include "sim/contact/contact_pressure.hpp"

namespace articular::sim {
namespace {

/// The patch's part of the surface as a fan of triangles, with pressures that make the force q.
void add_patch(const ContactPatch& patch, const Mat3& corners, const Vec3& p, double q,
               std::vector<PressedTriangle>& triangles) {
  const TrianglePolygon polygon = covered_polygon(patch);
  const auto at = [&](int k) -> const Vec3& { return polygon.corner[static_cast<std::size_t>(k)]; };
  const auto pressure = [&](const Vec3& N) {
    return std::max(0.0, p.dot(N) * (patch.fade > 0 ? patch.depth.dot(N) / patch.fade : 1));
  };
  const std::size_t begin = triangles.size();
  double sum = 0;
  for (int k = 1; k + 1 < polygon.count; ++k) {
    PressedTriangle triangle;
    const std::array<const Vec3*, 3> N = {&at(0), &at(k), &at(k + 1)};
    for (int i = 0; i < 3; ++i) {
      const Vec3& corner = *N[static_cast<std::size_t>(i)];
      triangle.x.col(i) = corners * corner;
      triangle.p[i] = pressure(corner);
    }
    const auto& x = triangle.x;
    sum += 0.5 * (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() * triangle.p.mean();
    triangles.push_back(triangle);
  }
  for (std::size_t k = begin; k < triangles.size(); ++k) triangles[k].p *= sum > 0 ? q / sum : 0;
}

}  // namespace

void add_pressed_triangles(const Model& model, const ContactResponse& response,
                           const Configuration& configuration, ContactId contact, int body,
                           const std::vector<char>& selected,
                           std::vector<PressedTriangle>& triangles) {
  for (const ContactPairState* pair_state : response.pair_states()) {
    if (pair_state->contact != contact) continue;
    const ContactSides side = sides_of(model, *pair_state);
    const auto& groups = side.triangles.groups;
    const bool is_triangle = side.triangle_body == body;
    for (const ContactPairState::Patch& entry : pair_state->patches()) {
      const int face = is_triangle ? entry.triangle : entry.face;
      if (!carries(*pair_state, entry.triangle, groups)) continue;
      if (!selected.empty() && selected[static_cast<std::size_t>(face)] == 0) continue;
      const Vec3 q = pressure_integrals(*pair_state, entry, groups);
      if (!(q.sum() > 0)) continue;
      const Vec3 p = pair_state->point_stiffness > 0
                         ? Vec3(pair_state->point_stiffness * entry.patch.depth)
                         : Vec3(pair_state->pressure(groups.col(entry.triangle)));
      add_patch(entry.patch, corners_of(configuration, side.triangles, entry.triangle), p, q.sum(),
                triangles);
    }
  }
}

}  // namespace articular::sim
