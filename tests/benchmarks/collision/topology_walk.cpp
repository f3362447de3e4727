// The topological walk from the last frame's pairs beside the block tree.
//
//   build/release/bin/topology_walk
//
// Two V-shapes pushed through each other and one whose legs cross, at 10 000 and 100 000
// tetrahedra a body; positions cycle through frames as in collision_peers. Both go from new
// positions to the pairs and take turns; medians of processor time, one thread. "lost": pairs of
// the tree that the walk does not find, summed over a cycle.

#include <algorithm>
#include <cstdio>
#include <vector>

#include "collision/blocks/block_collide.hpp"
#include "collision/blocks/topology_walk.hpp"
#include "tests/benchmarks/collision/v_shapes.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace {

using namespace articular::benchmarks;
using namespace articular::collision;

constexpr double kMotion = 0.1;  // way of a node from frame to frame at most, in cell edges
constexpr int kRounds = 60;

/// Both directions, or the one of a body with itself.
using Found = std::vector<std::vector<Penetration>>;

class Search {
 public:
  Search(const VShapes& shapes, const std::vector<Positions>& frames)
      : shapes_(shapes), frames_(frames) {
    for (const Mesh& mesh : shapes.bodies()) {
      trees_.emplace_back(mesh.tets, mesh.surface, mesh.X);
      neighbours_.push_back(face_neighbours(mesh.surface));
    }
  }

  void by_tree(std::size_t frame, Found& found) {
    const Positions& x = frames_[frame];
    for (std::size_t k = 0; k < trees_.size(); ++k) trees_[k].update(x[k]);
    BlockQueryCounts counts;
    if (trees_.size() == 1) return faces_in_own_body(trees_[0], found[0], counts, query_);
    faces_in_body(trees_[0], trees_[1], found[0], counts, query_);
    faces_in_body(trees_[1], trees_[0], found[1], counts, query_);
  }

  void by_walk(std::size_t frame, const Found& seeds, Found& found, WalkCounts& counts) {
    const auto body = [&](std::size_t k) {
      return WalkedMesh{shapes_.bodies()[k].at(frames_[frame][k]), neighbours_[k]};
    };
    if (trees_.size() == 1) return walk_own_body(body(0), seeds[0], found[0], walk_[0], counts);
    walk(body(0), body(1), seeds[0], found[0], walk_[0], counts);
    walk(body(1), body(0), seeds[1], found[1], walk_[1], counts);
  }

 private:
  const VShapes& shapes_;
  const std::vector<Positions>& frames_;
  std::vector<BlockTree> trees_;
  std::vector<Eigen::Matrix3Xi> neighbours_;
  BlockQueryScratch query_;
  WalkScratch walk_[2];
};

std::size_t num_lost(Found expected, Found found) {
  std::size_t lost = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    std::sort(expected[k].begin(), expected[k].end());
    std::sort(found[k].begin(), found[k].end());
    std::vector<Penetration> rest;
    std::set_difference(expected[k].begin(), expected[k].end(), found[k].begin(), found[k].end(),
                        std::back_inserter(rest));
    lost += rest.size();
  }
  return lost;
}

void measure(const char* name, const VShapes& shapes, double apart) {
  const std::vector<Positions> frames = oscillation(shapes, apart, kMotion);
  const std::size_t num_frames = frames.size();
  Search search(shapes, frames);
  Found by_tree(shapes.bodies().size()), by_walk(shapes.bodies().size());
  std::vector<Found> of_frame(num_frames, by_tree);
  for (std::size_t frame = 0; frame < num_frames; ++frame) search.by_tree(frame, of_frame[frame]);

  std::vector<double> tree_ms, walk_ms;
  std::size_t pairs = 0, lost = 0;
  WalkCounts counts;
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t frame = 0; frame < num_frames; ++frame) {
      const double start = cpu_seconds();
      search.by_tree(frame, by_tree);
      const double middle = cpu_seconds();
      search.by_walk(frame, of_frame[(frame + num_frames - 1) % num_frames], by_walk, counts);
      tree_ms.push_back(1e3 * (middle - start));
      walk_ms.push_back(1e3 * (cpu_seconds() - middle));
      if (round > 0) continue;
      lost += num_lost(by_tree, by_walk);
      for (const auto& list : by_tree) pairs += list.size();
    }
  const double tree = median(tree_ms), walk = median(walk_ms);
  const double calls = kRounds * static_cast<double>(num_frames);
  std::printf("%s %.1f,%d,%zu,%.3f,%.3f,%.2f,%.0f,%.1f,%zu\n", name, apart, shapes.num_tets(),
              pairs / num_frames, tree, walk, walk / tree,
              static_cast<double>(counts.candidates) / calls,
              static_cast<double>(counts.rounds) / calls, lost);
}

}  // namespace

int main() {
  std::printf("case,tetrahedra,pairs,tree_ms,walk_ms,ratio,walk_candidates,walk_rounds,lost\n");
  for (const int num_tets : {10000, 100000}) {
    const TwoVShapes two(bar_with(num_tets));
    for (const double apart : {0.0, 1.0}) measure("two", two, apart);
    const CrossedVShape crossed(bar_with(num_tets));
    for (const double apart : {-0.6, -0.5}) measure("crossed", crossed, apart);
  }
}
