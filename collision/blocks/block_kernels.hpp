#pragma once

#include <cstdint>

/// The loops that are compiled once for each instruction set and chosen when the program starts.
/// Plain data only: code that is shared with other files must not be compiled for a processor that
/// may not be there.
namespace articular::collision {

enum class InstructionSet { Baseline, Avx2, Avx512 };

/// The widest that this processor has.
InstructionSet best_instruction_set();

inline constexpr int kBlockSize = 16;

/// Sixteen boxes. An absent one is empty: it starts at +infinity and ends at -infinity.
struct alignas(64) BoxGroup {
  float low[3][kBlockSize], high[3][kBlockSize];
};

struct FloatBox {
  float low[3], high[3];
};

/// One block of tetrahedra against blocks of faces. Lengths in the unit and frame of the positions.
struct BlockQuery {
  // The tetrahedra.
  const double* positions;  // four a node, the last without meaning
  const int* nodes;         // of the block, each once
  int num_nodes;
  const std::uint8_t* corners;      // [4][16] indices into nodes
  int num_tets;                     // up to 16; the other lanes repeat one of them
  double centre[3], half_edges[3];  // of the box of the block, without margin
  double inverse_size;              // of the block; a power of two
  double margin;
  // The faces.
  const double* face_corners;       // [block][corner][axis][16]
  const std::int32_t* face_nodes;   // [block][corner][16]
  const int* face_blocks;           // those to be tested
  const std::uint16_t* face_masks;  // and the faces in them
  int num_face_blocks;
  // How.
  bool one_mesh;    // leave out pairs with a common node
  bool boxes_only;  // every pair with overlapping boxes is doubtful
  // Results: (256 x index into face_blocks) + (16 x face) + tetrahedron. Room for 256 x
  // num_face_blocks in each list.
  std::uint32_t* accepted;  // certainly meet
  std::uint32_t* doubtful;  // to be decided in double precision
  int num_accepted, num_doubtful;
  int num_candidates;  // pairs with overlapping boxes, but for those whose face's plane misses the
                       // block
};

/// A list of pairs (face, tetrahedron), without a margin.
struct PairList {
  const double *face_positions, *tet_positions;  // three a node
  const int *faces, *tets;                       // three and four nodes an element
  const int* pairs;                              // two a pair
  int num_pairs;
  // Results: indices of pairs. Room for num_pairs in each list.
  std::uint32_t *accepted, *doubtful;
  int num_accepted, num_doubtful;
};

/// From positions to the frame of a tree's boxes.
struct BoxFrame {
  double origin[3], inverse_scale;
  double half_margin;  // that boxes are inflated by [m]
  float slack;         // and what round-off needs, in units of the scale
};

/// Boxes of blocks, each of some nodes.
struct BlockFit {
  const double* positions;   // four a node, the last without meaning [m]
  const int *begin, *nodes;  // nodes of block b: nodes[begin[b]] to nodes[begin[b + 1] - 1]
  int num_blocks;
  BoxGroup* groups;  // a lane a block
};

/// Corners and boxes of faces, a lane a face.
struct FaceFit {
  const double* positions;    // four a node, the last without meaning [m]
  const std::int32_t* nodes;  // [block][corner][16]
  int num_faces;              // further lanes of the last block get no box
  double* corners;            // [block][corner][axis][16]
  BoxGroup* groups;
};

struct BlockKernels {
  void (*fit_blocks)(const BoxFrame& frame, const BlockFit& fit);
  void (*fit_faces)(const BoxFrame& frame, const FaceFit& fit);
  /// Which boxes of the group overlap the box: bit i for the i-th.
  unsigned (*overlapping)(const BoxGroup& group, const FloatBox& box);
  void (*test_block)(BlockQuery& query);
  void (*test_pairs)(PairList& list);
};

const BlockKernels& block_kernels(InstructionSet set);

namespace baseline {
extern const BlockKernels kernels;
}
namespace avx2 {
extern const BlockKernels kernels;
}
namespace avx512 {
extern const BlockKernels kernels;
}

}  // namespace articular::collision
