#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "collision/blocks/block_tree.hpp"
#include "collision/mesh/penetrations.hpp"
#include "collision/narrow/narrow_rule.hpp"
#include "parallel/thread_pool.hpp"

/// Penetrations between bodies, each in a BlockTree. Update a tree when its body has moved, then
/// query.
namespace articular::collision {

struct BlockQueryOptions {
  NarrowTest narrow = NarrowTest::SeparatingAxes;
  InstructionSet instruction_set = best_instruction_set();
};

/// What queries cost; accumulated.
struct BlockQueryCounts {
  std::int64_t candidates = 0;  // pairs with overlapping boxes that reached the narrow test
  std::int64_t doubtful = 0;    // of these, decided in double precision
  std::int64_t pairs = 0;
  double traverse_seconds = 0;  // wall time down to pairs of blocks
  double narrow_seconds = 0;    // and in the blocks
};

/// Memory and threads of queries. Kept from call to call, queries of one thread do not allocate
/// once the memory has grown.
class BlockQueryScratch {
 public:
  /// @param pool  shared with others who compute at other times; the answer is the same with any
  ///              number of threads, in the same order
  explicit BlockQueryScratch(std::shared_ptr<ThreadPool> pool = std::make_shared<ThreadPool>(1));
  ~BlockQueryScratch();
  BlockQueryScratch(BlockQueryScratch&&) noexcept;
  BlockQueryScratch& operator=(BlockQueryScratch&&) noexcept;
  std::size_t memory() const;  // bytes held
  struct Parts;
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// The pairs (surface face of F, tetrahedron of W) that meet, each once, in no particular order.
/// What meets is decided by elements_meet() (narrow_rule.hpp), with the margin of the trees.
/// @throws std::invalid_argument if the two were updated with different margins, or one was moved
///         and not fitted
void faces_in_body(const BlockTree& F, const BlockTree& W, std::vector<Penetration>& pairs,
                   BlockQueryCounts& counts, BlockQueryScratch& scratch,
                   const BlockQueryOptions& options = {});

/// A body with itself, without the pairs that have a common node (erratum 8).
void faces_in_own_body(const BlockTree& tree, std::vector<Penetration>& pairs,
                       BlockQueryCounts& counts, BlockQueryScratch& scratch,
                       const BlockQueryOptions& options = {});

/// Memory of sort_pairs(), kept from call to call.
struct SortScratch {
  std::vector<std::size_t> begin;
  std::vector<Penetration> sorted;
};

/// By face, then by tetrahedron, in a time linear in pairs and elements: an order that depends on
/// the pairs alone, where that of a query depends on the instruction set.
void sort_pairs(std::vector<Penetration>& pairs, const BlockTree& F, const BlockTree& W,
                SortScratch& scratch);

}  // namespace articular::collision
