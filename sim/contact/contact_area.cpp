#include "sim/contact/contact_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

using std::numbers::pi;

/// [m], of nodes of the triangles' side; ∞ where nothing is opposite. Of the faces that a node's
/// triangles meet the one that the node lies opposite to, or else lies least beside.
Eigen::VectorXd gaps(const ContactPairState& pair_state, const Eigen::Matrix3Xi& groups) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Eigen::Index num_groups = pair_state.pressure.size();
  Eigen::VectorXd gap = Eigen::VectorXd::Constant(num_groups, kInfinity),
                  inside = Eigen::VectorXd::Constant(num_groups, -kInfinity);
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    for (int i = 0; i < 3; ++i) {
      const int group = groups(i, entry.triangle);
      const double there = entry.patch.beta.col(i).minCoeff();
      if (!(there > inside[group])) continue;
      inside[group] = there;
      gap[group] = std::max(0.0, -entry.patch.height[i]);
    }
  }
  return gap;
}

/// How far a pressure moves both surfaces: where it acts on the area T by √(πT) `punch` + `layer`.
struct Compliance {
  double punch = 0;  // Σ 1/(2E/(1 − ν²)) [1/Pa]
  double layer = 0;  // [m/Pa]
};

/// Rigid bodies give way by their layers; where neither has one, by the little that bone does.
Compliance compliance_of(const Model& model, const ContactSides& sides, double layers) {
  Compliance sum{0, layers};
  double of_bones = 0;
  for (const int b : {sides.triangle_body, sides.face_body}) {
    const BodyModel& body = model.bodies[static_cast<std::size_t>(b)];
    if (body.tissue >= 0)
      sum.punch += 1 / punch_modulus(model.tissues[static_cast<std::size_t>(body.tissue)]);
    else
      of_bones += body.collider->mean_compliance;
  }
  if (sum.punch == 0 && layers == 0) sum.layer = of_bones;
  return sum;
}

/// A cut adds half as many corners at most, by round-off; without it one.
constexpr int kMostCorners = static_cast<int>(2 * TrianglePolygon::kMaxCorners / 3);

void cut(const Vec3& level, TrianglePolygon& polygon) {
  TrianglePolygon room;
  if (polygon.count < 3 || polygon.count > kMostCorners) return;
  if (const TrianglePolygon& part = clipped(level, 0, polygon, room); &part == &room)
    polygon = room;
}

/// Of the triangle's area.
double area_of(const TrianglePolygon& polygon) {
  Mat3 Q;
  return polygon.count >= 3 ? integrate(polygon, Q) : 0;
}

}  // namespace

Eigen::VectorXd signed_pressures(const Model& model, const ContactPairState& pair_state) {
  const ContactSides sides = sides_of(model, pair_state);
  const Compliance compliance = compliance_of(model, sides, pair_state.pair.layers);
  Eigen::VectorXd phi = pair_state.pressure;
  const Eigen::VectorXd gap = gaps(pair_state, sides.triangles.groups);
  for (Eigen::Index a = 0; a < phi.size(); ++a)
    if (!(phi[a] > 0))
      phi[a] =
          -pair_state.pair.share * gap[a] /
          (compliance.punch * std::sqrt(pi * sides.triangles.group_area[a]) + compliance.layer);
  return phi;
}

bool is_selected(const ContactSides& sides, const ContactPairState::Patch& entry, int body,
                 const std::vector<char>& selected) {
  const int face = sides.triangle_body == body ? entry.triangle : entry.face;
  return selected.empty() || selected[static_cast<std::size_t>(face)] != 0;
}

TrianglePolygon covered_polygon(const ContactPatch& patch) {
  TrianglePolygon polygon = whole_triangle();
  for (int k = 0; k < patch.num_edges; ++k)
    cut(patch.edge[static_cast<std::size_t>(k)].level, polygon);
  return polygon;
}

double area_that_carries(const ContactPatch& patch, const Vec3& phi) {
  if (!(phi.maxCoeff() > 0)) return 0;
  if (phi.minCoeff() >= 0) return patch.area;
  TrianglePolygon polygon = covered_polygon(patch);
  const double all = area_of(polygon);
  if (!(all > 0)) return 0;
  cut(phi, polygon);
  return patch.area * area_of(polygon) / all;
}

}  // namespace articular::sim
