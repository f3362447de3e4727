// The single-precision kernels against exact arithmetic: a verdict that they call certain is never
// wrong, however near to touching the pair is, whatever its size and place. What they leave open
// is decided elsewhere, and is not looked at here.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "tests/collision/support/exact_referee.hpp"
#include "tests/collision/support/hostile_meshes.hpp"
#include "tests/collision/support/oracles.hpp"
#include "tests/collision/support/rounds.hpp"
#include "tests/collision/support/rule_oracle.hpp"

namespace articular::collision::testing::kernel_bounds_test {

using Eigen::Vector3d;

constexpr int kTrials = 200;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A power of ten between the two, any real exponent.
double any_size(std::mt19937& random, double low, double high) {
  return std::pow(10, uniform(random, low, high));
}

struct Pair {
  Triangle triangle;
  Tetrahedron tetrahedron;
};

/// A point of the hull of some of the corners: a corner, an edge, a face.
template <class Corners>
Vector3d point_on(const Corners& corners, int num, std::mt19937& random) {
  Vector3d point = Vector3d::Zero();
  double sum = 0;
  const auto first = static_cast<Eigen::Index>(random() % static_cast<unsigned>(corners.cols()));
  for (int k = 0; k < num; ++k) {
    const double weight = uniform(random, 0.05, 1);
    point += weight * corners.col((first + k) % corners.cols());
    sum += weight;
  }
  return point / sum;
}

Vector3d unit_vector(std::mt19937& random) { return random_vector(random, 1).normalized(); }

/// A direction along which corner against face or edge against edge comes nearest, if possible.
Vector3d contact_normal(const Pair& p, std::mt19937& random) {
  const auto edge = [&](const auto& corners) {
    const auto num = static_cast<unsigned>(corners.cols());
    const auto i = random() % num, j = (i + 1 + random() % (num - 1)) % num;
    return Vector3d(corners.col(static_cast<Eigen::Index>(i)) -
                    corners.col(static_cast<Eigen::Index>(j)));
  };
  Vector3d normal;
  switch (random() % 3) {
    case 0:
      normal = edge(p.triangle).cross(edge(p.tetrahedron));
      break;
    case 1:
      normal = edge(p.tetrahedron).cross(edge(p.tetrahedron));
      break;
    default:
      normal = edge(p.triangle).cross(edge(p.triangle));
  }
  return normal.norm() > 0 ? normal.normalized() : unit_vector(random);
}

/// About as large as 1, touching up to a gap or an overlap of `gap`.
Pair near_touching_pair(double triangle_size, double thinness, double gap, std::mt19937& random) {
  Pair p;
  for (auto corner : p.tetrahedron.colwise()) corner = random_vector(random, 0.5);
  for (auto corner : p.triangle.colwise()) corner = random_vector(random, triangle_size);
  if (thinness < 1) {  // squeezed in any direction
    const Vector3d n = unit_vector(random), m = unit_vector(random);
    p.tetrahedron -= (1 - thinness) * n * (n.transpose() * p.tetrahedron);
    if (random() % 2 == 0) p.triangle -= (1 - thinness) * m * (m.transpose() * p.triangle);
  }
  const auto dimension = [&](int most) { return 1 + static_cast<int>(random() % most); };
  const Vector3d on_t = point_on(p.triangle, dimension(3), random),
                 on_w = point_on(p.tetrahedron, dimension(3), random);
  p.triangle.colwise() += on_w - on_t + gap * contact_normal(p, random);
  return p;
}

/// Sixteen pairs that one block may hold: near each other, in any unit and place.
std::vector<Pair> a_block_of_pairs(std::mt19937& random) {
  const double spread = any_size(random, -2, 2), unit = any_size(random, -9, 9);
  const double offset = random() % 2 == 0 ? 0 : any_size(random, -2, 9);
  const double triangle_size = random() % 4 == 0 ? any_size(random, -6, 14) : 1;
  std::vector<Pair> pairs;
  for (int i = 0; i < kBlockSize; ++i) {
    const double gap = any_size(random, -9, random() % 2 == 0 ? -3 : -6) * std::max(1.0, spread) *
                       std::max(1.0, triangle_size) * (random() % 2 == 0 ? 1 : -1);
    const double thinness = random() % 2 == 0 ? 1 : any_size(random, -6, 0);
    Pair p = near_touching_pair(triangle_size, thinness, gap, random);
    const Vector3d place = random_vector(random, spread) + Vector3d(offset, offset, -offset);
    p.triangle = unit * (p.triangle.colwise() + place);
    p.tetrahedron = unit * (p.tetrahedron.colwise() + place);
    pairs.push_back(p);
  }
  return pairs;
}

enum class Certain { Meet, Apart, Nothing };

/// Of pairs (face, tetrahedron), by 16 face + tetrahedron.
using Verdicts = std::array<Certain, kBlockSize * kBlockSize>;

template <class Lists>
Verdicts read(const Lists& lists) {
  Verdicts verdicts;
  verdicts.fill(Certain::Apart);
  for (int i = 0; i < lists.num_accepted; ++i) verdicts[lists.accepted[i]] = Certain::Meet;
  for (int i = 0; i < lists.num_doubtful; ++i) verdicts[lists.doubtful[i]] = Certain::Nothing;
  return verdicts;
}

/// All triangles against all tetrahedra.
Verdicts by_block(const std::vector<Pair>& pairs, double margin, InstructionSet set) {
  std::mt19937 random(1);
  const Mesh mesh = soup(kBlockSize, 1, random);
  Eigen::Matrix3Xd x(3, 4 * kBlockSize);
  double triangles[3][3][kBlockSize];  // [corner][axis]
  std::int32_t no_nodes[3 * kBlockSize] = {};
  for (int i = 0; i < kBlockSize; ++i) {
    const Pair& pair = pairs[static_cast<std::size_t>(i)];
    x.middleCols<4>(4 * i) = pair.tetrahedron;
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) triangles[k][axis][i] = pair.triangle(axis, k);
  }
  const BlockTree tree = tree_of(mesh, x, margin);
  const int block = 0;
  const std::uint16_t all_faces = 0xffff;
  std::uint32_t accepted[kBlockSize * kBlockSize], doubtful[kBlockSize * kBlockSize];
  BlockQuery query = {};
  tree.describe_block(block, query);
  query.face_corners = &triangles[0][0][0];
  query.face_nodes = no_nodes;
  query.face_blocks = &block;
  query.face_masks = &all_faces;
  query.num_face_blocks = 1;
  query.accepted = accepted;
  query.doubtful = doubtful;
  block_kernels(set).test_block(query);
  return read(query);
}

/// Each triangle against its tetrahedron.
Verdicts by_list(const std::vector<Pair>& pairs, InstructionSet set) {
  Eigen::Matrix3Xd x_f(3, 3 * kBlockSize), x_w(3, 4 * kBlockSize);
  for (int i = 0; i < kBlockSize; ++i) {
    x_f.middleCols<3>(3 * i) = pairs[static_cast<std::size_t>(i)].triangle;
    x_w.middleCols<4>(4 * i) = pairs[static_cast<std::size_t>(i)].tetrahedron;
  }
  std::array<int, 4 * kBlockSize> in_order;
  std::iota(in_order.begin(), in_order.end(), 0);
  std::array<int, 2 * kBlockSize> own;
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = static_cast<int>(i / 2);
  std::uint32_t accepted[kBlockSize], doubtful[kBlockSize];
  PairList list = {};
  list.face_positions = x_f.data();
  list.tet_positions = x_w.data();
  list.faces = list.tets = in_order.data();
  list.pairs = own.data();
  list.num_pairs = kBlockSize;
  list.accepted = accepted;
  list.doubtful = doubtful;
  block_kernels(set).test_pairs(list);
  return read(list);
}

struct Tally {
  int meet = 0, apart = 0, open = 0;
};

/// @param exactly  whether the pair meets
template <class Exactly>
void expect_right(const Pair& pair, Certain verdict, Exactly&& exactly, Tally& tally) {
  if (verdict == Certain::Nothing) {
    ++tally.open;
    return;
  }
  const bool meets = exactly(pair);
  ++(meets ? tally.meet : tally.apart);
  const Eigen::IOFormat all_digits(Eigen::FullPrecision);
  EXPECT_EQ(verdict == Certain::Meet, meets) << pair.triangle.format(all_digits) << "\n"
                                             << pair.tetrahedron.format(all_digits);
}

void expect_useful(const Tally& tally) {
  const int sum = tally.meet + tally.apart + tally.open;
  EXPECT_GT(tally.meet, sum / 30);
  EXPECT_GT(tally.apart, sum / 30);
  EXPECT_GT(tally.open, sum / 30);
}

class KernelBounds : public ::testing::TestWithParam<InstructionSet> {};
INSTANTIATE_TEST_SUITE_P(Certain, KernelBounds, ::testing::ValuesIn(instruction_sets()));

bool meets_exactly(const Pair& pair) { return exact::overlap(pair.triangle, pair.tetrahedron); }

TEST_P(KernelBounds, AVerdictOnABlockIsThatOfExactArithmetic) {
  std::mt19937 random(21);
  Tally tally;
  for (int trial = 0; trial < rounds(kTrials); ++trial) {
    const std::vector<Pair> pairs = a_block_of_pairs(random);
    const Verdicts verdicts = by_block(pairs, 0, GetParam());
    for (std::size_t i = 0; i < kBlockSize; ++i)
      for (const std::size_t j : {i, (i + 1) % kBlockSize})
        expect_right({pairs[i].triangle, pairs[j].tetrahedron}, verdicts[kBlockSize * i + j],
                     meets_exactly, tally);
  }
  expect_useful(tally);
}

TEST_P(KernelBounds, AVerdictOnAListIsThatOfExactArithmetic) {
  std::mt19937 random(22);
  Tally tally;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<Pair> pairs = a_block_of_pairs(random);
    const Verdicts verdicts = by_list(pairs, GetParam());
    for (std::size_t i = 0; i < kBlockSize; ++i)
      expect_right(pairs[i], verdicts[i], meets_exactly, tally);
  }
  expect_useful(tally);
}

using exact::operator-;
using exact::Real;
using RealPoint = exact::Point<Real>;

RealPoint real(const Vector3d& p) { return {Real(p[0]), Real(p[1]), Real(p[2])}; }

/// The rule with a margin (boxes, then planes of faces), to 100 digits.
bool within_margin(const Pair& pair, double margin) {
  const Triangle& t = pair.triangle;
  const Tetrahedron& w = pair.tetrahedron;
  const Real m(margin);
  for (int axis = 0; axis < 3; ++axis)
    if (Real(t.row(axis).minCoeff()) - Real(w.row(axis).maxCoeff()) > m ||
        Real(w.row(axis).minCoeff()) - Real(t.row(axis).maxCoeff()) > m)
      return false;
  // Whether the plane through a b c has all points at more than the margin on the side of `to`.
  const auto separates = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c,
                             const auto& points, const Real& to) {
    const RealPoint normal = exact::cross(real(b) - real(a), real(c) - real(a));
    const Real room = m * sqrt(exact::dot(normal, normal));
    for (const auto& p : points.colwise())
      if (!(to * exact::dot(normal, real(p) - real(a)) > room)) return false;
    return true;
  };
  if (separates(t.col(0), t.col(1), t.col(2), w, Real(1)) ||
      separates(t.col(0), t.col(1), t.col(2), w, Real(-1)))
    return false;
  for (int k = 0; k < 4; ++k) {
    const Vector3d a = w.col((k + 1) % 4), b = w.col((k + 2) % 4), c = w.col((k + 3) % 4);
    const Real inward =
        exact::dot(exact::cross(real(b) - real(a), real(c) - real(a)), real(w.col(k)) - real(a));
    if (inward == 0) return true;  // a flat one has no inside
    if (separates(a, b, c, t, inward > 0 ? Real(-1) : Real(1))) return false;
  }
  return true;
}

TEST_P(KernelBounds, AVerdictWithAMarginIsThatOfExactArithmetic) {
  std::mt19937 random(23);
  Tally tally;
  for (int trial = 0; trial < rounds(kTrials); ++trial) {
    std::vector<Pair> pairs = a_block_of_pairs(random);
    const double size = (pairs[0].tetrahedron.colwise() - pairs[0].tetrahedron.col(0)).norm();
    const double margin = size * any_size(random, -6, 1);
    // Pulled apart by about the margin.
    for (Pair& pair : pairs)
      pair.triangle.colwise() += margin * (1 + any_size(random, -9, -3) * uniform(random, -1, 1)) *
                                 contact_normal(pair, random) * (random() % 2 == 0 ? 1 : -1);
    const Verdicts verdicts = by_block(pairs, margin, GetParam());
    for (std::size_t i = 0; i < kBlockSize; ++i)
      for (const std::size_t j : {i, (i + 1) % kBlockSize})
        expect_right(
            {pairs[i].triangle, pairs[j].tetrahedron}, verdicts[kBlockSize * i + j],
            [&](const Pair& pair) { return within_margin(pair, margin); }, tally);
  }
  expect_useful(tally);
}

}  // namespace articular::collision::testing::kernel_bounds_test
