#include "fem/sparse/pressure_gradient.hpp"

#include <algorithm>
#include <cassert>

namespace articular::fem {

PressureGradient::PressureGradient(int num_nodes, int num_pressures, std::span<const int> nodes,
                                   std::span<const int> node_begin, std::span<const int> pressures,
                                   std::span<const int> pressure_begin)
    : num_pressures_(num_pressures) {
  assert(node_begin.size() == pressure_begin.size());
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(num_nodes));
  for (std::size_t k = 0; k + 1 < node_begin.size(); ++k) {
    for (int i = node_begin[k]; i < node_begin[k + 1]; ++i) {
      assert(nodes[i] >= 0 && nodes[i] < num_nodes);
      columns[nodes[i]].insert(columns[nodes[i]].end(), pressures.begin() + pressure_begin[k],
                               pressures.begin() + pressure_begin[k + 1]);
    }
  }
  for (std::vector<int>& row : columns) {
    std::sort(row.begin(), row.end());
    column_.insert(column_.end(), row.begin(), std::unique(row.begin(), row.end()));
    row_begin_.push_back(static_cast<int>(column_.size()));
  }
  assert(std::all_of(column_.begin(), column_.end(),
                     [&](int q) { return q >= 0 && q < num_pressures; }));
  values_.assign(column_.size(), Vec3::Zero());
}

int PressureGradient::slot(int node, int pressure) const {
  const auto begin = column_.begin() + row_begin_[node],
             end = column_.begin() + row_begin_[node + 1];
  const auto found = std::lower_bound(begin, end, pressure);
  return found != end && *found == pressure ? static_cast<int>(found - column_.begin()) : -1;
}

void PressureGradient::set_zero() { std::fill(values_.begin(), values_.end(), Vec3::Zero()); }

void PressureGradient::set_row_zero(int node) {
  std::fill(values_.begin() + row_begin_[node], values_.begin() + row_begin_[node + 1],
            Vec3::Zero());
}

void PressureGradient::add_product(const Eigen::VectorXd& p, double scale,
                                   Eigen::VectorXd& f) const {
  assert(p.size() == num_pressures_ && f.size() == 3 * Eigen::Index{num_nodes()});
  for (int i = 0; i < num_nodes(); ++i) {
    Vec3 sum = Vec3::Zero();
    for (int s = row_begin_[i]; s < row_begin_[i + 1]; ++s) sum += values_[s] * p[column_[s]];
    f.segment<3>(3 * Eigen::Index{i}) += scale * sum;
  }
}

void PressureGradient::multiply_transposed(const Eigen::VectorXd& u, Eigen::VectorXd& b) const {
  assert(u.size() == 3 * Eigen::Index{num_nodes()});
  b.setZero(num_pressures_);
  for (int i = 0; i < num_nodes(); ++i) {
    const Vec3 u_i = u.segment<3>(3 * Eigen::Index{i});
    for (int s = row_begin_[i]; s < row_begin_[i + 1]; ++s) b[column_[s]] += values_[s].dot(u_i);
  }
}

}  // namespace articular::fem
