// How the block tree's queries scale with threads.
//
//   build/release/bin/block_threads [THREADS]...      (default: 1 2)
//
// The V-shapes of collision_peers at 100 000 and 1 000 000 tetrahedra a body. Numbers of threads
// take turns; medians of wall time, which mean something on an idle machine only. The update of the
// trees, which has one thread, is a column of its own.

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "collision/blocks/block_collide.hpp"
#include "tests/benchmarks/collision/v_shapes.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace {

using namespace articular::benchmarks;
using namespace articular::collision;

constexpr double kMotion = 0.1;  // way of a node from frame to frame at most, in cell edges
constexpr int kRounds = 8;       // each is a whole cycle of frames

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  return elapsed.count();
}

void query(const std::vector<BlockTree>& trees, BlockQueryScratch& scratch) {
  static std::vector<Penetration> pairs;
  BlockQueryCounts counts;
  if (trees.size() == 1) return faces_in_own_body(trees[0], pairs, counts, scratch);
  faces_in_body(trees[0], trees[1], pairs, counts, scratch);
  faces_in_body(trees[1], trees[0], pairs, counts, scratch);
}

void measure(const char* name, const VShapes& shapes, double apart,
             const std::vector<int>& numbers_of_threads) {
  std::vector<BlockTree> trees;
  for (const Mesh& mesh : shapes.bodies()) trees.emplace_back(mesh.tets, mesh.surface, mesh.X);
  std::vector<std::vector<double>> milliseconds(numbers_of_threads.size());
  std::vector<double> updates;
  std::vector<BlockQueryScratch> scratch;
  scratch.reserve(numbers_of_threads.size());
  for (const int threads : numbers_of_threads)
    scratch.emplace_back(std::make_shared<articular::ThreadPool>(threads));
  for (int round = 0; round < kRounds; ++round)
    for (const Positions& x : oscillation(shapes, apart, kMotion)) {
      const auto begin = std::chrono::steady_clock::now();
      for (std::size_t k = 0; k < trees.size(); ++k) trees[k].update(x[k]);
      updates.push_back(milliseconds_since(begin));
      for (std::size_t i = 0; i < scratch.size(); ++i) {
        const auto start = std::chrono::steady_clock::now();
        query(trees, scratch[i]);
        milliseconds[i].push_back(milliseconds_since(start));
      }
    }
  std::printf("| %s, %d | %.2f |", name, shapes.num_tets(), median(updates));
  for (const std::vector<double>& times : milliseconds) std::printf(" %.2f |", median(times));
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> numbers_of_threads;
  for (int i = 1; i < argc; ++i) numbers_of_threads.push_back(std::atoi(argv[i]));
  if (numbers_of_threads.empty()) numbers_of_threads = {1, 2};
  for (const int threads : numbers_of_threads)
    if (threads < 1) {
      std::fprintf(stderr, "usage: block_threads [THREADS]...\n");
      return 2;
    }
  std::printf("| [ms] | update | search, threads:");
  for (const int threads : numbers_of_threads) std::printf(" %d |", threads);
  std::printf("\n");
  for (const int num_tets : {100000, 1000000}) {
    measure("V through V", TwoVShapes(bar_with(num_tets)), 1.2, numbers_of_threads);
    measure("V itself", CrossedVShape(bar_with(num_tets)), -0.5, numbers_of_threads);
  }
}
