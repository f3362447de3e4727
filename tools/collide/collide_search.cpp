#include "tools/collide/collide_search.hpp"

#include <Eigen/Geometry>

#include "collision/article/collide.hpp"
#include "collision/blocks/block_collide.hpp"
#include "sim/base/error.hpp"
#include "sim/base/stopwatch.hpp"

namespace articular::tools {
namespace {

using collision::BlockTree;
using collision::BucketTree;

/// With two nodes exchanged in every inverted tetrahedron. The article's tree wants positive
/// volumes for its mean element; pairs do not depend on the order of nodes.
Tetrahedra positively_oriented(Tetrahedra tets, const Positions& X) {
  for (auto nodes : tets.colwise()) {
    const Vec3 a = X.col(nodes[0]);
    const double six_volume =
        (X.col(nodes[1]) - a).cross(X.col(nodes[2]) - a).dot(X.col(nodes[3]) - a);
    if (six_volume < 0) std::swap(nodes[0], nodes[1]);
  }
  return tets;
}

BlockTree block_tree(const MeshSeries& body) {
  try {
    return BlockTree(body.tets, body.surface, body.frames[0]);
  } catch (const std::invalid_argument& error) {
    throw sim::InputError({body.files[0].string()}, error.what());
  }
}

BucketTree article_tree(const MeshSeries& body) {
  try {
    return BucketTree(positively_oriented(body.tets, body.frames[0]), body.surface, body.frames[0]);
  } catch (const std::invalid_argument& error) {
    throw sim::InputError({body.files[0].string()},
                          std::string(error.what()) + " for --method article");
  }
}

class BlockSearch final : public CollideSearch {
 public:
  BlockSearch(std::span<const MeshSeries> bodies, const SearchSettings& settings)
      : margin_(settings.margin), scratch_(std::make_shared<ThreadPool>(settings.threads)) {
    options_.narrow = settings.narrow;
    for (const MeshSeries& body : bodies) trees_.push_back(block_tree(body));
  }

  void update(std::size_t body, const Positions& x) override { trees_[body].update(x, margin_); }

  void between(FoundPairs& found, SearchCost& cost) override {
    collision::BlockQueryCounts counts;
    for (std::size_t f = 0; f < 2; ++f)
      faces_in_body(trees_[f], trees_[1 - f], found.in[f][1 - f], counts, scratch_, options_);
    add(counts, cost);
  }

  void within(std::size_t body, FoundPairs& found, SearchCost& cost) override {
    collision::BlockQueryCounts counts;
    faces_in_own_body(trees_[body], found.in[body][body], counts, scratch_, options_);
    add(counts, cost);
  }

 private:
  static void add(const collision::BlockQueryCounts& counts, SearchCost& cost) {
    cost.traverse_seconds += counts.traverse_seconds;
    cost.narrow_seconds += counts.narrow_seconds;
    cost.candidates += counts.candidates;
  }

  double margin_;
  collision::BlockQueryOptions options_;
  collision::BlockQueryScratch scratch_;
  std::vector<BlockTree> trees_;
};

class ArticleSearch final : public CollideSearch {
 public:
  ArticleSearch(std::span<const MeshSeries> bodies, const SearchSettings& settings)
      : margin_(settings.margin) {
    for (const MeshSeries& body : bodies) trees_.push_back(article_tree(body));
  }

  void update(std::size_t body, const Positions& x) override { trees_[body].update(x, margin_); }

  void between(FoundPairs& found, SearchCost& cost) override {
    query(cost, [&](collision::QueryCounts& counts) {
      collide(trees_[0], trees_[1], found.in[0][1], found.in[1][0], counts, scratch_);
    });
  }

  void within(std::size_t body, FoundPairs& found, SearchCost& cost) override {
    query(cost, [&](collision::QueryCounts& counts) {
      self_intersections(trees_[body], found.in[body][body], counts, scratch_);
    });
  }

 private:
  template <class Query>
  static void query(SearchCost& cost, Query&& run) {
    collision::QueryCounts counts;
    double seconds = 0;
    {
      const sim::Stopwatch watch(seconds);
      run(counts);
    }
    cost.traverse_seconds += seconds - counts.narrow_seconds;
    cost.narrow_seconds += counts.narrow_seconds;
    cost.candidates += counts.narrow_tests;
  }

  double margin_;
  collision::QueryScratch scratch_;
  std::vector<BucketTree> trees_;
};

}  // namespace

std::unique_ptr<CollideSearch> make_search(std::span<const MeshSeries> bodies,
                                           const SearchSettings& settings) {
  if (settings.article) return std::make_unique<ArticleSearch>(bodies, settings);
  return std::make_unique<BlockSearch>(bodies, settings);
}

}  // namespace articular::tools
