#include "sim/contact/contact_overview.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/mesh/triangle_tree.hpp"
#include "sim/model/near_contacts.hpp"

namespace articular::sim {
namespace {

/// Of an element: so near something presses soon.
constexpr double kClose = 0.5;
/// A thinner element under a face carries unevenly (sim/README.md, limits).
constexpr double kFlat = 0.2;

const BodyModel& body_of(const Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)];
}

bool stands_still(const Model& model, const NodeRef& node) {
  if (node.rigid < 0) return false;
  const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(node.rigid)];
  return !rigid.unknown && !rigid.motion;
}

bool stands_still(const Model& model, const Collider& body) {
  return std::all_of(body.nodes.begin(), body.nodes.end(),
                     [&](const NodeRef& node) { return stands_still(model, node); });
}

/// By face of a tissue: whether a node of it is tied to the rigid body.
std::vector<char> tied_faces(const Collider& tissue, int rigid) {
  std::vector<char> tied(static_cast<std::size_t>(tissue.surface.faces.cols()), 0);
  if (rigid < 0) return tied;
  for (std::size_t f = 0; f < tied.size(); ++f)
    for (const int i : tissue.surface.faces.col(static_cast<Eigen::Index>(f)))
      if (tissue.nodes[static_cast<std::size_t>(i)].rigid == rigid) tied[f] = 1;
  return tied;
}

/// The nearest node of the faces that are not left out.
void look(const Collider& body, const std::vector<char>& left_out, const TriangleTree& other,
          ContactOverview& overview) {
  std::vector<char> seen(static_cast<std::size_t>(body.X.cols()), 0);
  for (std::size_t f = 0; f < left_out.size(); ++f) {
    if (left_out[f] != 0) continue;
    for (const int i : body.surface.faces.col(static_cast<Eigen::Index>(f))) {
      if (std::exchange(seen[static_cast<std::size_t>(i)], 1) != 0) continue;
      const Vec3 x = body.X.col(i);
      if (!other.is_within(x, overview.distance)) continue;
      overview.distance = other.distance(x);
      overview.place = x;
    }
  }
}

void count_tied(const Collider& tissue, int rigid, const std::vector<char>& tied,
                const TriangleTree& bone, ContactOverview& overview) {
  for (const NodeRef& node : tissue.nodes) overview.num_tied_nodes += node.rigid == rigid ? 1 : 0;
  for (std::size_t f = 0; f < tied.size(); ++f) {
    if (tied[f] != 0) {
      ++overview.num_tied_faces;
      continue;
    }
    ++overview.num_free_faces;
    const auto corners = tissue.surface.faces.col(static_cast<Eigen::Index>(f));
    const bool close = std::all_of(corners.begin(), corners.end(), [&](int i) {
      return bone.is_within(tissue.X.col(i), kClose * tissue.size);
    });
    overview.num_close_faces += close ? 1 : 0;
  }
}

ContactOverview overview_of(const Model& model, ContactId id) {
  const ContactModel contact = model.contacts[id];
  ContactOverview overview;
  overview.contact = id;
  const BodyModel &a = body_of(model, contact.a), &b = body_of(model, contact.b);
  const Collider &A = *a.collider, &B = *b.collider;
  overview.can_move = !(stands_still(model, A) && stands_still(model, B));
  if (contact.a == contact.b) return overview;
  const TriangleTree of_a(A.X, A.surface.faces), of_b(B.X, B.surface.faces);
  const std::vector<char> a_tied = tied_faces(A, a.tissue >= 0 ? b.rigid : -1),
                          b_tied = tied_faces(B, b.tissue >= 0 ? a.rigid : -1);
  // Where one is tied to the other, the other's nodes lie on what is tied.
  const auto any = [](const std::vector<char>& tied) {
    return std::find(tied.begin(), tied.end(), 1) != tied.end();
  };
  if (!any(b_tied)) look(A, a_tied, of_b, overview);
  if (!any(a_tied)) look(B, b_tied, of_a, overview);
  if (any(a_tied)) count_tied(A, b.rigid, a_tied, of_b, overview);
  if (any(b_tied)) count_tied(B, a.rigid, b_tied, of_a, overview);
  return overview;
}

}  // namespace

std::vector<ContactOverview> contact_overviews(const Model& model) {
  std::vector<ContactOverview> overviews;
  for (const ContactId contact : model.contacts.size() <= kMostOverviews
                                     ? model.contacts.all()
                                     : contacts_near_at_start(model, 0.5))
    overviews.push_back(overview_of(model, contact));
  return overviews;
}

std::vector<SurfaceOverview> surface_overviews(const Model& model) {
  std::vector<SurfaceOverview> overviews;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].collider) continue;
    const Collider& collider = *model.bodies[b].collider;
    SurfaceOverview overview;
    overview.body = static_cast<int>(b);
    overview.height = collider.size;
    overview.num_faces = static_cast<int>(collider.surface.faces.cols());
    double least = kFlat;
    for (Eigen::Index f = 0; f < collider.surface.faces.cols(); ++f) {
      const Mat3 x = collider.X(Eigen::all, collider.surface.faces.col(f));
      double longest = 0;
      for (int k = 0; k < 3; ++k) {
        const double edge = (x.col((k + 1) % 3) - x.col(k)).norm();
        overview.edge += edge / (3.0 * overview.num_faces);
        longest = std::max(longest, edge);
      }
      const int tet = collider.surface.face_tet[static_cast<std::size_t>(f)];
      const Vec3 normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
      double height = 0;
      for (const int i : collider.tets.col(tet))
        height = std::max(height, std::abs(normal.dot(Vec3(collider.X.col(i)) - x.col(0))));
      if (!(height < kFlat * longest)) continue;
      ++overview.num_flat;
      if (height < least * longest) {
        least = height / longest;
        overview.flattest = x.rowwise().mean();
      }
    }
    overviews.push_back(overview);
  }
  return overviews;
}

}  // namespace articular::sim
