#include "sim/contact/penetration_search.hpp"

#include <utility>

#include "collision/article/collide.hpp"
#include "collision/blocks/block_collide.hpp"

namespace articular::sim {
namespace {

using collision::BlockTree;
using collision::BucketTree;

class BlockSearch final : public PenetrationSearch {
 public:
  BlockSearch(const std::vector<const Collider*>& bodies, std::shared_ptr<ThreadPool> pool)
      : scratch_(std::move(pool)) {
    trees_.reserve(bodies.size());
    for (const Collider* body : bodies) trees_.emplace_back(body->tets, body->surface, body->X);
  }

  void move(std::size_t body, const Positions& x, double margin) override {
    trees_[body].move(x, margin);
  }
  bool fit(std::size_t body) override {
    if (trees_[body].is_fitted()) return false;
    trees_[body].fit();
    return true;
  }
  const collision::Aabb& bounds(std::size_t body) const override { return trees_[body].bounds(); }
  void between(std::size_t a, std::size_t b, Penetrations& a_in_b, Penetrations& b_in_a,
               PenetrationCost& cost) override {
    find(trees_[a], trees_[b], a_in_b, cost);
    find(trees_[b], trees_[a], b_in_a, cost);
    sort_pairs(a_in_b, trees_[a], trees_[b], sort_scratch_);
    sort_pairs(b_in_a, trees_[b], trees_[a], sort_scratch_);
  }
  void within(std::size_t body, Penetrations& found, PenetrationCost& cost) override {
    collision::BlockQueryCounts counts;
    faces_in_own_body(trees_[body], found, counts, scratch_, options_);
    add(counts, cost);
    sort_pairs(found, trees_[body], trees_[body], sort_scratch_);
  }

 private:
  void find(const BlockTree& F, const BlockTree& W, Penetrations& found, PenetrationCost& cost) {
    collision::BlockQueryCounts counts;
    faces_in_body(F, W, found, counts, scratch_, options_);
    add(counts, cost);
  }
  static void add(const collision::BlockQueryCounts& counts, PenetrationCost& cost) {
    cost.narrow_tests += counts.candidates;
    cost.pairs += counts.pairs;
    cost.narrow_seconds += counts.narrow_seconds;
  }

  std::vector<BlockTree> trees_;
  collision::BlockQueryOptions options_;
  collision::BlockQueryScratch scratch_;
  collision::SortScratch sort_scratch_;
};

/// Listing 1.5.1 as the article has it: each body's tetrahedra are dropped into its buckets anew at
/// every update.
class BucketSearch final : public PenetrationSearch {
 public:
  explicit BucketSearch(const std::vector<const Collider*>& bodies) : is_fit_(bodies.size(), 0) {
    options_.rule = collision::NarrowTest::SeparatingAxes;  // that of the block tree
    trees_.reserve(bodies.size());
    for (const Collider* body : bodies) trees_.emplace_back(body->tets, body->surface, body->X);
  }

  void move(std::size_t body, const Positions& x, double margin) override {
    trees_[body].update(x, margin);
    is_fit_[body] = 0;
  }
  bool fit(std::size_t body) override { return std::exchange(is_fit_[body], 1) == 0; }
  const collision::Aabb& bounds(std::size_t body) const override { return trees_[body].bounds(); }
  void between(std::size_t a, std::size_t b, Penetrations& a_in_b, Penetrations& b_in_a,
               PenetrationCost& cost) override {
    collision::QueryCounts counts;
    collide(trees_[a], trees_[b], a_in_b, b_in_a, counts, scratch_, options_);
    add(counts, cost);
  }
  void within(std::size_t body, Penetrations& found, PenetrationCost& cost) override {
    collision::QueryCounts counts;
    self_intersections(trees_[body], found, counts, scratch_, options_);
    add(counts, cost);
  }

 private:
  static void add(const collision::QueryCounts& counts, PenetrationCost& cost) {
    cost.narrow_tests += counts.narrow_tests;
    cost.pairs += counts.reported;
    cost.narrow_seconds += counts.narrow_seconds;
  }

  std::vector<BucketTree> trees_;
  std::vector<char> is_fit_;
  collision::QueryOptions options_;
  collision::QueryScratch scratch_;
};

}  // namespace

std::unique_ptr<PenetrationSearch> make_penetration_search(
    const std::vector<const Collider*>& bodies, Detection::Tree tree,
    std::shared_ptr<ThreadPool> pool) {
  if (tree == Detection::Tree::Buckets) return std::make_unique<BucketSearch>(bodies);
  return std::make_unique<BlockSearch>(bodies, std::move(pool));
}

}  // namespace articular::sim
