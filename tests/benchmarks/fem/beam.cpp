#include "tests/benchmarks/fem/beam.hpp"

#include <malloc.h>

#include <algorithm>
#include <stdexcept>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace articular::benchmarks {
namespace {

const Vec3 kSize(1, 0.2, 0.2);      // [m]
constexpr double kDensity = 1000;   // [kg/m³]
constexpr double kGravity = -9.81;  // in y [m/s²]
constexpr double kTimeStep = 0.01;  // [s]

double allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

std::vector<int> number_free_nodes(const Positions& X) {
  std::vector<int> block_of_node;
  int next = 0;
  for (Eigen::Index a = 0; a < X.cols(); ++a) block_of_node.push_back(X(0, a) > 0 ? next++ : -1);
  return block_of_node;
}

fem::BlockMatrix matrix_without_clamped_nodes(const Tetrahedra& tets,
                                              const std::vector<int>& block_of_node) {
  std::vector<int> stencils, offsets{0};
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (const int node : tets.col(e)) {
      const int block = block_of_node[static_cast<std::size_t>(node)];
      if (block >= 0) stencils.push_back(block);
    }
    offsets.push_back(static_cast<int>(stencils.size()));
  }
  return {*std::max_element(block_of_node.begin(), block_of_node.end()) + 1, stencils, offsets};
}

}  // namespace

Beam::Beam(const std::array<int, 3>& cells)
    : mesh_(fem::box_mesh(cells, kSize)),
      block_of_node_(number_free_nodes(mesh_.X)),
      A_(matrix_without_clamped_nodes(mesh_.tets, block_of_node_)),
      bytes_before_(allocated_bytes()),
      elasticity_(mesh_.X, mesh_.tets, fem::Corotated(kE, kNu)),
      slots_(elasticity_.slots_in(A_, block_of_node_)),
      bytes_of_elasticity_(allocated_bytes() - bytes_before_),
      x_free_(3, A_.num_blocks()),
      f_int_(3, mesh_.X.cols()),
      b_(num_unknowns()),
      mass_(A_.num_blocks()) {
  const Eigen::VectorXd lumped_mass = fem::lumped_mass(mesh_.X, mesh_.tets, kDensity);
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    if (block_of_node_[a] >= 0) mass_[block_of_node_[a]] = lumped_mass[static_cast<int>(a)];
  }
  rest();
}

void Beam::rest() {
  x_ = mesh_.X;
  v_ = Eigen::VectorXd::Zero(num_unknowns());
  dv_ = v_;
  iterations_ = 0;
}

/// A = M + h² K, b = h (f_ext − f_int) − h² K v = h (f_ext − f_int) + M v − A v
void Beam::assemble() {
  f_int_.setZero();
  A_.set_zero();
  elasticity_.add_force_and_stiffness(x_, fem::Tangent::Consistent, kTimeStep * kTimeStep, slots_,
                                      f_int_, A_);
  for (int block = 0; block < A_.num_blocks(); ++block) {
    A_.block(A_.slot(block, block)).diagonal().array() += mass_[block];
  }
  A_.multiply(v_, Av_);
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    const int block = block_of_node_[a];
    if (block < 0) continue;
    const double m = mass_[block];
    const Vec3 force = m * Vec3(0, kGravity, 0) - f_int_.col(static_cast<int>(a));
    b_.segment<3>(3 * block) =
        kTimeStep * force + m * v_.segment<3>(3 * block) - Av_.segment<3>(3 * block);
  }
}

BeamTimes Beam::step(fem::LinearSolver& solver) {
  const double start = cpu_seconds();
  assemble();
  const double assembled = cpu_seconds();
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    if (block_of_node_[a] >= 0) x_free_.col(block_of_node_[a]) = x_.col(static_cast<int>(a));
  }
  if (solver.prepare(A_, x_free_) != fem::FactorStatus::Ready) {
    throw std::runtime_error("the matrix of a step is not positive definite");
  }
  const double prepared = cpu_seconds();
  const fem::SolveReport report = solver.solve(b_, dv_);
  if (!report.converged) throw std::runtime_error("the solver does not converge");
  iterations_ += report.iterations;
  const double solved = cpu_seconds();
  v_ += dv_;
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    const int block = block_of_node_[a];
    if (block >= 0) x_.col(static_cast<int>(a)) += kTimeStep * v_.segment<3>(3 * block);
  }
  return {1e3 * (assembled - start), 1e3 * (prepared - assembled), 1e3 * (solved - prepared)};
}

double Beam::tip_displacement() const {
  double sum = 0;
  int count = 0;
  for (Eigen::Index a = 0; a < x_.cols(); ++a) {
    if (mesh_.X(0, a) < kSize.x() - 1e-9) continue;
    sum += x_(1, a) - mesh_.X(1, a);
    ++count;
  }
  return sum / count;
}

}  // namespace articular::benchmarks
