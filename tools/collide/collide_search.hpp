#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "collision/mesh/penetrations.hpp"
#include "collision/narrow/narrow_rule.hpp"
#include "tools/collide/collide_series.hpp"

/// The ways in which `articular collide` finds pairs.
namespace articular::tools {

struct SearchSettings {
  bool article = false;  // the tree of the article, else blocks
  collision::NarrowTest narrow = collision::NarrowTest::SeparatingAxes;
  int threads = 1;
  double margin = 0;  // [unit of the meshes]
};

/// The pairs of one frame.
struct FoundPairs {
  /// in[f][w]: faces of body f in tetrahedra of body w.
  std::array<std::array<std::vector<collision::Penetration>, 2>, 2> in;
};

/// What queries cost; accumulated.
struct SearchCost {
  double traverse_seconds = 0, narrow_seconds = 0;
  std::int64_t candidates = 0;  // pairs with overlapping boxes that reached the narrow test
};

/// One or two bodies, each in a tree.
class CollideSearch {
 public:
  virtual ~CollideSearch() = default;
  /// @throws std::invalid_argument for positions that no tree can hold
  virtual void update(std::size_t body, const Positions& x) = 0;
  /// Each of the two bodies in the other.
  virtual void between(FoundPairs& found, SearchCost& cost) = 0;
  /// A body with itself.
  virtual void within(std::size_t body, FoundPairs& found, SearchCost& cost) = 0;
};

/// The first frame of a body counts as its rest shape.
/// @throws sim::InputError for a rest shape that the article's tree refuses
std::unique_ptr<CollideSearch> make_search(std::span<const MeshSeries> bodies,
                                           const SearchSettings& settings);

}  // namespace articular::tools
