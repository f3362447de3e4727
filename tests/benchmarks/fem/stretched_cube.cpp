#include "tests/benchmarks/fem/stretched_cube.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kOnPlate = 1e-9;  // of the edge
constexpr int kMaxNewton = 30, kMaxLinear = 1000;

bool on_lower_plate(const Vec3& X) { return X.z() < kOnPlate; }
bool on_upper_plate(const Vec3& X) { return X.z() > 1 - kOnPlate; }

std::vector<int> number_free_nodes(const Positions& X) {
  std::vector<int> number;
  int free_nodes = 0;
  for (const auto& node : X.colwise()) {
    number.push_back(on_lower_plate(node) || on_upper_plate(node) ? -1 : free_nodes++);
  }
  return number;
}

fem::BlockMatrix matrix_of_free_nodes(const Tetrahedra& tets,
                                      const std::vector<int>& block_of_node) {
  std::vector<int> stencils, offsets{0};
  for (const auto& tet : tets.colwise()) {
    for (const int node : tet) {
      const int block = block_of_node[static_cast<std::size_t>(node)];
      if (block >= 0) stencils.push_back(block);
    }
    offsets.push_back(static_cast<int>(stencils.size()));
  }
  return {*std::max_element(block_of_node.begin(), block_of_node.end()) + 1, stencils, offsets};
}

}  // namespace

double StretchedCube::shear_modulus() { return fem::lame_parameters(kE, kNu).mu; }
double StretchedCube::bulk_modulus() { return fem::bulk_modulus(fem::lame_parameters(kE, kNu)); }

fem::TetMesh StretchedCube::make_mesh(int cells) {
  return fem::box_mesh({cells, cells, cells}, Vec3::Ones());
}

StretchedCube::StretchedCube(int cells)
    : mesh_(make_mesh(cells)),
      block_of_node_(number_free_nodes(mesh_.X)),
      elasticity_(mesh_.X, mesh_.tets, fem::MooneyRivlin<>(shear_modulus() / 2, 0, bulk_modulus())),
      K_(matrix_of_free_nodes(mesh_.tets, block_of_node_)),
      slots_(elasticity_.slots_in(K_, block_of_node_)),
      reached_{mesh_.X},
      x_(mesh_.X),
      f_(3, mesh_.X.cols()),
      x_free_(3, K_.num_blocks()),
      b_(3 * K_.num_blocks()),
      dx_(3 * K_.num_blocks()) {}

/// Where a step starts: on the polynomial through the ends of the last four steps. The first one
/// stretches all nodes alike.
void StretchedCube::predict(int step) {
  const auto end = reached_.rbegin();
  if (step == 1) x_.row(2) *= 1 + kStretch / kSteps;
  if (step == 2) x_ = 2 * end[0] - end[1];
  if (step == 3) x_ = 3 * end[0] - 3 * end[1] + end[2];
  if (step >= 4) x_ = 4 * end[0] - 6 * end[1] + 4 * end[2] - end[3];
  for (Eigen::Index a = 0; a < x_.cols(); ++a) {
    if (block_of_node_[static_cast<std::size_t>(a)] >= 0) continue;
    x_.col(a) = mesh_.X.col(a);
    if (on_upper_plate(mesh_.X.col(a))) x_(2, a) += kStretch * step / kSteps;
  }
}

void StretchedCube::update_force() {
  f_.setZero();
  elasticity_.add_internal_force(x_, f_);
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    const int block = block_of_node_[a];
    if (block >= 0) b_.segment<3>(3 * block) = -f_.col(static_cast<Eigen::Index>(a));
  }
}

/// |r| / |f on the upper plate|
double StretchedCube::residual() const {
  double plate = 0;
  for (Eigen::Index a = 0; a < x_.cols(); ++a) {
    if (on_upper_plate(mesh_.X.col(a))) plate += f_.col(a).squaredNorm();
  }
  return b_.norm() / std::sqrt(plate);
}

double StretchedCube::plate_force() const {
  double sum = 0;
  for (Eigen::Index a = 0; a < x_.cols(); ++a) {
    if (on_upper_plate(mesh_.X.col(a))) sum += f_(2, a);
  }
  return sum;
}

void StretchedCube::move(const Positions& from, double part) {
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    const int block = block_of_node_[a];
    const auto node = static_cast<Eigen::Index>(a);
    if (block >= 0) x_.col(node) = from.col(node) + part * dx_.segment<3>(3 * block);
  }
}

void StretchedCube::iterate(fem::LinearSolver& solver, Report& report) {
  double start = cpu_seconds();
  K_.set_zero();
  elasticity_.add_stiffness(x_, fem::Tangent::Consistent, 1, slots_, K_);
  report.assembly += cpu_seconds() - start;
  linear_solution(solver, report);
  start = cpu_seconds();
  search_along_line(report);
  report.assembly += cpu_seconds() - start;
  ++report.newton_iterations;
}

void StretchedCube::linear_solution(fem::LinearSolver& solver, Report& report) {
  const double start = cpu_seconds();
  for (std::size_t a = 0; a < block_of_node_.size(); ++a) {
    const auto node = static_cast<Eigen::Index>(a);
    if (block_of_node_[a] >= 0) x_free_.col(block_of_node_[a]) = x_.col(node);
  }
  if (solver.prepare(K_, x_free_) != fem::FactorStatus::Ready)
    throw std::runtime_error("the stiffness is not positive definite");
  const double prepared = cpu_seconds();
  dx_.setZero();
  const fem::SolveReport solved = solver.solve(b_, dx_);
  if (!solved.converged) throw std::runtime_error("the linear solver does not converge");
  report.linear_iterations += solved.iterations;
  report.set_up += prepared - start;
  report.solution += cpu_seconds() - prepared;
}

/// Goes the whole way, or the half, and so on, until the force along it has fallen. The stiffness
/// is not needed here, so that it waits for the next iteration. Inverted elements have no finite
/// force.
void StretchedCube::search_along_line(Report& report) {
  constexpr double kFallen = 0.9, kShortest = 1e-3;
  const Positions from = x_;
  const double slope = b_.dot(dx_);
  double part = 1;
  while (part > kShortest) {
    move(from, part);
    update_force();
    if (std::abs(b_.dot(dx_)) <= kFallen * slope) return;
    part /= 2;
    ++report.cut_steps;
  }
  throw std::runtime_error("no step lowers the force");
}

StretchedCube::Report StretchedCube::stretch(const Settings& settings) {
  Report report;
  const double start = cpu_seconds();
  const auto solver = fem::make_multigrid(settings.linear_residual, kMaxLinear);
  for (int step = 1; step <= kSteps; ++step) {
    predict(step);
    const double before = cpu_seconds();
    update_force();
    report.assembly += cpu_seconds() - before;
    for (int k = 0; residual() > settings.residual; ++k) {
      if (k == kMaxNewton) throw std::runtime_error("Newton's method does not converge");
      iterate(*solver, report);
    }
    reached_.push_back(x_);
    report.reaction[static_cast<std::size_t>(step - 1)] = plate_force();
  }
  report.total = cpu_seconds() - start;
  return report;
}

}  // namespace articular::benchmarks
