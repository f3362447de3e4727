#include "sim/build/coincident_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/mesh/triangle_tree.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/near_contacts.hpp"
#include "sim/model/tied_bodies.hpp"

namespace articular::sim {
namespace {

/// Of the height of an element at the coarser surface: surfaces nearer than this all over are one.
/// Facets of a round body stray less from those of its finer mesh, and no two bodies lie so that
/// are not the same.
constexpr double kSame = 0.1;
/// Of that height: a node nearer than this to a surface is on neither side of it.
constexpr double kOnSurface = 1e-3;
/// Of areas: vectors that cancel by less than this show an open surface.
constexpr double kOpen = 1e-3;

double height(const Collider& a, const Collider& b) { return std::min(a.size, b.size); }

/// Nodes of a surface and the middles of its faces, each with every corner's part of it.
Positions surface_points(const Collider& body) {
  const Eigen::Matrix3Xi& faces = body.surface.faces;
  Positions points(3, 4 * faces.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    const Mat3 corners = body.X(Eigen::all, faces.col(f));
    points.middleCols<3>(4 * f) = corners;
    points.col(4 * f + 3) = corners.rowwise().mean();
  }
  return points;
}

Eigen::AlignedBox3d box_of(const Positions& x) {
  return {x.rowwise().minCoeff(), x.rowwise().maxCoeff()};
}

Vec3 area_vector(const Collider& body) {
  Vec3 sum = Vec3::Zero();
  for (const auto& face : body.surface.faces.colwise()) {
    const Vec3 a = body.X.col(face[0]);
    sum += 0.5 * (Vec3(body.X.col(face[1])) - a).cross(Vec3(body.X.col(face[2])) - a);
  }
  return sum;
}

/// Two sheets that lie face to face are not the same one.
bool face_each_other(const Collider& a, const Collider& b) {
  const double area = std::accumulate(a.face_area.begin(), a.face_area.end(), 0.0);
  return area_vector(a).dot(area_vector(b)) < -kOpen * area * area;
}

bool lies_on(const Positions& points, const Collider& body, double distance) {
  const TriangleTree tree(body.X, body.surface.faces);
  return std::all_of(points.colwise().begin(), points.colwise().end(),
                     [&](const auto& x) { return tree.is_within(x, distance); });
}

bool coincide(const Collider& a, const Collider& b) {
  const double distance = kSame * std::max(a.size, b.size);
  const Positions of_a = surface_points(a), of_b = surface_points(b);
  const Eigen::AlignedBox3d p = box_of(of_a), q = box_of(of_b);
  return (p.min() - q.min()).lpNorm<Eigen::Infinity>() <= distance &&
         (p.max() - q.max()).lpNorm<Eigen::Infinity>() <= distance && !face_each_other(a, b) &&
         lies_on(of_a, b, distance) && lies_on(of_b, a, distance);
}

/// All of a's surface lies inside b's, a node at least clearly so.
bool lies_within(const Collider& a, const Collider& b) {
  const double flush = kOnSurface * height(a, b);
  const Positions of_a = surface_points(a);
  Eigen::AlignedBox3d around = box_of(surface_points(b));
  around = Eigen::AlignedBox3d(around.min().array() - flush, around.max().array() + flush);
  if (!around.contains(box_of(of_a))) return false;
  const TriangleTree tree(b.X, b.surface.faces);
  bool any = false;
  for (const Vec3 x : of_a.colwise()) {
    if (tree.is_within(x, flush)) continue;
    if (winding_number(b.X, b.surface.faces, x) < 0.5) return false;
    any = true;
  }
  return any;
}

}  // namespace

void refuse_coincident_bodies(const Scenario& scenario, const Model& model) {
  for (const ContactId id : contacts_near_at_start(model, kSame)) {
    const ContactModel contact = model.contacts[id];
    if (contact.a == contact.b || are_tied(model, contact.a, contact.b)) continue;
    const BodyModel &a = model.bodies[static_cast<std::size_t>(contact.a)],
                    &b = model.bodies[static_cast<std::size_t>(contact.b)];
    if (!coincide(*a.collider, *b.collider)) continue;
    throw InputError(scenario.bodies[static_cast<std::size_t>(contact.b)].where,
                     fmt::format("bodies `{}` and `{}` are the same body at the same place; "
                                 "expected one of them, or another place",
                                 a.name, b.name));
  }
}

void refuse_bodies_within_others(const Scenario& scenario, const Model& model) {
  for (const ContactId id : contacts_near_at_start(model, kSame)) {
    const ContactModel contact = model.contacts[id];
    if (contact.a == contact.b || are_tied(model, contact.a, contact.b)) continue;
    for (const auto& [inner, outer] :
         {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)}) {
      const BodyModel &in = model.bodies[static_cast<std::size_t>(inner)],
                      &out = model.bodies[static_cast<std::size_t>(outer)];
      if (!lies_within(*in.collider, *out.collider)) continue;
      throw InputError(
          scenario.bodies[static_cast<std::size_t>(inner)].where,
          fmt::format("body `{}` lies wholly inside `{}`, and contact can't tell the way out; "
                      "expected another place, an [[attach]] of one to the other, or [[contact]] "
                      "pairs without these two",
                      in.name, out.name));
    }
  }
}

}  // namespace articular::sim
