#include "tests/benchmarks/fem/domain_elasticity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "fem/mesh/rest_shape.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

using Groups = std::vector<std::vector<int>>;  // elements of each domain

/// Domains of groups of elements, each of which gives 1/num_shares of its volume to each of its
/// groups.
EdgeDomains group_domains(const TetMesh& mesh, const Groups& groups, int num_shares) {
  EdgeDomains domains;
  domains.node_begin.assign(1, 0);
  for (const std::vector<int>& group : groups) {
    std::map<int, Vec3> gradient;
    double V = 0;
    for (const int e : group) {
      const Mat34 X = gather(mesh.X, mesh.tets, e);
      const double share = checked_volume(mesh.X, mesh.tets, e) / num_shares;
      const Mat34 dN_dX = shape_gradients(edge_matrix(X).inverse());
      V += share;
      for (int a = 0; a < 4; ++a) {
        const auto entry = gradient.try_emplace(mesh.tets(a, e), Vec3::Zero()).first;
        entry->second += share * dN_dX.col(a);
      }
    }
    for (const auto& [node, sum] : gradient) {
      domains.node.push_back(node);
      domains.gradient.emplace_back(sum / V);
    }
    domains.node_begin.push_back(static_cast<int>(domains.node.size()));
    domains.volume.push_back(V);
  }
  return domains;
}

/// Groups of elements around the parts of `size` nodes that each has, or the elements alone (4).
Groups groups_around(const Tetrahedra& tets, int size) {
  std::map<std::vector<int>, std::vector<int>> around;
  for (int e = 0; e < static_cast<int>(tets.cols()); ++e) {
    for (int chosen = 1; chosen < 16; ++chosen) {
      std::vector<int> part;
      for (int a = 0; a < 4; ++a) {
        if ((chosen >> a & 1) != 0) part.push_back(tets(a, e));
      }
      if (static_cast<int>(part.size()) != size) continue;
      std::sort(part.begin(), part.end());
      around[part].push_back(e);
    }
  }
  Groups groups;
  for (const auto& [part, elements] : around) groups.push_back(elements);
  return groups;
}

/// Domains that have an element in common; for elements, a face.
Groups neighbours_of(const Groups& domains, const Groups& sets, std::size_t num_elements) {
  Groups of_element(num_elements);
  for (std::size_t k = 0; k < domains.size(); ++k) {
    for (const int e : domains[k]) of_element[e].push_back(static_cast<int>(k));
  }
  std::vector<std::set<int>> neighbours(domains.size());
  for (const std::vector<int>& set : sets) {
    for (const int e : set) {
      for (const int other : set) {
        for (const int k : of_element[e]) {
          neighbours[k].insert(of_element[other].begin(), of_element[other].end());
        }
      }
    }
  }
  Groups result;
  for (std::size_t k = 0; k < domains.size(); ++k) {
    neighbours[k].erase(static_cast<int>(k));
    result.emplace_back(neighbours[k].begin(), neighbours[k].end());
  }
  return result;
}

}  // namespace

DomainElasticity::DomainElasticity(const TetMesh& mesh, Domains domains,
                                   const MooneyRivlin<>& material)
    : num_nodes_(static_cast<int>(mesh.X.cols())), material_(material) {
  const int size = domains == Domains::Elements ? 4 : domains == Domains::Edges ? 2 : 1;
  const int num_shares = domains == Domains::Elements ? 1 : domains == Domains::Edges ? 6 : 4;
  const Groups groups = groups_around(mesh.tets, size);
  domains_ = group_domains(mesh, groups, num_shares);
  neighbours_ = neighbours_of(groups, groups_around(mesh.tets, size == 4 ? 3 : 4),
                              static_cast<std::size_t>(mesh.tets.cols()));
}

template <class Function>
void DomainElasticity::for_each_domain(const Positions& x, Function function) const {
  for (int k = 0; k < domains_.size(); ++k) {
    const Vec3 origin = x.col(domains_.node[domains_.node_begin[k]]);
    Mat3 F = Mat3::Zero();
    for (int i = domains_.node_begin[k]; i < domains_.node_begin[k + 1]; ++i) {
      F += (x.col(domains_.node[i]) - origin) * domains_.gradient[i].transpose();
    }
    function(k, F);
  }
}

double DomainElasticity::energy(const Positions& x) const {
  double W = 0;
  for_each_domain(
      x, [&](int k, const Mat3& F) { W += domains_.volume[k] * material_.energy_density(F); });
  return W;
}

void DomainElasticity::add_internal_force(const Positions& x, Positions& f) const {
  for_each_domain(x, [&](int k, const Mat3& F) {
    const Mat3 P = domains_.volume[k] * material_.first_piola(F);
    for (int i = domains_.node_begin[k]; i < domains_.node_begin[k + 1]; ++i) {
      f.col(domains_.node[i]) += P * domains_.gradient[i];
    }
  });
}

void DomainElasticity::add_stiffness(const Positions& x, Tangent tangent, BlockMatrix& K) const {
  for_each_domain(x, [&](int k, const Mat3& F) {
    const Mat9 C =
        tangent == Tangent::Projected ? projected_tangent(material_, F) : material_.tangent(F);
    for (int j = domains_.node_begin[k]; j < domains_.node_begin[k + 1]; ++j) {
      const Vec3 g = domains_.volume[k] * domains_.gradient[j];
      const Eigen::Matrix<double, 9, 3> CB =
          C.middleCols<3>(0) * g[0] + C.middleCols<3>(3) * g[1] + C.middleCols<3>(6) * g[2];
      for (int i = domains_.node_begin[k]; i < domains_.node_begin[k + 1]; ++i) {
        const Vec3& h = domains_.gradient[i];
        K.block(K.slot(domains_.node[i], domains_.node[j])) +=
            CB.middleRows<3>(0) * h[0] + CB.middleRows<3>(3) * h[1] + CB.middleRows<3>(6) * h[2];
      }
    }
  });
}

Formulation DomainElasticity::formulation() const {
  return {
      .energy = [this](const Positions& x, const Eigen::VectorXd&) { return energy(x); },
      .add_internal_force = [this](const Positions& x, Positions& f) { add_internal_force(x, f); },
      .make_matrix = [this] { return BlockMatrix(num_nodes_, domains_.node, domains_.node_begin); },
      .add_stiffness = [this](const Positions& x, const Eigen::VectorXd&, Tangent tangent,
                              BlockMatrix& K) { add_stiffness(x, tangent, K); }};
}

Eigen::VectorXd DomainElasticity::pressure(const Positions& x) const {
  Eigen::VectorXd p(domains_.size());
  for_each_domain(
      x, [&](int k, const Mat3& F) { p[k] = material_.bulk_modulus() * VolumeChange::value(F); });
  return p;
}

double roughness(const Eigen::VectorXd& p, const std::vector<std::vector<int>>& neighbours) {
  double sum = 0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    double mean = 0;
    for (const int j : neighbours[i]) mean += p[j] / static_cast<double>(neighbours[i].size());
    const double difference = p[static_cast<Eigen::Index>(i)] - mean;
    sum += difference * difference;
  }
  return std::sqrt(sum) / p.norm();
}

std::vector<std::vector<int>> node_neighbours(const BlockMatrix& plain) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(plain.num_blocks()));
  for (int i = 0; i < plain.num_blocks(); ++i) {
    for (int s = plain.row_begin()[i]; s < plain.row_begin()[i + 1]; ++s) {
      if (plain.column()[s] != i) neighbours[i].push_back(plain.column()[s]);
    }
  }
  return neighbours;
}

}  // namespace articular::fem
