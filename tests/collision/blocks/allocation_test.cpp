// Counts operator new in the whole test program.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "collision/article/self_intersection.hpp"
#include "collision/blocks/block_collide.hpp"
#include "tests/collision/support/meshes.hpp"

namespace {
std::atomic<std::int64_t> num_allocations = 0;
}

// Not inlined: GCC would see malloc() meet delete, or new meet free(), and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++num_allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace articular::collision::testing::allocation_test {

TEST(Allocation, UpdatesAndQueriesDoNotAllocateOnceTheirMemoryHasGrown) {
  std::mt19937 random(70);
  const Mesh a = box_mesh(10, 4, 4, 1e-3), b = box_mesh(8, 5, 3, 1e-3);
  for (Mapping mapping : {Mapping::Direct, Mapping::CoordinateSorting}) {
    const BucketTreeOptions options{.bucket_ratio = 1, .fixed_root = {}, .mapping = mapping};
    BucketTree A(a.tets, a.surface, a.X, options), B(b.tets, b.surface, b.X, options);
    std::vector<Eigen::Matrix3Xd> x, y;
    for (int step = 0; step < 4; ++step) {
      x.push_back(jittered(bend_to_v(a, -0.1 * step), 0.1e-3, random));
      y.push_back(placed(b.X, x.back().rowwise().mean(), random));
    }
    Pairs pairs;
    std::vector<Penetration> self;
    QueryCounts counts;
    QueryScratch scratch;
    const auto all_steps = [&] {
      for (std::size_t step = 0; step < x.size(); ++step) {
        A.update(x[step]);
        B.update(y[step]);
        collide(A, B, pairs.a_in_b, pairs.b_in_a, counts, scratch);
        self_intersections(A, self, counts, scratch);
        update_and_find_self_intersections(B, y[step], 0, self, counts, scratch);
      }
    };
    all_steps();
    const std::int64_t before = num_allocations, reported = counts.reported;
    all_steps();
    EXPECT_EQ(num_allocations - before, 0);
    EXPECT_GT(reported, 1000);
  }
}

TEST(Allocation, BlockTreesDoNotAllocateOnceTheMemoryOfTheirQueriesHasGrown) {
  std::mt19937 random(71);
  // Trees of different depth take turns with one scratch, as in a simulation.
  const Mesh deep = box_mesh(12, 8, 8, 1e-3), flat = box_mesh(2, 2, 1, 3e-3);
  BlockTree A(deep.tets, deep.surface, deep.X), B(flat.tets, flat.surface, flat.X);
  const Eigen::Matrix3Xd x = jittered(deep.X, 0.1e-3, random);
  const Eigen::Matrix3Xd y = placed(flat.X, x.rowwise().mean(), random);
  std::vector<Penetration> a_in_b, b_in_a, self;
  BlockQueryCounts counts;
  BlockQueryScratch scratch;
  SortScratch sort_scratch;
  const auto step = [&] {
    A.update(x);
    B.update(y);
    faces_in_body(A, B, a_in_b, counts, scratch);
    faces_in_body(B, A, b_in_a, counts, scratch);
    faces_in_own_body(A, self, counts, scratch);
    sort_pairs(b_in_a, B, A, sort_scratch);
  };
  for (int round = 0; round < 4; ++round) step();  // lists change places with the caller's
  const std::int64_t before = num_allocations;
  step();
  EXPECT_EQ(num_allocations - before, 0);
  EXPECT_GT(b_in_a.size(), 100u);
}

}  // namespace articular::collision::testing::allocation_test
