#include "sim/contact/contact_stencils.hpp"

#include <algorithm>
#include <utility>
#include <vector>

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

bool has(const fem::BlockMatrix& A, int row, std::span<const int> columns) {
  const auto known =
      A.column().subspan(static_cast<std::size_t>(A.row_begin()[static_cast<std::size_t>(row)]),
                         static_cast<std::size_t>(A.row_begin()[static_cast<std::size_t>(row) + 1] -
                                                  A.row_begin()[static_cast<std::size_t>(row)]));
  return std::includes(known.begin(), known.end(), columns.begin(), columns.end());
}

/// @param columns  in ascending order
bool lacks(const fem::BlockMatrix& A, std::span<const int> rows, std::span<const int> columns) {
  return std::any_of(rows.begin(), rows.end(), [&](int i) { return !has(A, i, columns); });
}

/// Any pair of these. @param blocks  in ascending order
bool lacks(const fem::BlockMatrix& A, std::span<const int> blocks) {
  for (std::size_t k = 0; k < blocks.size(); ++k)  // the pattern is symmetric
    if (!has(A, blocks[k], blocks.subspan(k))) return true;
  return false;
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

bool is_averaged(const ContactModel& contact) { return contact.averaged || contact.law.acts(); }

bool lacks_pair(const Model& model, const ContactPairState& pair_state, const fem::BlockMatrix& A) {
  const ContactSides side = sides_of(model, pair_state);
  std::vector<int> of_triangle, of_face;
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    if (!carries(pair_state, entry.triangle, side.triangles.groups)) continue;
    find_blocks(model, side.triangles, entry.triangle, of_triangle);
    find_blocks(model, side.faces, entry.face, of_face);
    if (lacks(A, of_triangle, of_face)) return true;
  }
  return false;
}

bool lacks_average(const Model& model, const ContactPairState& pair_state,
                   const fem::BlockMatrix& A, BlocksOfGroups& blocks) {
  const ContactSides side = sides_of(model, pair_state);
  if (blocks.size() < side.triangles.group_node.size())
    blocks.resize(side.triangles.group_node.size());
  const auto of_group = [&](int a) -> std::vector<int>& {
    return blocks[static_cast<std::size_t>(a)];
  };
  for (const int a : pair_state.groups) of_group(a).clear();
  int last = -1;  // the patches of a triangle lie side by side
  for (const ContactPairState::Patch& entry : pair_state.patches()) {
    const auto nodes = nodes_of(side.triangles, side.faces, entry.triangle, entry.face);
    const std::size_t first = std::exchange(last, entry.triangle) == entry.triangle ? 3 : 0;
    for (const int a : side.triangles.groups.col(entry.triangle))
      if (pair_state.pressure[a] > 0 || pair_state.presses_in_matrix(a))
        for (std::size_t k = first; k < nodes.size(); ++k)
          append_blocks(model, *nodes[k], of_group(a));
  }
  return std::any_of(pair_state.groups.begin(), pair_state.groups.end(), [&](int a) {
    sort_unique(of_group(a));
    return lacks(A, of_group(a));
  });
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
    if (!lacks(A, blocks)) continue;
    stencils.blocks.insert(stencils.blocks.end(), blocks.begin(), blocks.end());
    stencils.close();
  }
}

}  // namespace

bool lacks_stencils(const Model& model, std::span<const ContactPairState* const> pair_states,
                    const fem::BlockMatrix& A, BlocksOfGroups& blocks) {
  return std::any_of(pair_states.begin(), pair_states.end(), [&](const ContactPairState* state) {
    return is_averaged(state->pair) ? lacks_average(model, *state, A, blocks)
                                    : lacks_pair(model, *state, A);
  });
}

void append_missing_stencils(const Model& model, std::span<const CandidateList> candidates,
                             const fem::BlockMatrix& A, Stencils& stencils) {
  for (const CandidateList& list : candidates) {
    const ContactModel contact = model.contacts[list.contact];
    const ContactSides side = sides_of(model, contact);
    const auto append = is_averaged(contact) ? append_missing_averages : append_missing_pairs;
    append(model, list, side.triangles, side.faces, A, stencils);
  }
}

}  // namespace articular::sim
