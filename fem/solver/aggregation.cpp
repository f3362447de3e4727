#include "fem/solver/aggregation.hpp"

#include <cassert>

namespace articular::fem {
namespace {

constexpr int kFree = -1;      // not in a group yet
constexpr int kLeftOut = -2;   // in none for good
constexpr float kWeak = 0.1F;  // sum of squared weights: Jacobi alone reduces such an error well

class Grouping {
 public:
  Grouping(const CouplingGraph& graph, float threshold, std::span<const char> alone)
      : graph_(graph), threshold_(threshold), group_(graph.num_nodes(), kFree) {
    assert(alone.empty() || static_cast<int>(alone.size()) == graph.num_nodes());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      if (alone[i]) group_[i] = num_groups_++;
    }
    first_shared_ = num_groups_;
  }

  /// A node none of whose strong neighbours is taken, and all of these.
  void start_groups() {
    for (int i = 0; i < graph_.num_nodes(); ++i) {
      if (group_[i] != kFree) continue;
      bool has_neighbours = false, all_free = true;
      for_strong(i, [&](int j, float) {
        has_neighbours = true;
        all_free = all_free && group_[j] == kFree;
      });
      if (!has_neighbours || !all_free) continue;
      for_strong(i, [&](int j, float) { group_[j] = num_groups_; });
      group_[i] = num_groups_++;
    }
  }

  /// Nodes beside the groups of the first pass join the one they are most strongly coupled to.
  void join_groups() {
    const std::vector<int> before = group_;
    for (int i = 0; i < graph_.num_nodes(); ++i) {
      if (before[i] != kFree) continue;
      float strongest = 0;
      for_strong(i, [&](int j, float weight) {
        if (before[j] < first_shared_ || weight <= strongest) return;
        strongest = weight;
        group_[i] = before[j];
      });
    }
  }

  void group_the_rest() {
    for (int i = 0; i < graph_.num_nodes(); ++i) {
      if (group_[i] != kFree) continue;
      float sum = 0;
      for (int k = graph_.row_begin[i]; k < graph_.row_begin[i + 1]; ++k) {
        sum += graph_.weight[k] * graph_.weight[k];
      }
      if (sum < kWeak) {
        group_[i] = kLeftOut;
        continue;
      }
      group_[i] = num_groups_;
      for_strong(i, [&](int j, float) {
        if (group_[j] == kFree) group_[j] = num_groups_;
      });
      ++num_groups_;
    }
  }

  Aggregation take() {
    for (int& group : group_) {
      if (group == kLeftOut) group = -1;
    }
    return {num_groups_, std::move(group_)};
  }

 private:
  template <class Function>
  void for_strong(int i, Function function) const {
    for (int k = graph_.row_begin[i]; k < graph_.row_begin[i + 1]; ++k) {
      const int j = graph_.column[k];
      const bool alone = group_[j] >= 0 && group_[j] < first_shared_;
      if (graph_.weight[k] > threshold_ && !alone) function(j, graph_.weight[k]);
    }
  }

  const CouplingGraph& graph_;
  float threshold_;
  int num_groups_ = 0, first_shared_ = 0;
  std::vector<int> group_;
};

}  // namespace

Aggregation aggregate(const CouplingGraph& graph, float threshold, std::span<const char> alone) {
  Grouping grouping(graph, threshold, alone);
  grouping.start_groups();
  grouping.join_groups();
  grouping.group_the_rest();
  return grouping.take();
}

}  // namespace articular::fem
