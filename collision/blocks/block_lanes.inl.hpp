// Part of block_kernels.inl.hpp.
//
// Sixteen tetrahedra, sixteen faces, side by side in the coordinates of the block of tetrahedra.

#include "collision/blocks/block_kernels.hpp"

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
/// @return faces whose plane is not certain to miss that box
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

}  // namespace
}  // namespace articular::collision::ARTICULAR_INSTRUCTION_SET
