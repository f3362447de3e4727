// The dynamic AABB tree of the Flexible Collision Library: its nodes, its refit and its order of
// descent, without the 500 bytes of CollisionObject that its manager wants for every box.
#include <fcl/broadphase/detail/hierarchy_tree.h>
#include <fcl/math/bv/AABB.h>

#include <cstdint>

#include "tests/benchmarks/collision/element_boxes.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

using Tree = fcl::detail::HierarchyTree<fcl::AABBd>;
using Node = Tree::NodeType;

fcl::AABBd fcl_box(const Box& box) {
  fcl::AABBd result;
  result.min_ = box.min.head<3>().cast<double>();
  result.max_ = box.max.head<3>().cast<double>();
  return result;
}

int element_of(const Node* leaf) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(leaf->data));
}

class BoxTree {
 public:
  void update(const std::vector<Box>& boxes) {
    if (leaves_.empty()) {
      build(boxes);
      return;
    }
    for (std::size_t i = 0; i < leaves_.size(); ++i) leaves_[i]->bv = fcl_box(boxes[i]);
    tree_.refit();
  }
  Node* root() const { return tree_.getRoot(); }

 private:
  void build(const std::vector<Box>& boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      Node* leaf = new Node;  // the tree deletes it
      leaf->bv = fcl_box(boxes[i]);
      leaf->parent = nullptr;
      leaf->children[1] = nullptr;
      leaf->data = reinterpret_cast<void*>(static_cast<std::intptr_t>(i));
      leaves_.push_back(leaf);
    }
    std::vector<Node*> order = leaves_;  // init() shuffles it
    tree_.init(order, 0);                // 0: top down, the manager's default
  }

  Tree tree_;
  std::vector<Node*> leaves_;
};

/// As FCL's collisionRecurse: the larger of two nodes is opened.
void descend(const Node* a, const Node* b, Candidates& candidates) {
  if (!a->bv.overlap(b->bv)) return;
  if (a->isLeaf() && b->isLeaf()) {
    candidates.add(element_of(a), element_of(b));
  } else if (b->isLeaf() || (!a->isLeaf() && a->bv.size() > b->bv.size())) {
    descend(a->children[0], b, candidates);
    descend(a->children[1], b, candidates);
  } else {
    descend(a, b->children[0], candidates);
    descend(a, b->children[1], candidates);
  }
}

class Fcl final : public BroadPhase {
 public:
  void update(std::span<const MeshView> bodies) override {
    bodies_.resize(bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      if (!bodies_[k]) bodies_[k] = std::make_unique<Body>();
      bodies_[k]->boxes.update(bodies[k]);
      bodies_[k]->faces.update(bodies_[k]->boxes.faces);
      bodies_[k]->tets.update(bodies_[k]->boxes.tets);
    }
  }

  void find(std::size_t faces_of, std::size_t tets_of, Candidates& candidates) override {
    descend(bodies_[faces_of]->faces.root(), bodies_[tets_of]->tets.root(), candidates);
  }

 private:
  struct Body {
    ElementBoxes boxes;
    BoxTree faces, tets;
  };
  std::vector<std::unique_ptr<Body>> bodies_;  // FCL's tree cannot be moved
};

}  // namespace

std::unique_ptr<BroadPhase> fcl_refitted() { return std::make_unique<Fcl>(); }

}  // namespace articular::benchmarks
