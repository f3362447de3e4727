// The block tree of collision/.
#include "collision/blocks/block_collide.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

using namespace collision;

class Blocks final : public Peer {
 public:
  explicit Blocks(std::span<const MeshView> bodies) {
    for (const MeshView& body : bodies) trees_.emplace_back(body.tets, body.surface, body.x);
  }

  void query(std::span<const MeshView> bodies, Found& found) override {
    counts_ = {};
    for (std::size_t k = 0; k < trees_.size(); ++k) trees_[k].update(bodies[k].x);
    if (trees_.size() == 1) {
      faces_in_own_body(trees_[0], found[0], counts_, scratch_);
      return;
    }
    faces_in_body(trees_[0], trees_[1], found[0], counts_, scratch_);
    faces_in_body(trees_[1], trees_[0], found[1], counts_, scratch_);
  }
  double narrow_seconds() const override { return counts_.narrow_seconds; }

 private:
  std::vector<BlockTree> trees_;
  BlockQueryCounts counts_;
  BlockQueryScratch scratch_;
};

}  // namespace

std::unique_ptr<Peer> block_tree_peer(std::span<const MeshView> bodies) {
  return std::make_unique<Blocks>(bodies);
}

}  // namespace articular::benchmarks
