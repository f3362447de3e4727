#include "fem/element/distortion_points.hpp"

#include <Eigen/LU>
#include <cassert>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/mesh/rest_shape.hpp"

namespace articular::fem {
namespace {

/// One point an element, with a share of its volume.
DistortionPoints points_of_elements(const Positions& X, const Tetrahedra& tets,
                                    const std::vector<double>& volume, double share) {
  DistortionPoints points;
  points.node_begin.push_back(0);
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    points.volume.push_back(share * volume[static_cast<std::size_t>(e)]);
    const Mat34 gradients = shape_gradients(edge_matrix(gather(X, tets, e)).inverse());
    for (int a = 0; a < 4; ++a) {
      points.node.push_back(tets(a, e));
      points.gradient.emplace_back(gradients.col(a));
    }
    points.node_begin.push_back(static_cast<int>(points.node.size()));
  }
  return points;
}

}  // namespace

DistortionPoints distortion_points(const Positions& X, const Elasticity& plain) {
  DistortionPoints points = points_of_elements(X, plain.tets(), plain.rest_volume(), 1);
  points.fibres = plain.fibres();
  return points;
}

DistortionPoints distortion_points(const Positions& X, const SmoothedElasticity& smoothed) {
  const double share = smoothed.smoothing().plain_share;
  DistortionPoints points = points_of_elements(X, smoothed.tets(), smoothed.rest_volume(), share);
  const EdgeDomains& domains = smoothed.domains();
  assert(domains.material_begin.size() == 2);
  const int offset = static_cast<int>(points.node.size());
  for (const double volume : domains.volume) points.volume.push_back((1 - share) * volume);
  for (std::size_t k = 1; k < domains.node_begin.size(); ++k)
    points.node_begin.push_back(offset + domains.node_begin[k]);
  points.node.insert(points.node.end(), domains.node.begin(), domains.node.end());
  points.gradient.insert(points.gradient.end(), domains.gradient.begin(), domains.gradient.end());
  const FibreDirections &of_elements = smoothed.fibres(), &of_domains = smoothed.domain_fibres();
  points.fibres.resize(3, of_elements.cols() + of_domains.cols());
  points.fibres << of_elements, of_domains;
  return points;
}

}  // namespace articular::fem
