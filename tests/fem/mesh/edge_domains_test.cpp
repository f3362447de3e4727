#include "fem/mesh/edge_domains.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"
#include "tests/fem/support/box_mesh.hpp"

namespace articular::fem::edge_domains_test {

struct Domains {
  TetMesh mesh = box_mesh({2, 2, 3}, Vec3(0.02, 0.02, 0.03), 0.1);
  std::vector<double> volume;
  EdgeDomains domains;

  Domains() {
    std::vector<Mat3> inverse_edges;
    for (Eigen::Index e = 0; e < mesh.tets.cols(); ++e) {
      volume.push_back(checked_volume(mesh.X, mesh.tets, e));
      inverse_edges.push_back(edge_matrix(gather(mesh.X, mesh.tets, e)).inverse());
    }
    domains =
        make_edge_domains(mesh.tets, inverse_edges, volume, std::vector<int>(volume.size(), 0), 1);
  }
};

TEST(EdgeDomains, ShareTheVolumeOfTheBody) {
  const Domains given;
  double sum = 0;
  for (const double volume : given.domains.volume) sum += volume;
  EXPECT_NEAR(sum, 0.02 * 0.02 * 0.03, 1e-12 * sum);
}

// A fibre has no sense: half of the elements may have it the other way round.
TEST(EdgeDomains, MeanOfFibresThatRunAlikeIsTheirDirection) {
  const Domains given;
  const Vec3 along = Vec3(1, -2, 3).normalized();
  FibreDirections fibres(3, given.mesh.tets.cols());
  for (Eigen::Index e = 0; e < fibres.cols(); ++e) fibres.col(e) = (e % 2 == 0 ? 1 : -1) * along;
  const FibreDirections mean = mean_fibres(given.domains, given.volume, fibres);
  for (const auto& fibre : mean.colwise()) EXPECT_NEAR(std::abs(fibre.dot(along)), 1, 1e-14);
}

TEST(EdgeDomains, MeanOfFibresIsAsLongAsTheyAreOnAverage) {
  const Domains given;
  const Vec3 along = Vec3(1, -2, 3).normalized();
  FibreDirections fibres = along.replicate(1, given.mesh.tets.cols());
  for (Eigen::Index e = 0; e < fibres.cols(); ++e)
    fibres.col(e) *= 1 + 0.1 * static_cast<double>(e);
  const FibreDirections mean = mean_fibres(given.domains, given.volume, fibres);
  double of_domains = 0, of_elements = 0;
  for (int k = 0; k < given.domains.size(); ++k)
    of_domains += given.domains.volume[k] * mean.col(k).norm();
  for (Eigen::Index e = 0; e < fibres.cols(); ++e)
    of_elements += given.volume[static_cast<std::size_t>(e)] * fibres.col(e).norm();
  EXPECT_NEAR(of_domains / of_elements, 1, 1e-12);
}

}  // namespace articular::fem::edge_domains_test
