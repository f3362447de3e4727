#include "sim/contact/contact_stencils.hpp"

#include <algorithm>
#include <vector>

#include "sim/contact/contact_pair_state.hpp"

namespace articular::sim {
namespace {

void sort_unique(std::vector<int>& blocks) {
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

/// Blocks of three nodes, each once.
void find_blocks(const Model& model, const Collider& collider, int face, std::vector<int>& blocks) {
  blocks.clear();
  for (const int node : collider.surface.faces.col(face))
    append_blocks(model, collider.nodes[static_cast<std::size_t>(node)], blocks);
  sort_unique(blocks);
}

bool lacks(const fem::BlockMatrix& A, std::span<const int> rows, std::span<const int> columns) {
  return std::any_of(rows.begin(), rows.end(), [&](int i) {
    return std::any_of(columns.begin(), columns.end(), [&](int j) { return A.slot(i, j) < 0; });
  });
}

/// Pointwise, a candidate couples the triangle with the face; each is coupled in itself as part of
/// an element or a rigid body.
void append_missing_pairs(const Model& model, const CandidateList& list, const Collider& triangles,
                          const Collider& faces, const fem::BlockMatrix& A, Stencils& stencils) {
  std::vector<int> of_triangle, of_face;
  for (const ContactCandidate& candidate : list.pairs) {
    find_blocks(model, triangles, candidate.triangle, of_triangle);
    find_blocks(model, faces, candidate.face, of_face);
    if (!lacks(A, of_triangle, of_face)) continue;
    of_triangle.insert(of_triangle.end(), of_face.begin(), of_face.end());
    sort_unique(of_triangle);
    stencils.blocks.insert(stencils.blocks.end(), of_triangle.begin(), of_triangle.end());
    stencils.close();
  }
}

/// An average couples all that its group meets.
void append_missing_averages(const Model& model, const CandidateList& list,
                             const Collider& triangles, const Collider& faces,
                             const fem::BlockMatrix& A, Stencils& stencils) {
  std::vector<std::vector<int>> blocks_of_group(triangles.group_node.size());
  for (const ContactCandidate& candidate : list.pairs)
    for (const int a : triangles.groups.col(candidate.triangle))
      for (const NodeRef* node : nodes_of(triangles, faces, candidate.triangle, candidate.face))
        append_blocks(model, *node, blocks_of_group[static_cast<std::size_t>(a)]);
  for (std::vector<int>& blocks : blocks_of_group) {
    if (blocks.empty()) continue;
    sort_unique(blocks);
    if (!lacks(A, blocks, blocks)) continue;
    stencils.blocks.insert(stencils.blocks.end(), blocks.begin(), blocks.end());
    stencils.close();
  }
}

}  // namespace

void append_missing_stencils(const Model& model, std::span<const CandidateList> candidates,
                             const fem::BlockMatrix& A, Stencils& stencils) {
  for (const CandidateList& list : candidates) {
    const ContactModel contact = model.contacts[list.contact];
    const ContactSides side = sides_of(model, contact);
    const auto append =
        contact.averaged || contact.law.acts() ? append_missing_averages : append_missing_pairs;
    append(model, list, side.triangles, side.faces, A, stencils);
  }
}

}  // namespace articular::sim
