// Included once for each instruction set, after its Vec. No include guard, nothing shared but plain
// data (see block_kernels.hpp).

#include <cstdint>

#include "collision/blocks/block_fit.inl.hpp"
#include "collision/blocks/block_kernels.hpp"
#include "collision/blocks/block_lanes.inl.hpp"
#include "collision/blocks/block_verdicts.inl.hpp"

namespace articular::collision::ARTICULAR_INSTRUCTION_SET {
namespace {

void load_tetrahedra(const BlockQuery& query, TetLanes& lanes) {
  alignas(64) float local[3][4 * kBlockSize] = {};
  for (int i = 0; i < query.num_nodes; ++i)
    for (int axis = 0; axis < 3; ++axis)
      local[axis][i] = static_cast<float>(
          (query.positions[4 * query.nodes[i] + axis] - query.centre[axis]) * query.inverse_size);
  for (int corner = 0; corner < 4; ++corner)
    for (int first = 0; first < kBlockSize; first += Vec::kWidth)
      for (int axis = 0; axis < 3; ++axis)
        look_up(query.corners + corner * kBlockSize + first, local[axis], query.num_nodes)
            .store(lanes.corner[corner].row[axis] + first);
  if (query.one_mesh)
    for (int corner = 0; corner < 4; ++corner)
      for (int lane = 0; lane < kBlockSize; ++lane)
        lanes.node[corner][lane] = query.nodes[query.corners[corner * kBlockSize + lane]];
  lanes.present = (1u << query.num_tets) - 1;
  lanes.margin = static_cast<float>(query.margin * query.inverse_size);
}

void load_faces(const BlockQuery& query, int block, FaceLanes& lanes) {
  const double* from = query.face_corners + 9 * kBlockSize * static_cast<std::int64_t>(block);
  const std::int32_t* nodes = query.face_nodes + 3 * kBlockSize * static_cast<std::int64_t>(block);
  for (int corner = 0; corner < 3; ++corner) {
    for (int axis = 0; axis < 3; ++axis, from += kBlockSize)
      for (int lane = 0; lane < kBlockSize; ++lane)
        lanes.corner[corner].row[axis][lane] =
            static_cast<float>((from[lane] - query.centre[axis]) * query.inverse_size);
    if (query.one_mesh)
      for (int lane = 0; lane < kBlockSize; ++lane)
        lanes.node[corner][lane] = nodes[corner * kBlockSize + lane];
  }
}

/// Pairs of a block of tetrahedra and a block of faces whose boxes overlap: 16 x face +
/// tetrahedron.
struct Candidates {
  std::uint8_t pair[kBlockSize * kBlockSize + kBlockSize] = {};
  int size = 0;
};

/// Pairs that the planes do not decide, gathered until a whole vector of them can be tested.
struct alignas(64) EdgeBatch {
  static constexpr int kRows = 18;  // L, heights, two errors
  float row[kRows][2 * kBlockSize];
  std::uint32_t id[2 * kBlockSize];
  int size = 0;
};

/// Adds all but the ids.
inline void enqueue(const Signs& s, unsigned mask, EdgeBatch& batch) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) store_packed(s.L[i][j], mask, batch.row[3 * i + j] + batch.size);
    store_packed(s.height[i], mask, batch.row[12 + i] + batch.size);
  }
  store_packed(s.error_L, mask, batch.row[16] + batch.size);
  store_packed(s.error_height, mask, batch.row[17] + batch.size);
}

inline void append(unsigned mask, const std::uint32_t* ids, std::uint32_t* list, int& size) {
  for (; mask != 0; mask &= mask - 1) list[size++] = ids[__builtin_ctz(mask)];
}
inline void append(unsigned mask, std::uint32_t first_id, const std::uint8_t* rest_of_ids,
                   std::uint32_t* list, int& size) {
  for (; mask != 0; mask &= mask - 1) list[size++] = first_id + rest_of_ids[__builtin_ctz(mask)];
}
inline void append(unsigned mask, std::uint32_t first_id, std::uint32_t* list, int& size) {
  for (; mask != 0; mask &= mask - 1)
    list[size++] = first_id + static_cast<std::uint32_t>(__builtin_ctz(mask));
}

/// Tests the first Vec::kWidth pairs of the batch, or as many as there are.
/// @param result  the lists of accepted and doubtful pairs: a BlockQuery or a PairList
template <class Result>
void test_edges(EdgeBatch& batch, Result& result) {
  Signs s;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) s.L[i][j] = Vec::load(batch.row[3 * i + j]);
    s.height[i] = Vec::load(batch.row[12 + i]);
  }
  s.error_L = Vec::load(batch.row[16]);
  s.error_height = Vec::load(batch.row[17]);
  const int count = batch.size < Vec::kWidth ? batch.size : Vec::kWidth;
  const unsigned filled = static_cast<unsigned>((std::uint64_t{1} << count) - 1);
  const Verdict v = by_edges(s);
  append(v.meet & filled, batch.id, result.accepted, result.num_accepted);
  append(~(v.meet | v.apart) & filled, batch.id, result.doubtful, result.num_doubtful);
  for (int rest = count; rest < batch.size; ++rest) {
    for (int r = 0; r < EdgeBatch::kRows; ++r) batch.row[r][rest - count] = batch.row[r][rest];
    batch.id[rest - count] = batch.id[rest];
  }
  batch.size -= count;
}

/// For each byte of a mask its bits' numbers one behind the other, eight bits a number.
struct PackedBits {
  std::uint64_t of[256];
};
constexpr PackedBits packed_bits() {
  PackedBits bits = {};
  for (unsigned byte = 0; byte < 256; ++byte) {
    int count = 0;
    for (unsigned bit = 0; bit < 8; ++bit)
      if ((byte >> bit & 1) != 0) bits.of[byte] |= std::uint64_t{bit} << (8 * count++);
  }
  return bits;
}
constexpr PackedBits kPackedBits = packed_bits();

inline void write(std::uint64_t bytes, std::uint8_t* to) { __builtin_memcpy(to, &bytes, 8); }

/// Adds a face with the tetrahedra of the mask. Sixteen are written, as many as there are count.
inline void append(int face, unsigned mask, Candidates& candidates) {
  constexpr std::uint64_t kEachByte = 0x0101010101010101;
  const std::uint64_t first = static_cast<std::uint64_t>(face * kBlockSize) * kEachByte;
  const unsigned low = mask & 0xff, high = mask >> 8;
  std::uint8_t* pairs = candidates.pair + candidates.size;
  write(kPackedBits.of[low] + first, pairs);
  write(kPackedBits.of[high] + first + 8 * kEachByte, pairs + __builtin_popcount(low));
  candidates.size += __builtin_popcount(mask);
}

/// Pairs with overlapping boxes, for a block on which single precision has a say.
void find_candidates(const TetLanes& tets, const FaceLanes& faces, unsigned face_mask,
                     Candidates& candidates) {
  for (; face_mask != 0; face_mask &= face_mask - 1) {
    const int face = __builtin_ctz(face_mask);
    append(face, boxes_overlap(tets, box_of(faces, face, 0)), candidates);
  }
}

/// The same where more has to be asked: pairs with a common node are left out, and those that
/// single precision can't judge go to the doubtful ones at once.
void find_candidates_with_care(const TetLanes& tets, const FaceLanes& faces, unsigned face_mask,
                               std::uint32_t block_id, BlockQuery& query, Candidates& candidates) {
  for (; face_mask != 0; face_mask &= face_mask - 1) {
    const int face = __builtin_ctz(face_mask);
    unsigned mask = boxes_overlap(tets, box_of(faces, face, 0));
    if (mask == 0) continue;
    if (query.one_mesh) mask &= ~share_a_node(tets, faces, face);
    unsigned doubtful = query.boxes_only ? mask : mask & tets.flat;
    if (query.margin > 0)
      doubtful |= mask & ~boxes_overlap(tets, box_of(faces, face, 2 * faces.room[face]));
    query.num_candidates += __builtin_popcount(doubtful);
    append(doubtful, block_id + static_cast<std::uint32_t>(face * kBlockSize), query.doubtful,
           query.num_doubtful);
    append(face, mask & ~doubtful, candidates);
  }
}

void test_candidates(const TetLanes& tets, const FaceLanes& faces, const Candidates& candidates,
                     std::uint32_t block_id, BlockQuery& query, EdgeBatch& batch) {
  query.num_candidates += candidates.size;
  for (int first = 0; first < candidates.size; first += Vec::kWidth) {
    const std::uint8_t* pairs = candidates.pair + first;
    const Pick tet = Pick::low_bits(pairs), face = Pick::high_bits(pairs);
    const int rest = candidates.size - first;
    const unsigned filled = rest >= Vec::kWidth ? kAllLanes : (1u << rest) - 1;
    const Signs s = locate(tets, tet, faces, face);
    if (query.margin > 0) {
      const Verdict v = by_planes_with_margin(s, tets, tet, faces, face);
      append(v.meet & filled, block_id, pairs, query.accepted, query.num_accepted);
      append(~(v.meet | v.apart) & filled, block_id, pairs, query.doubtful, query.num_doubtful);
      continue;
    }
    const unsigned near = filled & ~apart_by_planes(s);
    if (near == 0) continue;
    const unsigned inside = near & corner_inside(s), open = near & ~inside;
    append(inside, block_id, pairs, query.accepted, query.num_accepted);
    if (open == 0) continue;
    enqueue(s, open, batch);
    append(open, block_id, pairs, batch.id, batch.size);
    if (batch.size >= Vec::kWidth) test_edges(batch, query);
  }
}

void test_block(BlockQuery& query) {
  TetLanes tets;
  load_tetrahedra(query, tets);
  prepare(tets, query.margin > 0);
  FaceLanes faces;
  Candidates candidates;
  const bool with_care = query.one_mesh || query.boxes_only || query.margin > 0 || tets.flat != 0;
  const bool every_box_counts = query.boxes_only || query.margin > 0;
  float half_edges[3];
  for (int axis = 0; axis < 3; ++axis)
    half_edges[axis] = static_cast<float>(query.half_edges[axis] * query.inverse_size);
  EdgeBatch batch;
  for (int i = 0; i < query.num_face_blocks; ++i) {
    load_faces(query, query.face_blocks[i], faces);
    const unsigned near = prepare(faces, tets.margin, half_edges);
    const unsigned mask = query.face_masks[i] & (every_box_counts ? 0xffff : near);
    const auto block_id = static_cast<std::uint32_t>(i * kBlockSize * kBlockSize);
    candidates.size = 0;
    if (with_care)
      find_candidates_with_care(tets, faces, mask, block_id, query, candidates);
    else
      find_candidates(tets, faces, mask, candidates);
    test_candidates(tets, faces, candidates, block_id, query, batch);
  }
  while (batch.size > 0) test_edges(batch, query);
}

/// The two elements of each pair in a lane of their own, with a corner of the tetrahedron as
/// origin; one scale for all.
void load_pairs(const PairList& list, int first, int num, TetLanes& tets, FaceLanes& faces) {
  double local[7][3][kBlockSize];
  for (int lane = 0; lane < kBlockSize; ++lane) {
    const int* pair = list.pairs + 2 * (first + (lane < num ? lane : 0));
    const int* face = list.faces + 3 * std::int64_t{pair[0]};
    const int* tet = list.tets + 4 * std::int64_t{pair[1]};
    const double* p[7];
    for (int k = 0; k < 4; ++k) p[k] = list.tet_positions + 3 * std::int64_t{tet[k]};
    for (int k = 0; k < 3; ++k) p[4 + k] = list.face_positions + 3 * std::int64_t{face[k]};
    for (int k = 0; k < 7; ++k)
      for (int axis = 0; axis < 3; ++axis) local[k][axis][lane] = p[k][axis] - p[0][axis];
  }
  double farthest[kBlockSize] = {};
  for (int k = 1; k < 4; ++k)
    for (int axis = 0; axis < 3; ++axis)
      for (int lane = 0; lane < kBlockSize; ++lane) {
        const double x = __builtin_fabs(local[k][axis][lane]);
        farthest[lane] = x > farthest[lane] ? x : farthest[lane];
      }
  double scale = 1e-290;
  for (const double distance : farthest) scale = distance > scale ? distance : scale;
  const double inverse = 1 / scale;
  for (int k = 0; k < 7; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      float* row = k < 4 ? tets.corner[k].row[axis] : faces.corner[k - 4].row[axis];
      for (int lane = 0; lane < kBlockSize; ++lane)
        row[lane] = static_cast<float>(local[k][axis][lane] * inverse);
    }
  tets.margin = 0;
}

/// Lane by lane, with the faces' round-off.
inline unsigned boxes_overlap(const TetLanes& tets, const FaceLanes& faces, int first) {
  unsigned mask = kAllLanes;
  for (int axis = 0; axis < 3; ++axis)
    mask &=
        less_equal(Vec::load(faces.low.row[axis] + first), Vec::load(tets.high.row[axis] + first)) &
        less_equal(Vec::load(tets.low.row[axis] + first), Vec::load(faces.high.row[axis] + first));
  return mask;
}

void test_pairs(PairList& list) {
  static constexpr float kNoEdges[3] = {0, 0, 0};
  static constexpr std::uint8_t kInOrder[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  TetLanes tets;
  FaceLanes faces;
  EdgeBatch batch;
  for (int block = 0; block < list.num_pairs; block += kBlockSize) {
    const int num = list.num_pairs - block < kBlockSize ? list.num_pairs - block : kBlockSize;
    load_pairs(list, block, num, tets, faces);
    prepare(tets, false);
    prepare(faces, 0, kNoEdges);
    for (int first = 0; first < num; first += Vec::kWidth) {
      const Pick pick = Pick::low_bits(kInOrder + first);
      std::uint32_t ids[Vec::kWidth];
      for (int i = 0; i < Vec::kWidth; ++i) ids[i] = static_cast<std::uint32_t>(block + first + i);
      const unsigned present = ((1u << num) - 1) >> first & kAllLanes;
      const unsigned mask = present & boxes_overlap(tets, faces, first);
      const unsigned flat = mask & (tets.flat >> first);
      const Signs s = locate(tets, pick, faces, pick);
      const unsigned near = mask & ~flat & ~apart_by_planes(s), inside = near & corner_inside(s);
      append(flat, ids, list.doubtful, list.num_doubtful);
      append(inside, ids, list.accepted, list.num_accepted);
      enqueue(s, near & ~inside, batch);
      append(near & ~inside, ids, batch.id, batch.size);
      if (batch.size >= Vec::kWidth) test_edges(batch, list);
    }
  }
  while (batch.size > 0) test_edges(batch, list);
}

unsigned overlapping(const BoxGroup& group, const FloatBox& box) {
  unsigned result = 0;
  for (int first = 0; first < kBlockSize; first += Vec::kWidth) {
    unsigned mask = kAllLanes;
    for (int axis = 0; axis < 3; ++axis)
      mask &= less_equal(Vec::load(group.low[axis] + first), Vec::all(box.high[axis])) &
              less_equal(Vec::all(box.low[axis]), Vec::load(group.high[axis] + first));
    result |= mask << first;
  }
  return result;
}

}  // namespace

const BlockKernels kernels = {fit_blocks, fit_faces, overlapping, test_block, test_pairs};

}  // namespace articular::collision::ARTICULAR_INSTRUCTION_SET
