#include "fem/element/dilatation_means.hpp"

#include <algorithm>
#include <numeric>

namespace articular::fem {
namespace {

std::span<const int> nodes_of(const EdgeDomains& domains, int k) {
  return {&domains.node[domains.node_begin[k]], static_cast<std::size_t>(domains.num_nodes(k))};
}

/// The six domains of an element.
std::span<const int, 6> domains_of(const EdgeDomains& domains, Eigen::Index e) {
  return std::span<const int, 6>(&domains.of_element[6 * static_cast<std::size_t>(e)], 6);
}

}  // namespace

DilatationMeans::DilatationMeans(const Tetrahedra& tets, const EdgeDomains& domains,
                                 const BlockMatrix& K)
    : begin_(static_cast<std::size_t>(domains.size()) + 1), members_(domains.of_element.size()) {
  for (const int k : domains.of_element) ++begin_[k + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (const int k : domains_of(domains, e)) {
      Member& member = members_[next[k]++];
      member.element = static_cast<int>(e);
      const std::span nodes = nodes_of(domains, k);
      for (int a = 0; a < 4; ++a)
        member.node[a] =
            static_cast<int>(std::ranges::lower_bound(nodes, tets(a, e)) - nodes.begin());
    }
  }
  for (int k = 0; k < domains.size(); ++k)
    for (const int row : nodes_of(domains, k))
      for (const int column : nodes_of(domains, k)) slots_.push_back(K.slot(row, column));
}

void DilatationMeans::subtract(const EdgeDomains& domains, std::span<const double> volume,
                               Eigen::VectorXd& dilatation) const {
  mean_.setZero(domains.size());
  for (Eigen::Index e = 0; e < dilatation.size(); ++e)
    for (const int k : domains_of(domains, e))
      mean_[k] += volume[static_cast<std::size_t>(e)] / (6 * domains.volume[k]) * dilatation[e];
  for (Eigen::Index e = 0; e < dilatation.size(); ++e)
    for (const int k : domains_of(domains, e)) dilatation[e] -= mean_[k] / 6;
}

void DilatationMeans::subtract_stiffness(const EdgeDomains& domains, std::span<const Mat34> slope,
                                         std::span<const double> factor, BlockMatrix& K) const {
  const int* slot = slots_.data();
  for (std::size_t m = 0; m < factor.size(); ++m) {
    for (int k = domains.material_begin[m]; k < domains.material_begin[m + 1]; ++k) {
      slope_.assign(static_cast<std::size_t>(domains.num_nodes(k)), Vec3::Zero());
      for (int i = begin_[k]; i < begin_[k + 1]; ++i)
        for (int a = 0; a < 4; ++a)
          slope_[members_[i].node[a]] += slope[members_[i].element].col(a) / 6;
      const double scale = factor[m] / domains.volume[k];
      for (const Vec3& of_row : slope_)
        for (const Vec3& of_column : slope_)
          K.block(*slot++) -= scale * of_row * of_column.transpose();
    }
  }
}

}  // namespace articular::fem
