// Included once for each instruction set, after its Vec. No include guard, nothing shared but plain
// data (see block_kernels.hpp).
//
// A triangle q0 q1 q2 against a tetrahedron a b c d, sixteen tetrahedra side by side. With
// L_i(q) = 6V times the barycentric coordinate of q that is 1 at corner i, the two meet if and only
// if an edge of the triangle meets the tetrahedron or an edge of the tetrahedron meets the
// triangle. Both are read off the signs of the twelve L_i(q_j), of the heights of the four corners
// above the triangle's plane, and of D_ik(s, t) = L_i(s) L_k(t) - L_k(s) L_i(t), the side on which
// the line s t passes the tetrahedron's edge where faces i and k meet (a product of Plucker
// coordinates).
//
// All of it in single precision, in coordinates of the block. Every sign is taken with a bound on
// its error, so that a verdict is "meet", "apart" or "doubtful", never wrong. The bound: with
// positions known to delta = 2^-24 times the largest coordinate, edges up to E and all differences
// up to S, a product of three lengths, L = n.q - n.a with n from two edges, has an error of at most
// E S (84 delta + 24 u S), u = 2^-24.

#include <cstdint>

#include "collision/block_kernels.hpp"

namespace articular::collision::ARTICULAR_INSTRUCTION_SET {
namespace {

constexpr unsigned kAllLanes = (1u << Vec::kWidth) - 1;
constexpr float kUnit = 0x1p-24f;  // u: half the distance from 1 to the next float

struct Vec3 {
  Vec x, y, z;
};

inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec magnitude(Vec a) { return max(a, Vec::all(0) - a); }
inline Vec largest_component(const Vec3& a) {
  return max(magnitude(a.x), max(magnitude(a.y), magnitude(a.z)));
}
struct alignas(64) Rows3 {
  float row[3][kBlockSize];
};
inline Vec3 load(const Rows3& rows, int first) {
  return {Vec::load(rows.row[0] + first), Vec::load(rows.row[1] + first),
          Vec::load(rows.row[2] + first)};
}
/// One of the sixteen in all lanes.
inline Vec3 lane_of(const Rows3& rows, int lane) {
  return {Vec::all(rows.row[0][lane]), Vec::all(rows.row[1][lane]), Vec::all(rows.row[2][lane])};
}
inline void store(const Vec3& v, Rows3& rows, int first) {
  v.x.store(rows.row[0] + first);
  v.y.store(rows.row[1] + first);
  v.z.store(rows.row[2] + first);
}

/// The tetrahedra of a block in its own coordinates: origin at its centre, size about 1.
struct alignas(64) TetLanes {
  Rows3 corner[4];
  Rows3 normal[4];              // gradients of L_0 to L_3
  float offset[4][kBlockSize];  // L_i(q) = normal_i . q - offset_i
  float edge[kBlockSize];       // largest component of an edge
  Rows3 low, high;              // boxes, inflated by half the margin
  float reach[4][kBlockSize];   // margin times the length of the gradient of L_i
  std::int32_t node[4][kBlockSize];
  unsigned present, flat;  // lanes that hold a tetrahedron; lanes whose sign of V is unsure
  float margin;
};

/// Sixteen faces in the coordinates of a block of tetrahedra.
struct alignas(64) FaceLanes {
  Rows3 corner[3];
  Rows3 normal;
  float offset[kBlockSize];  // height(p) = normal . p - offset
  float edge[kBlockSize];    // largest component of an edge
  float delta[kBlockSize];   // error of positions
  Rows3 low, high;           // boxes, inflated by half the margin and by round-off
  float room[kBlockSize];    // of that, the round-off
  std::int32_t node[3][kBlockSize];
};

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

inline Vec3 lowest(const Vec3& a, const Vec3& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
inline Vec3 highest(const Vec3& a, const Vec3& b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
inline Vec3 operator*(Vec factor, const Vec3& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}

/// Error of a product of three lengths (see above).
inline Vec error_of_product(Vec E, Vec S, Vec delta) {
  return E * S * (Vec::all(88) * delta + Vec::all(32 * kUnit) * S);
}
/// The gradient of L_0 is minus the sum of the other three, and has all their errors.
constexpr float kErrorOfL0 = 4;
/// Normals, products of two lengths, have errors of up to 28 times those of the lengths.
constexpr float kErrorOfNormal = 32;
/// Of a length times the margin.
constexpr float kMarginRoundOff = 16 * kUnit;

/// Boxes, gradients and volumes. Inverted tetrahedra are turned: V > 0.
void prepare(TetLanes& lanes, bool with_margin) {
  const Vec margin = Vec::all(lanes.margin), half_margin = Vec::all(0.5f * lanes.margin);
  lanes.flat = 0;
  for (int first = 0; first < kBlockSize; first += Vec::kWidth) {
    const Vec3 a = load(lanes.corner[0], first), b = load(lanes.corner[1], first),
               c = load(lanes.corner[2], first), d = load(lanes.corner[3], first);
    const Vec3 low = lowest(lowest(a, b), lowest(c, d));
    const Vec3 high = highest(highest(a, b), highest(c, d));
    const Vec3 room = {half_margin, half_margin, half_margin};
    store(low - room, lanes.low, first);
    store(high + room, lanes.high, first);
    const Vec E = largest_component(high - low);
    E.store(lanes.edge + first);

    const Vec3 e1 = b - a, e2 = c - a, e3 = d - a;
    const Vec V = dot(e1, cross(e2, e3)), size = magnitude(V);
    const Vec sign = V / max(size, Vec::all(0x1p-126f));
    const Vec3 n1 = sign * cross(e2, e3), n2 = sign * cross(e3, e1), n3 = sign * cross(e1, e2);
    const Vec zero = Vec::all(0);
    const Vec3 n0 = Vec3{zero, zero, zero} - (n1 + n2 + n3);
    const Vec unsure = Vec::all(kErrorOfL0) * error_of_product(E, E, Vec::all(kUnit));
    lanes.flat |= (kAllLanes & ~less(unsure, size)) << first;
    const Vec3* normals[4] = {&n0, &n1, &n2, &n3};
    for (int i = 0; i < 4; ++i) {
      store(*normals[i], lanes.normal[i], first);
      dot(*normals[i], i == 0 ? b : a).store(lanes.offset[i] + first);
      if (with_margin) (margin * sqrt(dot(*normals[i], *normals[i]))).store(lanes.reach[i] + first);
    }
  }
}

/// Error of positions of that size. Infinite where products of three lengths may overflow: then all
/// errors are, and no verdict is certain.
inline Vec error_of_positions(Vec size) {
  return max(Vec::all(kUnit) * size, Vec::all(0x1p-120f) * (Vec::all(0x1p88f) * size));
}

/// Boxes, normals and errors.
/// @param half_edges  of the box of the block, which has its centre at the origin
/// @return faces whose plane is not certain to pass that box
unsigned prepare(FaceLanes& lanes, float margin, const float* half_edges) {
  unsigned near = 0;
  const Vec half_margin = Vec::all(0.5f * margin);
  for (int first = 0; first < kBlockSize; first += Vec::kWidth) {
    const Vec3 p = load(lanes.corner[0], first), q = load(lanes.corner[1], first),
               r = load(lanes.corner[2], first);
    const Vec3 low = lowest(p, lowest(q, r)), high = highest(p, highest(q, r));
    const Vec edge = largest_component(high - low);
    const Vec farthest = max(Vec::all(1), max(largest_component(low), largest_component(high)));
    const Vec delta = error_of_positions(farthest), room = Vec::all(8) * delta;
    const Vec outward = half_margin + room;
    const Vec3 normal = cross(q - p, r - p);
    const Vec offset = dot(normal, p);
    edge.store(lanes.edge + first);
    delta.store(lanes.delta + first);
    room.store(lanes.room + first);
    store(low - Vec3{outward, outward, outward}, lanes.low, first);
    store(high + Vec3{outward, outward, outward}, lanes.high, first);
    store(normal, lanes.normal, first);
    offset.store(lanes.offset + first);
    const Vec reach = magnitude(normal.x) * Vec::all(half_edges[0]) +
                      magnitude(normal.y) * Vec::all(half_edges[1]) +
                      magnitude(normal.z) * Vec::all(half_edges[2]);
    const Vec error = error_of_product(edge, farthest + farthest, delta);
    near |= (kAllLanes & ~less(reach + error, magnitude(offset))) << first;
  }
  return near;
}

/// Tetrahedra whose box overlaps the box.
inline unsigned boxes_overlap(const TetLanes& tets, const FloatBox& box) {
  unsigned result = 0;
  for (int first = 0; first < kBlockSize; first += Vec::kWidth) {
    unsigned mask = kAllLanes;
    for (int axis = 0; axis < 3; ++axis)
      mask &= less_equal(Vec::all(box.low[axis]), Vec::load(tets.high.row[axis] + first)) &
              less_equal(Vec::load(tets.low.row[axis] + first), Vec::all(box.high[axis]));
    result |= mask << first;
  }
  return result & tets.present;
}

/// The box of a face, made smaller by `less` on each side.
inline FloatBox box_of(const FaceLanes& faces, int face, float less) {
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = faces.low.row[axis][face] + less;
    box.high[axis] = faces.high.row[axis][face] - less;
  }
  return box;
}

inline unsigned share_a_node(const TetLanes& tets, const FaceLanes& faces, int face) {
  unsigned result = 0;
  for (int first = 0; first < kBlockSize; first += Vec::kWidth) {
    unsigned mask = 0;
    for (int corner = 0; corner < 4; ++corner)
      for (int j = 0; j < 3; ++j) mask |= equal(tets.node[corner] + first, faces.node[j][face]);
    result |= mask << first;
  }
  return result;
}

/// Pairs of a block of tetrahedra and a block of faces whose boxes overlap: 16 x face +
/// tetrahedron.
struct Candidates {
  std::uint8_t pair[kBlockSize * kBlockSize + kBlockSize] = {};
  int size = 0;
};

/// Where a triangle's corners lie relative to a tetrahedron, and this to the triangle's plane. A
/// pair a lane.
struct Signs {
  Vec L[4][3];    // of corner j
  Vec height[4];  // of the tetrahedron's corners, times twice the triangle's area
  Vec error_L, error_height;
};

inline Vec3 pick3(const Pick& pick, const Rows3& rows) {
  return {pick(rows.row[0]), pick(rows.row[1]), pick(rows.row[2])};
}

Signs locate(const TetLanes& tets, const Pick& tet, const FaceLanes& faces, const Pick& face) {
  Signs s;
  const Vec3 normal = pick3(face, faces.normal);
  const Vec offset = face(faces.offset);
  for (int corner = 0; corner < 4; ++corner)
    s.height[corner] = dot(normal, pick3(tet, tets.corner[corner])) - offset;
  const Vec3 q[3] = {pick3(face, faces.corner[0]), pick3(face, faces.corner[1]),
                     pick3(face, faces.corner[2])};
  for (int i = 0; i < 4; ++i) {
    const Vec3 gradient = pick3(tet, tets.normal[i]);
    const Vec at_zero = tet(tets.offset[i]);
    for (int j = 0; j < 3; ++j) s.L[i][j] = dot(gradient, q[j]) - at_zero;
  }
  // Their boxes overlap, up to round-off: no two points are farther apart than S.
  const Vec E = tet(tets.edge), edge = face(faces.edge), delta = face(faces.delta);
  const Vec S = E + edge + Vec::all(16) * delta + Vec::all(tets.margin);
  s.error_L = error_of_product(E, S, delta);
  s.error_height = error_of_product(edge, S, delta);
  return s;
}

inline Vec least(Vec a, Vec b, Vec c) { return min(a, min(b, c)); }
inline Vec greatest(Vec a, Vec b, Vec c) { return max(a, max(b, c)); }
inline Vec least(const Vec* v) { return min(min(v[0], v[1]), min(v[2], v[3])); }
inline Vec greatest(const Vec* v) { return max(max(v[0], v[1]), max(v[2], v[3])); }
inline Vec negative(Vec a) { return Vec::all(0) - a; }

struct Verdict {
  unsigned apart, meet;
};

/// The planes of the faces: one of them separates.
inline unsigned apart_by_planes(const Signs& s) {
  const Vec e = s.error_L;
  unsigned apart = less(s.error_height, max(least(s.height), negative(greatest(s.height))));
  for (int i = 0; i < 4; ++i)
    apart |= less(greatest(s.L[i][0], s.L[i][1], s.L[i][2]),
                  negative(i == 0 ? Vec::all(kErrorOfL0) * e : e));
  return apart;
}

/// The same with a margin: one of the planes leaves a gap of more than that, or (meet) none does.
inline Verdict by_planes_with_margin(const Signs& s, const TetLanes& tets, const Pick& tet,
                                     const FaceLanes& faces, const Pick& face) {
  Verdict v{0, kAllLanes};
  const auto compare = [&](Vec distance, Vec reach, Vec error) {
    const Vec gap = distance - reach, unsure = error + Vec::all(kMarginRoundOff) * reach;
    v.apart |= less(unsure, gap);
    v.meet &= less(gap, negative(unsure));
  };
  const Vec margin = Vec::all(tets.margin), of_normal = margin * Vec::all(kErrorOfNormal);
  const Vec3 normal = pick3(face, faces.normal);
  compare(max(least(s.height), negative(greatest(s.height))), margin * sqrt(dot(normal, normal)),
          s.error_height + of_normal * face(faces.edge) * face(faces.delta));
  const Vec error = s.error_L + of_normal * Vec::all(kUnit) * tet(tets.edge);
  for (int i = 0; i < 4; ++i)
    compare(negative(greatest(s.L[i][0], s.L[i][1], s.L[i][2])), tet(tets.reach[i]),
            i == 0 ? Vec::all(kErrorOfL0) * error : error);
  return v;
}

/// Lanes with a corner of the triangle inside.
inline unsigned corner_inside(const Signs& s) {
  const Vec e = s.error_L, e0 = Vec::all(kErrorOfL0) * e;
  unsigned mask = 0;
  for (int j = 0; j < 3; ++j)
    mask |= less(e0, s.L[0][j]) & less(e, least(s.L[1][j], s.L[2][j], s.L[3][j]));
  return mask;
}

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

/// Two faces of the tetrahedron, and the corners at the ends of the edge where they meet.
struct TetEdge {
  int i, k, from, to;
};
constexpr TetEdge kTetEdges[6] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                  {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};

/// The edges of both. Pairs that by_planes() left open.
Verdict by_edges(const Signs& s) {
  const Vec e = s.error_L, e0 = Vec::all(kErrorOfL0) * e;
  unsigned positive[4][3], negative_L[4][3];
  Vec largest = Vec::all(0);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec error = i == 0 ? e0 : e;
      positive[i][j] = less(error, s.L[i][j]);
      negative_L[i][j] = less(s.L[i][j], negative(error));
      largest = max(largest, magnitude(s.L[i][j]));
    }
  unsigned above[4], below[4];
  for (int corner = 0; corner < 4; ++corner) {
    above[corner] = less(s.error_height, s.height[corner]);
    below[corner] = less(s.height[corner], negative(s.error_height));
  }

  // Of the triangle's edge from corner j: no part of it is in the tetrahedron; some part is.
  unsigned outside[3] = {0, 0, 0}, inside[3] = {kAllLanes, kAllLanes, kAllLanes};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) {
      const int t = (j + 1) % 3;
      outside[j] |= negative_L[i][j] & negative_L[i][t];
      inside[j] &= positive[i][j] | positive[i][t];
    }
  unsigned meet = 0, may_pierce = 0;
  for (const TetEdge& edge : kTetEdges) {
    const int i = edge.i, k = edge.k;
    // D = L_i(s) L_k(t) - L_k(s) L_i(t): 2.5 x the largest L x the sum of both errors bounds its
    // own.
    const Vec error = largest * e * Vec::all(i == 0 ? 2.5f * (1 + kErrorOfL0) : 2.5f * 2);
    unsigned all_left = kAllLanes, all_right = kAllLanes, any_left = 0, any_right = 0;
    for (int j = 0; j < 3; ++j) {
      const int t = (j + 1) % 3;
      const Vec D = s.L[i][j] * s.L[k][t] - s.L[k][j] * s.L[i][t];
      const unsigned right = less(error, D), left = less(D, negative(error));
      all_right &= right, any_right |= right;
      all_left &= left, any_left |= left;
      // From s to t the edge enters at face i and has left at face k before, or the reverse.
      outside[j] |= negative_L[i][j] & positive[i][t] & positive[k][j] & negative_L[k][t] & right;
      outside[j] |= negative_L[k][j] & positive[k][t] & positive[i][j] & negative_L[i][t] & left;
      inside[j] &= positive[i][j] | positive[k][t] | left;
      inside[j] &= positive[k][j] | positive[i][t] | right;
    }
    const unsigned through_plane =
        (above[edge.from] & below[edge.to]) | (below[edge.from] & above[edge.to]);
    const unsigned on_one_side =
        (above[edge.from] & above[edge.to]) | (below[edge.from] & below[edge.to]);
    meet |= (all_left | all_right) & through_plane;
    may_pierce |= ~(any_left & any_right) & ~on_one_side;
  }
  meet |= inside[0] | inside[1] | inside[2];
  return {outside[0] & outside[1] & outside[2] & ~may_pierce, meet};
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

inline float low_in(const BoxFrame& frame, double low, int axis) {
  return static_cast<float>((low - frame.half_margin - frame.origin[axis]) * frame.inverse_scale) -
         frame.slack;
}
inline float high_in(const BoxFrame& frame, double high, int axis) {
  return static_cast<float>((high + frame.half_margin - frame.origin[axis]) * frame.inverse_scale) +
         frame.slack;
}

void fit_blocks(const BoxFrame& frame, const BlockFit& fit) {
  for (int block = 0; block < fit.num_blocks; ++block) {
    Box4 box = Box4::at(fit.positions + 4 * fit.nodes[fit.begin[block]]);
    for (int i = fit.begin[block] + 1; i < fit.begin[block + 1]; ++i)
      box.include(fit.positions + 4 * fit.nodes[i]);
    double low[4], high[4];
    box.store(low, high);
    BoxGroup& group = fit.groups[block / kBlockSize];
    for (int axis = 0; axis < 3; ++axis) {
      group.low[axis][block % kBlockSize] = low_in(frame, low[axis], axis);
      group.high[axis][block % kBlockSize] = high_in(frame, high[axis], axis);
    }
  }
}

void fit_faces(const BoxFrame& frame, const FaceFit& fit) {
  const std::int32_t* node = fit.nodes;
  double* to = fit.corners;
  for (int first = 0; first < fit.num_faces; first += kBlockSize) {
    double corners[3][3][kBlockSize];
    for (int k = 0; k < 3; ++k)
      for (int lane = 0; lane < kBlockSize; ++lane) {
        const double* p = fit.positions + 4 * *node++;
        for (int axis = 0; axis < 3; ++axis) corners[k][axis][lane] = p[axis];
      }
    __builtin_memcpy(to, corners, sizeof(corners));
    to += 9 * kBlockSize;
    BoxGroup& group = fit.groups[first / kBlockSize];
    const int num = fit.num_faces - first < kBlockSize ? fit.num_faces - first : kBlockSize;
    for (int axis = 0; axis < 3; ++axis)
      for (int lane = 0; lane < num; ++lane) {
        const double p = corners[0][axis][lane], q = corners[1][axis][lane],
                     r = corners[2][axis][lane];
        const double low = p < q ? p : q, high = p > q ? p : q;
        group.low[axis][lane] = low_in(frame, low < r ? low : r, axis);
        group.high[axis][lane] = high_in(frame, high > r ? high : r, axis);
      }
  }
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
