// The article's algorithm as collide() in collision/ has it, with its own narrow test.
#include "collision/article/collide.hpp"
#include "collision/article/self_intersection.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

class Article final : public Peer {
 public:
  explicit Article(std::span<const MeshView> bodies) {
    for (const MeshView& body : bodies) trees_.emplace_back(body.tets, body.surface, body.x);
  }

  void query(std::span<const MeshView> bodies, Found& found) override {
    counts_ = {};
    if (bodies.size() == 1) {
      update_and_find_self_intersections(trees_[0], bodies[0].x, 0, found[0], counts_, scratch_);
      return;
    }
    for (std::size_t k = 0; k < 2; ++k) trees_[k].update(bodies[k].x);
    collide(trees_[0], trees_[1], found[0], found[1], counts_, scratch_);
  }
  double narrow_seconds() const override { return counts_.narrow_seconds; }

 private:
  std::vector<collision::BucketTree> trees_;
  collision::QueryCounts counts_;
  collision::QueryScratch scratch_;
};

}  // namespace

std::unique_ptr<Peer> article_peer(std::span<const MeshView> bodies) {
  return std::make_unique<Article>(bodies);
}

}  // namespace articular::benchmarks
