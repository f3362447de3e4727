// The block tree under input that nobody wants. It equals the rule (narrow_rule.hpp) on every pair,
// whatever the shapes, sizes and places, instruction sets and threads.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "collision/blocks/narrow_list.hpp"
#include "tests/collision/support/hostile_meshes.hpp"
#include "tests/collision/support/rounds.hpp"
#include "tests/collision/support/rule_oracle.hpp"

namespace articular::collision::testing::hostile_test {

constexpr int kTrials = 2;

/// All faces of F against all tetrahedra of W, both bodies the same or not.
void expect_the_rule(const Mesh& F, const Eigen::Matrix3Xd& x_f, const Mesh& W,
                     const Eigen::Matrix3Xd& x_w, double margin, NarrowTest narrow) {
  const bool one_mesh = &F == &W;
  const auto expected = by_rule(F, x_f, W, x_w, margin, narrow, one_mesh);
  const BlockTree own = tree_of(F, x_f, margin), other = tree_of(W, x_w, margin);
  for (const int threads : {1, 3}) {
    const auto pool = std::make_shared<ThreadPool>(threads);
    for (const InstructionSet set : instruction_sets())
      EXPECT_EQ(faces_in(own, one_mesh ? own : other, {narrow, set}, pool).pairs, expected)
          << "instruction set " << static_cast<int>(set) << ", " << threads << " threads";
  }
}

void expect_the_rule(const HostilePair& p, double margin, NarrowTest narrow) {
  SCOPED_TRACE(p.name + ", margin " + std::to_string(margin / p.size) + " of the size");
  expect_the_rule(p.a, p.x_a, p.b, p.x_b, margin, narrow);
  expect_the_rule(p.b, p.x_b, p.a, p.x_a, margin, narrow);
  expect_the_rule(p.a, p.x_a, p.a, p.x_a, margin, narrow);
}

TEST(Hostile, EveryPairIsDecidedAsByTheRule) {
  std::mt19937 random(101);
  for (int trial = 0; trial < kTrials; ++trial)
    for (const HostilePair& pair : hostile_pairs(random))
      expect_the_rule(pair, 0, NarrowTest::SeparatingAxes);
}

TEST(Hostile, EveryPairIsDecidedAsByTheRuleWithAMargin) {
  std::mt19937 random(102);
  for (int trial = 0; trial < kTrials; ++trial)
    for (const HostilePair& pair : hostile_pairs(random))
      for (const double margin : {1e-200, 1e-9, 0.15, 30.0})
        expect_the_rule(pair, margin * pair.size, NarrowTest::SeparatingAxes);
}

// Boxes alone lead to GJK: none may be lost.
TEST(Hostile, EveryPairIsDecidedAsByTheRuleOfGjk) {
  std::mt19937 random(103);
  for (const HostilePair& pair : hostile_pairs(random))
    for (const double margin : {0.0, 0.1})
      expect_the_rule(pair, margin * pair.size, NarrowTest::Gjk);
}

/// Meshes from dice: any nodes to a tetrahedron, coordinates from a list of awkward numbers. Not
/// all have a surface; those are passed over.
TEST(Hostile, FuzzedMeshesAreDecidedAsByTheRule) {
  std::mt19937 random(106);
  const auto dice = [&](std::size_t sides) {
    return std::uniform_int_distribution<std::size_t>(0, sides - 1)(random);
  };
  const std::vector<double> awkward = {0,    0,      1,   -1,   0.5,  1 + 1e-15, 1e-9,
                                       1e-7, 1e-300, 1e9, -1e9, 1e60, 1e-60,     2};
  const auto fuzzed = [&]() -> std::optional<Body> {
    Body body;
    const auto num_nodes = static_cast<Eigen::Index>(4 + dice(20));
    const std::size_t num_choices = 3 + dice(awkward.size() - 2);  // some keep to the tame ones
    body.mesh.X.resize(3, num_nodes);
    for (double& x : body.mesh.X.reshaped())
      x = awkward[dice(num_choices)] + (dice(3) == 0 ? 0.1 * static_cast<double>(dice(9)) : 0);
    body.mesh.tets.resize(4, static_cast<Eigen::Index>(1 + dice(40)));
    std::vector<int> nodes(static_cast<std::size_t>(num_nodes));
    std::iota(nodes.begin(), nodes.end(), 0);
    for (Eigen::Index e = 0; e < body.mesh.tets.cols(); ++e) {
      std::shuffle(nodes.begin(), nodes.end(), random);
      for (std::size_t k = 0; k < 4; ++k) body.mesh.tets(static_cast<int>(k), e) = nodes[k];
    }
    try {
      body.mesh.surface = build_surface(body.mesh.tets, static_cast<int>(num_nodes));
    } catch (const std::invalid_argument&) {
      return {};
    }
    body.x = body.mesh.X;
    return body;
  };
  int num_tested = 0;
  while (num_tested < rounds(64)) {
    const std::optional<Body> a = fuzzed(), b = fuzzed();
    if (!a || !b) continue;
    ++num_tested;
    SCOPED_TRACE(num_tested);
    for (const double margin : {0.0, 1e-12, 0.3}) {
      expect_the_rule(a->mesh, a->x, b->mesh, b->x, margin, NarrowTest::SeparatingAxes);
      expect_the_rule(a->mesh, a->x, a->mesh, a->x, margin, NarrowTest::SeparatingAxes);
    }
  }
}

// The list of a caller's own broad phase, here all pairs.
TEST(Hostile, AListOfPairsIsDecidedAsByTheRule) {
  std::mt19937 random(109);
  for (const HostilePair& p : hostile_pairs(random)) {
    std::vector<Penetration> all, pairs;
    for (int face = 0; face < p.a.surface.faces.cols(); ++face)
      for (int tet = 0; tet < p.b.tets.cols(); ++tet) all.push_back({face, tet});
    const auto expected = by_rule(p.a, p.x_a, p.b, p.x_b, 0, NarrowTest::SeparatingAxes);
    for (const InstructionSet set : instruction_sets()) {
      NarrowListScratch scratch;
      narrow_test(p.a.at(p.x_a), p.b.at(p.x_b), all, pairs, scratch, set);
      std::sort(pairs.begin(), pairs.end());
      EXPECT_EQ(pairs, expected) << p.name;
    }
  }
}

TEST(Hostile, MeshesOfAFewTetrahedra) {
  std::mt19937 random(104);
  for (int num = 1; num <= 17; ++num) {
    const Mesh a = soup(num, 1, random), b = soup(18 - num, 1, random);
    for (const double margin : {0.0, 0.2})
      expect_the_rule({"few", a, b, a.X, b.X, 1}, margin, NarrowTest::SeparatingAxes);
  }
}

TEST(Hostile, AMeshWithoutTetrahedraMeetsNothing) {
  Mesh none;
  none.X.resize(3, 0);
  none.tets.resize(4, 0);
  none.surface = build_surface(none.tets, 0);
  Mesh only_nodes = none;
  only_nodes.X = Eigen::Matrix3Xd::Random(3, 5);
  const Mesh box = box_mesh(2, 2, 2, 1);
  for (const Mesh& mesh : {none, only_nodes}) {
    const BlockTree empty = tree_of(mesh, mesh.X, 0.1), full = tree_of(box, box.X, 0.1);
    EXPECT_TRUE(faces_in(empty, full).pairs.empty());
    EXPECT_TRUE(faces_in(full, empty).pairs.empty());
    EXPECT_TRUE(faces_in(empty, empty).pairs.empty());
    EXPECT_FALSE((empty.bounds().min.array() <= empty.bounds().max.array()).any());
  }
}

TEST(Hostile, ATreeThatWasNeverUpdatedMeetsNothing) {
  const Mesh box = box_mesh(2, 2, 2, 1);
  const BlockTree fresh(box.tets, box.surface, box.X), full = tree_of(box, box.X);
  EXPECT_TRUE(faces_in(fresh, full).pairs.empty());
  EXPECT_TRUE(faces_in(full, fresh).pairs.empty());
  EXPECT_TRUE(faces_in(fresh, fresh).pairs.empty());
}

TEST(Hostile, TreesWithDifferentMarginsAreRefused) {
  const Mesh box = box_mesh(2, 2, 2, 1);
  const BlockTree a = tree_of(box, box.X, 0.1), b = tree_of(box, box.X, 0.2);
  EXPECT_THROW(faces_in(a, b), std::invalid_argument);
}

TEST(Hostile, APositionThatIsNoNumberIsNamedAndLeavesTheTreeAsItWas) {
  std::mt19937 random(105);
  const Mesh a = box_mesh(3, 2, 2, 1), b = box_mesh(2, 2, 3, 1);
  const Eigen::Matrix3Xd x = placed(b.X, Eigen::Vector3d(1, 1, 1), random);
  const BlockTree A = tree_of(a, a.X);
  BlockTree B = tree_of(b, x);
  const Answer before = faces_in(A, B);
  ASSERT_FALSE(before.pairs.empty());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e151}) {
    Eigen::Matrix3Xd broken = x;
    broken(1, 17) = bad;
    try {
      B.update(broken, 0.3);
      FAIL() << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("node 17"), std::string::npos) << error.what();
    }
    EXPECT_THROW(BlockTree(b.tets, b.surface, broken), std::invalid_argument);
  }
  EXPECT_THROW(B.update(x, std::nan("")), std::invalid_argument);
  EXPECT_THROW(B.update(x, -1e-300), std::invalid_argument);
  EXPECT_THROW(B.update(x, kInfinity), std::invalid_argument);
  EXPECT_THROW(B.update(x.leftCols(5)), std::invalid_argument);
  EXPECT_EQ(B.margin(), 0);
  EXPECT_EQ(B.num_updates(), 1);
  EXPECT_EQ(faces_in(A, B).pairs, before.pairs);
}

/// A pair named by nodes: face, then tetrahedron. `name` tells the nodes apart.
std::vector<std::array<int, 7>> by_nodes(const std::vector<Penetration>& pairs, const Mesh& F,
                                         const std::vector<int>& name_f, const Mesh& W,
                                         const std::vector<int>& name_w) {
  std::vector<std::array<int, 7>> named;
  for (const Penetration& pair : pairs) {
    std::array<int, 7> nodes;
    for (std::size_t k = 0; k < 3; ++k)
      nodes[k] = name_f[static_cast<std::size_t>(
          F.surface.faces(static_cast<Eigen::Index>(k), pair.face))];
    for (std::size_t k = 0; k < 4; ++k)
      nodes[3 + k] =
          name_w[static_cast<std::size_t>(W.tets(static_cast<Eigen::Index>(k), pair.tetrahedron))];
    std::sort(nodes.begin(), nodes.begin() + 3);
    std::sort(nodes.begin() + 3, nodes.end());
    named.push_back(nodes);
  }
  std::sort(named.begin(), named.end());
  return named;
}

std::vector<int> ascending(Eigen::Index size) {
  std::vector<int> numbers(static_cast<std::size_t>(size));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// The mesh with its nodes in another order; old_name[new node].
struct Renumbered {
  Mesh mesh;
  Eigen::Matrix3Xd x;
  std::vector<int> old_name;
};

Renumbered renumbered(const Mesh& mesh, const Eigen::Matrix3Xd& x, std::mt19937& random) {
  Renumbered result{mesh, x, ascending(mesh.X.cols())};
  std::shuffle(result.old_name.begin(), result.old_name.end(), random);
  std::vector<int> new_name(result.old_name.size());
  for (std::size_t i = 0; i < new_name.size(); ++i) {
    const int old = result.old_name[i];
    new_name[static_cast<std::size_t>(old)] = static_cast<int>(i);
    result.mesh.X.col(static_cast<Eigen::Index>(i)) = mesh.X.col(old);
    result.x.col(static_cast<Eigen::Index>(i)) = x.col(old);
  }
  for (int& node : result.mesh.tets.reshaped()) node = new_name[static_cast<std::size_t>(node)];
  result.mesh.surface = build_surface(result.mesh.tets, static_cast<int>(mesh.X.cols()));
  return result;
}

TEST(Hostile, NeitherTheOrderOfElementsNorOfNodesMatters) {
  std::mt19937 random(106);
  std::size_t found = 0;
  for (const HostilePair& p : hostile_pairs(random))
    for (const double margin : {0.0, 0.1 * p.size}) {
      SCOPED_TRACE(p.name);
      const BlockTree A = tree_of(p.a, p.x_a, margin), B = tree_of(p.b, p.x_b, margin);
      const std::vector<int> name_a = ascending(p.x_a.cols()), name_b = ascending(p.x_b.cols());
      const auto pairs = by_nodes(faces_in(A, B).pairs, p.a, name_a, p.b, name_b);
      found += pairs.size();
      const Mesh a = shuffled(p.a, random), b = shuffled(p.b, random);
      EXPECT_EQ(by_nodes(faces_in(tree_of(a, p.x_a, margin), tree_of(b, p.x_b, margin)).pairs, a,
                         name_a, b, name_b),
                pairs);
      const Renumbered m = renumbered(p.a, p.x_a, random), n = renumbered(p.b, p.x_b, random);
      EXPECT_EQ(by_nodes(faces_in(tree_of(m.mesh, m.x, margin), tree_of(n.mesh, n.x, margin)).pairs,
                         m.mesh, m.old_name, n.mesh, n.old_name),
                pairs);
    }
  EXPECT_GT(found, 10000u);
}

TEST(Hostile, AnotherUnitOfLengthThatIsAPowerOfTwoChangesNothing) {
  std::mt19937 random(107);
  for (const HostilePair& p : hostile_pairs(random)) {
    const double largest = std::max(p.x_a.cwiseAbs().maxCoeff(), p.x_b.cwiseAbs().maxCoeff());
    for (const double margin : {0.0, 0.1 * p.size}) {
      const auto answer = [&](double unit) {
        return faces_in(tree_of(p.a, unit * p.x_a, unit * margin),
                        tree_of(p.b, unit * p.x_b, unit * margin))
            .pairs;
      };
      const auto pairs = answer(1);
      for (const double unit : {0x1p-460, 0x1p-300, 0x1p-30, 0x1p-1, 0x1p20, 0x1p300, 0x1p460}) {
        if (!(unit * largest < 1e150) || !(unit * p.size > 1e-150)) continue;
        EXPECT_EQ(answer(unit), pairs) << p.name << " in a unit of " << unit;
      }
    }
  }
}

// What a tree and a query hold. A tetrahedron has about 0.2 nodes of its own (24 bytes each), its
// part of the lists and, for each surface face, 9 numbers of 8 bytes.
TEST(Hostile, MemoryIsBounded) {
  for (const int n : {4, 8, 16}) {
    const Mesh mesh = box_mesh(n, n, n, 1);
    const BlockTree tree = tree_of(mesh, mesh.X);
    const auto tets = static_cast<std::size_t>(tree.num_tets()),
               faces = static_cast<std::size_t>(tree.num_faces());
    EXPECT_LT(tree.memory(), 1024 + 40 * tets + 140 * faces) << n;
  }
}

TEST(Hostile, AQueryHoldsAsMuchAsItsAnswerAndOneListOfBlocks) {
  std::mt19937 random(108);
  const Mesh a = box_mesh(8, 8, 8, 1), b = box_mesh(8, 8, 8, 1);
  for (const double shift : {0.0, 4.0, 20.0}) {
    const BlockTree A = tree_of(a, jittered(a.X, 0.1, random)),
                    B = tree_of(b, jittered(b.X.array() + shift, 0.1, random));
    std::vector<Penetration> pairs;
    BlockQueryCounts counts;
    BlockQueryScratch scratch;
    faces_in_body(A, B, pairs, counts, scratch);
    // Worst case of the doubtful and accepted pairs of one block of tetrahedra: all faces.
    const std::size_t worst = 2 * 16 * 4 * static_cast<std::size_t>(A.num_faces() + 16);
    EXPECT_LT(scratch.memory() + pairs.capacity() * sizeof(Penetration),
              worst + 64 * 1024 + A.memory() + 32 * pairs.size())
        << shift;
  }
}

}  // namespace articular::collision::testing::hostile_test
