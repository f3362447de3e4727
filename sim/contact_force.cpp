#include "sim/contact_force.hpp"

#include <algorithm>
#include <array>

namespace articular::sim {
namespace {

/// The six nodes of a candidate: the triangle's, then the face's.
using SixNodes = std::array<const NodeRef*, 6>;

struct Sides {
  const Collider& triangles;
  const Collider& faces;
  const ContactModel& contact;
};

Sides sides(const Model& model, const CandidateList& list) {
  const ContactModel& contact = model.contacts[static_cast<std::size_t>(list.contact)];
  const Collider& a = *model.bodies[static_cast<std::size_t>(contact.a)].collider;
  const Collider& b = *model.bodies[static_cast<std::size_t>(contact.b)].collider;
  return list.reversed ? Sides{b, a, contact} : Sides{a, b, contact};
}

/// Calls visit(nodes, patch, stiffness, triangle, face) for every candidate of a list in contact.
template <class Visit>
void for_each_patch(const Model& model, const Configuration& configuration,
                    const CandidateList& list, Visit&& visit) {
  const auto [triangles, faces, contact] = sides(model, list);
  // Each direction finds every contact of a pair once; of a body with itself the one list finds it
  // twice, once from either side.
  const double k = 0.5 * contact.stiffness;
  ContactPatch patch;
  int last_triangle = -1;
  Mat3 s = Mat3::Zero(), f = Mat3::Zero();
  SixNodes nodes{};
  for (const ContactCandidate& candidate : list.pairs) {
    if (candidate.triangle != last_triangle) {  // candidates come sorted by triangle
      last_triangle = candidate.triangle;
      for (int i = 0; i < 3; ++i) {
        const auto node = static_cast<std::size_t>(triangles.surface.faces(i, candidate.triangle));
        nodes[static_cast<std::size_t>(i)] = &triangles.nodes[node];
        s.col(i) = configuration.position(triangles.nodes[node]);
      }
    }
    for (int m = 0; m < 3; ++m) {
      const auto node = static_cast<std::size_t>(faces.surface.faces(m, candidate.face));
      nodes[static_cast<std::size_t>(3 + m)] = &faces.nodes[node];
      f.col(m) = configuration.position(faces.nodes[node]);
    }
    const double rest_area = triangles.face_area[static_cast<std::size_t>(candidate.triangle)];
    if (contact_patch(s, f, rest_area, faces.reach, patch)) visit(nodes, patch, k, candidate);
  }
}

}  // namespace

void add_contact_force(const Model& model, const Configuration& configuration,
                       const std::vector<CandidateList>& candidates, Eigen::VectorXd& f,
                       std::vector<ContactSummary>& summaries) {
  summaries.assign(model.contacts.size(), {});
  for (const CandidateList& list : candidates) {
    ContactSummary& summary = summaries[static_cast<std::size_t>(list.contact)];
    const ContactModel& contact = model.contacts[static_cast<std::size_t>(list.contact)];
    for_each_patch(
        model, configuration, list,
        [&](const SixNodes& nodes, const ContactPatch& patch, double k, const ContactCandidate&) {
          const Vec18 g = contact_gradient(patch, k);
          for (std::size_t i = 0; i < 6; ++i)
            add_force(configuration, *nodes[i], -g.segment<3>(3 * static_cast<Eigen::Index>(i)), f);
          const Vec3 on_triangles = -(g.segment<3>(0) + g.segment<3>(3) + g.segment<3>(6));
          // Of a body with itself both sides are its own: no net force.
          if (contact.a != contact.b)
            summary.force += list.reversed ? Vec3(-on_triangles) : on_triangles;
          summary.area += 0.5 * patch.area;
          summary.max_depth = std::max(summary.max_depth, patch.depth_max);
          summary.max_pressure = std::max(summary.max_pressure, 2 * k * patch.depth_max);
          summary.energy += contact_energy(patch, k);
        });
  }
}

void add_contact_stiffness(const Model& model, const Configuration& configuration,
                           const std::vector<CandidateList>& candidates, fem::Tangent tangent,
                           double scale, fem::BlockMatrix& A) {
  const auto hessian = tangent == fem::Tangent::Consistent ? contact_tangent : contact_hessian;
  for (const CandidateList& list : candidates)
    for_each_patch(
        model, configuration, list,
        [&](const SixNodes& nodes, const ContactPatch& patch, double k, const ContactCandidate&) {
          add_stiffness(model, configuration, nodes, hessian(patch, scale * k), A);
        });
}

std::vector<Positions> nodal_contact_forces(const Model& model, const Configuration& configuration,
                                            const std::vector<CandidateList>& candidates) {
  std::vector<Positions> forces(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].collider)
      forces[b] = Positions::Zero(3, model.bodies[b].collider->X.cols());
  for (const CandidateList& list : candidates) {
    const ContactModel& contact = model.contacts[static_cast<std::size_t>(list.contact)];
    const auto [triangles, faces, unused] = sides(model, list);
    Positions& on_triangles =
        forces[static_cast<std::size_t>(list.reversed ? contact.b : contact.a)];
    Positions& on_faces = forces[static_cast<std::size_t>(list.reversed ? contact.a : contact.b)];
    const auto& triangle_nodes = triangles.surface.faces;
    const auto& face_nodes = faces.surface.faces;
    for_each_patch(model, configuration, list,
                   [&](const SixNodes&, const ContactPatch& patch, double k,
                       const ContactCandidate& candidate) {
                     const Vec18 g = contact_gradient(patch, k);
                     for (int i = 0; i < 3; ++i) {
                       on_triangles.col(triangle_nodes(i, candidate.triangle)) -=
                           g.segment<3>(3 * i);
                       on_faces.col(face_nodes(i, candidate.face)) -= g.segment<3>(9 + 3 * i);
                     }
                   });
  }
  return forces;
}

void append_missing_stencils(const Model& model, const std::vector<CandidateList>& candidates,
                             const fem::BlockMatrix& A, Stencils& stencils) {
  std::vector<int> blocks;
  for (const CandidateList& list : candidates) {
    const Sides side = sides(model, list);
    const Collider &triangles = side.triangles, &faces = side.faces;
    for (const ContactCandidate& candidate : list.pairs) {
      blocks.clear();
      for (int i = 0; i < 3; ++i) {
        append_blocks(
            model,
            triangles
                .nodes[static_cast<std::size_t>(triangles.surface.faces(i, candidate.triangle))],
            blocks);
        append_blocks(model,
                      faces.nodes[static_cast<std::size_t>(faces.surface.faces(i, candidate.face))],
                      blocks);
      }
      const bool missing = std::any_of(blocks.begin(), blocks.end(), [&](int i) {
        return std::any_of(blocks.begin(), blocks.end(), [&](int j) { return A.slot(i, j) < 0; });
      });
      if (!missing) continue;
      stencils.blocks.insert(stencils.blocks.end(), blocks.begin(), blocks.end());
      stencils.close();
    }
  }
}

}  // namespace articular::sim
