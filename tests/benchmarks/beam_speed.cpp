// What a step of soft tissue costs, by part, solver and size, beside a published measurement.
//
//   build/release/bin/beam_speed [1k|5k|20k|100k|300k|1M]...      (default: 1k 5k 20k 100k)
//
//        clamped                      g
//        |/|=======================|  |
//        |/|=======================|  v      six tetrahedra a cell, see beam.hpp
//
// Solvers take turns, each from rest through the same steps; residual 1e-5 of the matrix of the
// step. Times are medians over steps and rounds of processor time, which other programs hardly
// change. The first step of each round, which meets a new pattern, is left out. Equal motion shows
// in the tip.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "tests/benchmarks/beam.hpp"
#include "tests/benchmarks/timing.hpp"

namespace {

using namespace articular;
using namespace articular::benchmarks;

constexpr double kTolerance = 1e-5;
constexpr int kMaxIterations = 10000;
constexpr int kRounds = 3;

struct Solver {
  const char* name;
  std::unique_ptr<fem::LinearSolver> (*make)();
  int largest;  // mesh that it is tried on, in tetrahedra
};
constexpr int kAnySize = 10'000'000;

const std::vector<Solver> kSolvers{
    {"block-Jacobi CG", [] { return fem::make_conjugate_gradients(kTolerance, kMaxIterations); },
     kAnySize},
    {"Cholesky", [] { return fem::make_cholesky(); }, 30'000},
};

/// SOFA 26.06 on a comparable machine, its fastest force field: ms a step, 0: not published.
struct Published {
  double conjugate_gradients, direct;  // to 1e-5; sparse LDLᵀ
};

struct Size {
  const char* name;
  std::array<int, 3> cells;
  int steps;
  Published sofa;
};

const std::vector<Size> kSizes{
    {"1k", {18, 3, 3}, 100, {3.2, 1.2}}, {"5k", {33, 5, 5}, 100, {20, 18}},
    {"20k", {52, 8, 8}, 50, {104, 262}}, {"100k", {85, 14, 14}, 20, {812, 0}},
    {"300k", {124, 20, 20}, 10, {0, 0}}, {"1M", {185, 30, 30}, 5, {0, 0}},
};

template <class Function>
double milliseconds(Function function) {
  const double start = cpu_seconds();
  function();
  return 1e3 * (cpu_seconds() - start);
}

/// The parts of an assembly, each by itself, at the last state of the beam.
void print_parts(const Beam& beam) {
  const fem::Elasticity& elasticity = beam.elasticity();
  Positions f = Positions::Zero(3, beam.x().cols());
  fem::BlockMatrix K = elasticity.make_matrix();
  Eigen::VectorXd x = Eigen::VectorXd::Ones(beam.num_unknowns()), y;
  std::vector<double> force, stiffness, projected, product;
  for (int repeat = 0; repeat < 15; ++repeat) {
    force.push_back(milliseconds([&] { elasticity.add_internal_force(beam.x(), f); }));
    stiffness.push_back(
        milliseconds([&] { elasticity.add_stiffness(beam.x(), fem::Tangent::Consistent, 1, K); }));
    projected.push_back(
        milliseconds([&] { elasticity.add_stiffness(beam.x(), fem::Tangent::Projected, 1, K); }));
    product.push_back(milliseconds([&] { beam.matrix().multiply(x, y); }));
  }
  std::printf(
      "\n%d tetrahedra, %d unknowns; elasticity %.0f bytes a tetrahedron; alone: force %.2f ms, "
      "stiffness %.2f ms, projected %.2f ms, A x %.3f ms\n\n",
      beam.num_tets(), beam.num_unknowns(), beam.bytes_of_elasticity() / beam.num_tets(),
      median(force), median(stiffness), median(projected), median(product));
}

struct Record {
  std::vector<double> assembly, prepare, solve, total;
  double iterations = 0, tip = 0;
};

void run(Beam& beam, fem::LinearSolver& solver, int steps, Record& record) {
  beam.rest();
  for (int step = 0; step < steps; ++step) {
    const BeamTimes times = beam.step(solver);
    if (step == 0) continue;
    record.assembly.push_back(times.assembly);
    record.prepare.push_back(times.prepare);
    record.solve.push_back(times.solve);
    record.total.push_back(times.total());
  }
  record.iterations = static_cast<double>(beam.iterations()) / steps;
  record.tip = beam.tip_displacement();
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void print_ratio(double published, double ours) {
  if (published > 0) {
    std::printf(" %.3g (%.1f) |", published, published / ours);
  } else {
    std::printf(" - |");
  }
}

void measure(const Size& size) {
  Beam beam(size.cells);
  std::vector<std::unique_ptr<fem::LinearSolver>> solvers;
  for (const Solver& solver : kSolvers) {
    if (beam.num_tets() <= solver.largest)
      solvers.push_back(solver.make());
    else
      solvers.push_back(nullptr);
  }
  std::vector<Record> records(solvers.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < solvers.size(); ++k) {
      if (solvers[k]) run(beam, *solvers[k], size.steps, records[k]);
    }
  }
  Eigen::VectorXd x = Eigen::VectorXd::Ones(beam.num_unknowns()), y;
  std::vector<double> products;
  for (int repeat = 0; repeat < 15; ++repeat) {
    products.push_back(milliseconds([&] { beam.matrix().multiply(x, y); }));
  }
  print_parts(beam);
  std::printf(
      "| solver | ms a step, median | mean | assembly | set-up | solve | CG iterations | step / (A "
      "x) "
      "| tip after %d steps [m] | SOFA CG (ratio) | SOFA LDLT (ratio) |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      size.steps);
  for (std::size_t k = 0; k < solvers.size(); ++k) {
    if (!solvers[k]) continue;
    const Record& r = records[k];
    const double total = median(r.total);
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f | %.0f | %.8f |", kSolvers[k].name,
                total, mean(r.total), median(r.assembly), median(r.prepare), median(r.solve),
                r.iterations, total / median(products), r.tip);
    print_ratio(size.sofa.conjugate_gradients, mean(r.total));
    print_ratio(size.sofa.direct, mean(r.total));
    std::printf("\n");
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"1k", "5k", "20k", "100k"};
  std::vector<Size> sizes;
  for (const std::string& name : names) {
    const auto found = std::find_if(kSizes.begin(), kSizes.end(),
                                    [&](const Size& size) { return name == size.name; });
    if (found == kSizes.end()) {
      std::fprintf(stderr, "usage: beam_speed [1k|5k|20k|100k|300k|1M]...\n");
      return 2;
    }
    sizes.push_back(*found);
  }
  try {
    for (const Size& size : sizes) measure(size);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "beam_speed: %s\n", error.what());
    return 1;
  }
}
