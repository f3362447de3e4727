#include "sim/mesh/mesh_defects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <vector>

#include "sim/base/error.hpp"

namespace articular::sim {

void refuse_far_positions(const std::string& file, const Positions& X) {
  for (Eigen::Index a = 0; a < X.cols(); ++a)
    if (!(X.col(a).lpNorm<Eigen::Infinity>() <= kLargestCoordinate))
      throw InputError({file},
                       fmt::format("point {} (counted from 0) lies at ({:g} {:g} {:g}) m; expected "
                                   "coordinates of at most {:g} m; is the unit right?",
                                   a, X(0, a), X(1, a), X(2, a), kLargestCoordinate));
}

void refuse_repeated_elements(const std::string& file, const Tetrahedra& tets) {
  struct Element {
    std::array<int, 4> nodes;  // sorted
    Eigen::Index number;
  };
  std::vector<Element> elements;
  elements.reserve(static_cast<std::size_t>(tets.cols()));
  for (Eigen::Index t = 0; t < tets.cols(); ++t) {
    Element element{{tets(0, t), tets(1, t), tets(2, t), tets(3, t)}, t};
    std::sort(element.nodes.begin(), element.nodes.end());
    if (std::adjacent_find(element.nodes.begin(), element.nodes.end()) != element.nodes.end())
      throw InputError({file}, fmt::format("tetrahedron {} (counted from 0) has one node twice; "
                                           "expected four different nodes",
                                           t));
    elements.push_back(element);
  }
  std::sort(elements.begin(), elements.end(), [](const Element& p, const Element& q) {
    return std::tie(p.nodes, p.number) < std::tie(q.nodes, q.number);
  });
  const auto twice =
      std::adjacent_find(elements.begin(), elements.end(),
                         [](const Element& p, const Element& q) { return p.nodes == q.nodes; });
  if (twice == elements.end()) return;
  throw InputError({file}, fmt::format("tetrahedra {} and {} (counted from 0) have the same four "
                                       "nodes; expected each element once",
                                       twice->number, std::next(twice)->number));
}

CoincidentNodes coincident_nodes(const Positions& X) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(X.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto position = [&](Eigen::Index i) { return std::array{X(0, i), X(1, i), X(2, i)}; };
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index i, Eigen::Index j) { return position(i) < position(j); });
  CoincidentNodes found;
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (position(order[k]) != position(order[k - 1])) continue;
    if (found.count++ == 0) found.place = X.col(order[k]);
  }
  return found;
}

}  // namespace articular::sim
