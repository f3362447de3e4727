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
// change; ratios are those of the means, where preconditioners built anew count. The first step of
// each round is left out: that of the first meets a new pattern, and has a column. Equal motion
// shows in the tip. The peak of memory is that of the process until a solver has had its first
// round: only in the first row of the first size is it that of one solver, mesh and matrix.

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/fem/beam.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace {

using namespace articular;
using namespace articular::benchmarks;

constexpr double kTolerance = 1e-5;
constexpr int kMaxIterations = 10000;
constexpr int kRounds = 3;
constexpr int kLarge =
    200'000;  // tetrahedra beyond which other instruction sets and laws are left out

struct Solver {
  const char* name;
  std::unique_ptr<fem::LinearSolver> (*make)();
  int largest;  // mesh that it is tried on, in tetrahedra
};
constexpr int kAnySize = 10'000'000;

const std::vector<Solver> kSolvers{
    {"multigrid, start from 5",
     [] { return fem::make_projected_start(fem::make_multigrid(kTolerance, kMaxIterations), 5); },
     kAnySize},
    {"multigrid", [] { return fem::make_multigrid(kTolerance, kMaxIterations); }, kAnySize},
    {"block-Jacobi CG, start from 5",
     [] {
       return fem::make_projected_start(fem::make_conjugate_gradients(kTolerance, kMaxIterations),
                                        5);
     },
     400'000},
    {"block-Jacobi CG", [] { return fem::make_conjugate_gradients(kTolerance, kMaxIterations); },
     400'000},
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
    {"1k", {18, 3, 3}, 100, {3.2, 1.18}}, {"5k", {33, 5, 5}, 100, {20, 18.2}},
    {"20k", {52, 8, 8}, 50, {104, 262}},  {"100k", {85, 14, 14}, 20, {812, 0}},
    {"300k", {124, 20, 20}, 10, {0, 0}},  {"1M", {185, 30, 30}, 10, {0, 0}},
};

template <class Function>
double milliseconds(Function function) {
  const double start = cpu_seconds();
  function();
  return 1e3 * (cpu_seconds() - start);
}

/// The parts of an assembly of all nodes, each by itself, at the last state of the beam.
void print_assembly_row(const Beam& beam, const char* name, const fem::AnyMaterial& material,
                        fem::InstructionSet set) {
  const fem::Elasticity elasticity(beam.X(), beam.elasticity().tets(), material, {},
                                   {.instruction_set = set});
  const Positions& x = beam.x();
  Positions f = Positions::Zero(3, x.cols());
  fem::BlockMatrix K = elasticity.make_matrix();
  std::vector<int> block_of_node(static_cast<std::size_t>(x.cols()));
  std::iota(block_of_node.begin(), block_of_node.end(), 0);
  const fem::StiffnessSlots slots = elasticity.slots_in(K, block_of_node);
  constexpr auto kTrue = fem::Tangent::Consistent;
  constexpr auto kProjected = fem::Tangent::Projected;
  std::vector<double> energy, force, stiffness, both, projected;
  double sum = 0;
  for (int repeat = 0; repeat < 15; ++repeat) {
    energy.push_back(milliseconds([&] { sum += elasticity.energy(x); }));
    force.push_back(milliseconds([&] { elasticity.add_internal_force(x, f); }));
    stiffness.push_back(milliseconds([&] { elasticity.add_stiffness(x, kTrue, 1, slots, K); }));
    both.push_back(
        milliseconds([&] { elasticity.add_force_and_stiffness(x, kTrue, 1, slots, f, K); }));
    projected.push_back(
        milliseconds([&] { elasticity.add_stiffness(x, kProjected, 1, slots, K); }));
  }
  if (!std::isfinite(sum)) throw std::runtime_error("the energy of the beam is not finite");
  std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.2f |\n", name, median(energy), median(force),
              median(stiffness), median(both), median(projected));
}

void print_assembly(const Beam& beam) {
  std::printf(
      "\n%d tetrahedra, %d unknowns; elasticity %.0f bytes a tetrahedron; assembly alone [ms]\n\n"
      "| law | energy | force | stiffness | force and stiffness | projected stiffness |\n"
      "| --- | --- | --- | --- | --- | --- |\n",
      beam.num_tets(), beam.num_unknowns(), beam.bytes_of_elasticity() / beam.num_tets());
  using fem::InstructionSet;
  const InstructionSet best = fem::best_instruction_set();
  const fem::Lame lame = fem::lame_parameters(Beam::kE, Beam::kNu);
  const fem::Corotated corotated(Beam::kE, Beam::kNu);
  if (beam.num_tets() > kLarge) {
    print_assembly_row(beam, "corotated", corotated, best);
    std::printf("\n");
    return;
  }
  if (best == InstructionSet::Avx512) {
    print_assembly_row(beam, "corotated, AVX-512", corotated, best);
  }
  if (best != InstructionSet::Baseline) {
    print_assembly_row(beam, "corotated, AVX2", corotated, InstructionSet::Avx2);
  }
  print_assembly_row(beam, "corotated, SSE2", corotated, InstructionSet::Baseline);
  print_assembly_row(beam, "neo-Hookean, best of these", fem::NeoHookean(Beam::kE, Beam::kNu),
                     best);
  print_assembly_row(beam, "Mooney-Rivlin, element by element",
                     fem::MooneyRivlin<fem::VolumeChange>(lame.mu / 2, 0, fem::bulk_modulus(lame)),
                     best);
  std::printf("\n");
}

struct Record {
  std::vector<double> assembly, prepare, solve, total;
  double first = 0;  // step, which meets a new pattern
  double iterations = 0, tip = 0;
  double peak = 0;  // of memory, of this process until the end of the first round [MB]
};

double peak_megabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void run(Beam& beam, fem::LinearSolver& solver, int steps, Record& record) {
  beam.rest();
  for (int step = 0; step < steps; ++step) {
    const BeamTimes times = beam.step(solver);
    if (step == 0) {
      if (record.first == 0) record.first = times.total();
      continue;
    }
    record.assembly.push_back(times.assembly);
    record.prepare.push_back(times.prepare);
    record.solve.push_back(times.solve);
    record.total.push_back(times.total());
  }
  if (record.peak == 0) record.peak = peak_megabytes();
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
  std::vector<double> products(15);
  for (double& product : products) product = milliseconds([&] { beam.matrix().multiply(x, y); });
  print_assembly(beam);
  std::printf(
      "| solver | ms a step, median | mean | assembly | set-up | solve | first step | CG "
      "iterations "
      "| step / (A x) | tip after %d steps [m] | peak MB | SOFA CG (ratio) | SOFA LDLT (ratio) |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      size.steps);
  for (std::size_t k = 0; k < solvers.size(); ++k) {
    if (!solvers[k]) continue;
    const Record& r = records[k];
    const double total = median(r.total);
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f | %.1f | %.0f | %.8f | %.0f |",
                kSolvers[k].name, total, mean(r.total), median(r.assembly), median(r.prepare),
                median(r.solve), r.first, r.iterations, total / median(products), r.tip, r.peak);
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
