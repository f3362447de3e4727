#include "fem/mesh/fibre_field.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/mesh/mesh_parts.hpp"
#include "fem/mesh/tetrahedron.hpp"

namespace articular::fem {
namespace {

/// A gradient vanishes below this part of the mean one across the mesh, 1/(its largest extent).
/// Round-off of the potential puts about 1e-13 there, even in elements a hundred times smaller than
/// the mesh 1e-11.
constexpr double kVanishing = 1e-8;  // [-]

template <class... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

/// ∂N/∂X of element e [1/m] and its volume [m³].
struct Shape {
  Mat34 dN_dX;
  double volume;
};
Shape shape(const Positions& X, const Tetrahedra& tets, Eigen::Index e) {
  Mat34 X_e;
  for (int a = 0; a < 4; ++a) X_e.col(a) = X.col(tets(a, e));
  const Mat3 edges = edge_matrix(X_e);
  const double volume = edges.determinant() / 6;
  if (!(volume > 0)) {
    refuse("tetrahedron ", e, " has a volume of ", volume, " m^3, must be positive");
  }
  return {shape_gradients(edges.inverse()), volume};
}

enum class Role : char { Free, From, To };

std::vector<Role> roles(int num_nodes, std::span<const int> from, std::span<const int> to) {
  std::vector<Role> role(static_cast<std::size_t>(num_nodes), Role::Free);
  const auto mark = [&](std::span<const int> nodes, Role as) {
    for (const int a : nodes) {
      if (a < 0 || a >= num_nodes) refuse("node ", a, " is out of range: there are ", num_nodes);
      if (role[a] != Role::Free && role[a] != as) {
        refuse("node ", a, " is in both sets that fibres run between");
      }
      role[a] = as;
    }
  };
  mark(from, Role::From);
  mark(to, Role::To);
  return role;
}

void check_connected(const Tetrahedra& tets, const std::vector<Role>& role) {
  const std::vector<int> part = parts_of_nodes(static_cast<int>(role.size()), tets);
  std::vector<bool> has_from(role.size()), has_to(role.size());
  for (std::size_t a = 0; a < role.size(); ++a) {
    if (role[a] == Role::From) has_from[part[a]] = true;
    if (role[a] == Role::To) has_to[part[a]] = true;
  }
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const int p = part[tets(0, e)];
    if (!has_from[p] || !has_to[p]) {
      refuse("tetrahedron ", e, " is in a part of the mesh without a node of the ",
             has_from[p] ? "second" : "first", " of the two sets that fibres run between");
    }
  }
}

}  // namespace

FibreDirections constant_fibres(const Vec3& direction, Eigen::Index num_elements) {
  if (!(direction.norm() > 0) || !direction.allFinite()) {
    refuse("direction of fibres is (", direction.transpose(), "), must be finite and not 0");
  }
  return direction.normalized().replicate(1, num_elements);
}

FibreDirections normalized_fibres(const Eigen::Matrix3Xd& directions) {
  FibreDirections fibres(3, directions.cols());
  for (Eigen::Index e = 0; e < directions.cols(); ++e) {
    const Vec3 direction = directions.col(e);
    if (!(direction.norm() > 0) || !direction.allFinite()) {
      refuse("direction of the fibres of tetrahedron ", e, " is (", direction.transpose(),
             "), must be finite and not 0");
    }
    fibres.col(e) = direction.normalized();
  }
  return fibres;
}

FibreDirections moved_fibres(const Positions& X, const Tetrahedra& tets,
                             const FibreDirections& fibres, const Positions& x) {
  FibreDirections moved(3, tets.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    Mat3 rest, now;
    for (int a = 0; a < 3; ++a) {
      rest.col(a) = X.col(tets(a + 1, e)) - X.col(tets(0, e));
      now.col(a) = x.col(tets(a + 1, e)) - x.col(tets(0, e));
    }
    moved.col(e) = (now * rest.inverse() * fibres.col(e)).normalized();
  }
  return moved;
}

Eigen::VectorXd harmonic_potential(const Positions& X, const Tetrahedra& tets,
                                   std::span<const int> from, std::span<const int> to) {
  const int num_nodes = static_cast<int>(X.cols());
  if (tets.size() > 0 && (tets.minCoeff() < 0 || tets.maxCoeff() >= num_nodes)) {
    refuse("a tetrahedron has a node out of range: there are ", num_nodes);
  }
  const std::vector<Role> role = roles(num_nodes, from, to);
  check_connected(tets, role);

  Eigen::VectorXd potential = Eigen::VectorXd::Zero(num_nodes);
  std::vector<int> unknown(role.size(), -1);
  int num_unknowns = 0;
  std::vector<bool> used(role.size());
  for (const int a : tets.reshaped()) used[a] = true;
  for (int a = 0; a < num_nodes; ++a) {
    if (role[a] == Role::To) potential[a] = 1;
    if (role[a] == Role::Free && used[a]) unknown[a] = num_unknowns++;
  }

  // K_ab = Σ V ∂N_a/∂X · ∂N_b/∂X; what known values bring goes to the right-hand side.
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(num_unknowns);
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const auto [dN_dX, volume] = shape(X, tets, e);
    const Eigen::Matrix4d K_e = volume * dN_dX.transpose() * dN_dX;
    for (int i = 0; i < 4; ++i) {
      const int row = unknown[tets(i, e)];
      if (row < 0) continue;
      for (int j = 0; j < 4; ++j) {
        const int column = unknown[tets(j, e)];
        if (column >= 0) {
          entries.emplace_back(row, column, K_e(i, j));
        } else {
          b[row] -= K_e(i, j) * potential[tets(j, e)];
        }
      }
    }
  }
  if (num_unknowns == 0) return potential;
  Eigen::SparseMatrix<double> K(num_unknowns, num_unknowns);
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(K);
  if (factor.info() != Eigen::Success) refuse("the Laplace equation has no solution on this mesh");
  const Eigen::VectorXd solution = factor.solve(b);
  for (int a = 0; a < num_nodes; ++a) {
    if (unknown[a] >= 0) potential[a] = solution[unknown[a]];
  }
  return potential;
}

namespace {

/// ∇φ of each element [1/m].
Eigen::Matrix3Xd harmonic_gradient(const Positions& X, const Tetrahedra& tets,
                                   std::span<const int> from, std::span<const int> to) {
  const Eigen::VectorXd potential = harmonic_potential(X, tets, from, to);
  const double extent = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).maxCoeff();
  Eigen::Matrix3Xd gradients(3, tets.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    Eigen::Vector4d potential_e;
    for (int a = 0; a < 4; ++a) potential_e[a] = potential[tets(a, e)];
    const Vec3 gradient = shape(X, tets, e).dN_dX * potential_e;
    if (!(gradient.norm() * extent > kVanishing)) {
      refuse("the gradient that fibres follow vanishes in tetrahedron ", e, " (nodes ",
             tets.col(e).transpose(), "): it is ", gradient.norm(), " 1/m, must be above ",
             kVanishing / extent, " 1/m");
    }
    gradients.col(e) = gradient;
  }
  return gradients;
}

}  // namespace

FibreDirections harmonic_fibres(const Positions& X, const Tetrahedra& tets,
                                std::span<const int> from, std::span<const int> to) {
  return harmonic_gradient(X, tets, from, to).colwise().normalized();
}

FibreDirections conserved_fibres(const Positions& X, const Tetrahedra& tets,
                                 std::span<const int> from, std::span<const int> to) {
  const Eigen::Matrix3Xd gradients = harmonic_gradient(X, tets, from, to);
  double volume = 0, flux = 0;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const double volume_e = shape(X, tets, e).volume;
    volume += volume_e;
    flux += volume_e * gradients.col(e).norm();
  }
  return gradients * (volume / flux);
}

double loose_flux(const Positions& X, const Tetrahedra& tets, const FibreDirections& fibres,
                  const std::vector<bool>& held) {
  Eigen::VectorXd ends = Eigen::VectorXd::Zero(X.cols());
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    const auto [dN_dX, volume] = shape(X, tets, e);
    const Eigen::Vector4d ends_e = volume * dN_dX.transpose() * fibres.col(e);
    for (int a = 0; a < 4; ++a) ends[tets(a, e)] += ends_e[a];
  }
  double loose = 0, at_held = 0;
  for (std::size_t a = 0; a < held.size(); ++a)
    (held[a] ? at_held : loose) += std::abs(ends[static_cast<Eigen::Index>(a)]);
  return loose / at_held;
}

}  // namespace articular::fem
