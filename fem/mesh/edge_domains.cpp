#include "fem/mesh/edge_domains.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cassert>
#include <tuple>
#include <utility>

#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

constexpr std::array<std::pair<int, int>, 6> kEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};  // corners

/// One edge of one element; equal keys are one domain.
struct ElementEdge {
  std::tuple<int, int, int> key;  // material, lower node, higher node
  int element, local;             // local: 0 to 5
};

std::vector<ElementEdge> sorted_edges(const Tetrahedra& tets,
                                      std::span<const int> material_of_element) {
  std::vector<ElementEdge> edges;
  edges.reserve(6 * static_cast<std::size_t>(tets.cols()));
  for (int e = 0; e < static_cast<int>(tets.cols()); ++e) {
    for (int local = 0; local < 6; ++local) {
      const auto [low, high] =
          std::minmax({tets(kEdges[local].first, e), tets(kEdges[local].second, e)});
      edges.push_back({{material_of_element[e], low, high}, e, local});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const ElementEdge& a, const ElementEdge& b) {
    return std::tie(a.key, a.element) < std::tie(b.key, b.element);
  });
  return edges;
}

}  // namespace

EdgeDomains make_edge_domains(const Tetrahedra& tets, std::span<const Mat3> inverse_edges,
                              std::span<const double> volume,
                              std::span<const int> material_of_element, int num_materials) {
  const std::vector<ElementEdge> edges = sorted_edges(tets, material_of_element);
  EdgeDomains domains;
  domains.node_begin.assign(1, 0);
  domains.of_element.resize(edges.size());
  domains.material_begin.assign(static_cast<std::size_t>(num_materials) + 1, 0);

  std::vector<std::pair<int, Vec3>> parts;  // node, V_e/6 ∂N/∂X of one element
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    parts.clear();
    double V = 0;
    for (; last < edges.size() && edges[last].key == edges[first].key; ++last) {
      const int e = edges[last].element;
      const double share = volume[e] / 6;
      V += share;
      const Mat34 dN_dX = shape_gradients(inverse_edges[e]);
      for (int a = 0; a < 4; ++a) parts.emplace_back(tets(a, e), share * dN_dX.col(a));
      domains.of_element[6 * static_cast<std::size_t>(e) + edges[last].local] = domains.size();
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i > 0 && parts[i].first == parts[i - 1].first) {
        domains.gradient.back() += parts[i].second / V;
      } else {
        domains.node.push_back(parts[i].first);
        domains.gradient.emplace_back(parts[i].second / V);
      }
    }
    domains.node_begin.push_back(static_cast<int>(domains.node.size()));
    domains.volume.push_back(V);
    ++domains.material_begin[std::get<0>(edges[first].key) + 1];
  }
  for (int m = 0; m < num_materials; ++m) {
    domains.material_begin[m + 1] += domains.material_begin[m];
  }
  return domains;
}

FibreDirections mean_fibres(const EdgeDomains& domains, std::span<const double> volume,
                            const FibreDirections& fibres) {
  std::vector<Mat3> sum(static_cast<std::size_t>(domains.size()), Mat3::Zero());
  std::vector<double> whole(sum.size(), 0);
  for (std::size_t e = 0; e < volume.size(); ++e) {
    const Vec3 a = fibres.col(static_cast<Eigen::Index>(e));
    for (std::size_t i = 0; i < 6; ++i) {
      const auto k = static_cast<std::size_t>(domains.of_element[6 * e + i]);
      sum[k] += volume[e] / a.norm() * a * a.transpose();
      whole[k] += volume[e];
    }
  }
  FibreDirections mean(3, domains.size());
  for (int k = 0; k < domains.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);  // the trace sums the lengths
    mean.col(k) = sum[i].trace() / whole[i] *
                  Eigen::SelfAdjointEigenSolver<Mat3>(sum[i]).eigenvectors().col(2);
  }
  return mean;
}

}  // namespace articular::fem
