// Which linear solver is the fastest in whole runs: shapes, elements, statics and time, with and
// without contact, by size.
//
//   build/release/bin/solver_table [SIZE]... [--only WORD]... [--runs N] [--nu NU]
//                                                                    (1000 8000; all; 3; 0.45)
//
// SIZE is a number of tetrahedra. WORD is one of slender, flat, cubic, ball, plain, smoothed,
// static, time, long, contact, free: rows that have all words. Prints a Markdown table: CPU time of
// a run without its set-up [ms] and, in brackets, linear iterations of a solution (0: factored).
// Runs with each solver take turns; times are medians. * is what "auto" takes, the last column its
// time by the best. A run that is not done after ten times the best so far is cut: "-".

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "tests/benchmarks/support/timing.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim {
namespace {

using benchmarks::cpu_seconds;
using benchmarks::median;

using Solver = Integrator::Solver;
constexpr double kWidth = 0.01;     // [m] shortest side
constexpr double kYoung = 100e3;    // [Pa]
constexpr double kStep = 1e-3;      // [s] in time, and
constexpr double kLongStep = 2e-2;  // of motions that are slow
constexpr int kSteps = 8;           // in time
constexpr double kFarBehind = 10;   // times the best: not worth waiting for

enum class Shape { Slender, Flat, Cubic, Ball };
enum class Analysis { Static, Time, Long };

struct Case {
  Shape shape;
  bool smoothed;
  Analysis analysis;
  bool contact;
  double nu;
};

Vec3 proportions(Shape shape) {
  switch (shape) {
    case Shape::Slender:
      return {20, 1, 1};
    case Shape::Flat:
      return {20, 20, 1};
    default:
      return {1, 1, 1};
  }
}

std::string words(const Case& c) {
  static const char* const shapes[] = {"slender", "flat", "cubic", "ball"};
  static const char* const analyses[] = {"static", "time", "long"};
  return std::string(shapes[static_cast<int>(c.shape)]) + " | " +
         (c.smoothed ? "smoothed" : "plain") + " | " + analyses[static_cast<int>(c.analysis)] +
         " | " + (c.contact ? "contact" : "free");
}

/// Cells of about a cube each, six tetrahedra a cell; one cell through what is thin at least.
Eigen::Vector3i cells_of(Shape shape, double num_tets) {
  const Vec3 sides = proportions(shape);
  const double per_length = std::cbrt(num_tets / 6 / sides.prod());
  Eigen::Vector3i cells;
  for (int i = 0; i < 3; ++i)
    cells[i] = std::max(1, static_cast<int>(std::lround(sides[i] * per_length)));
  return cells;
}

/// A body that is tied at one end (slender, cubic: there in the middle), at one edge (flat) or at
/// its middle (ball), under its weight; with contact it lies on a floor, and a plate presses it by
/// 2 % of its height.
Scenario scene_of(const Case& c, double num_tets, Solver solver) {
  const bool is_static = c.analysis == Analysis::Static;
  Scenario s = scene(is_static ? 0.5 : c.analysis == Analysis::Long ? kLongStep : kStep);
  s.integrator.solver = solver;
  s.integrator.position_tolerance.reset();
  if (is_static) s.analysis = Scenario::Analysis::Static;
  s.duration = is_static ? 1 : kSteps * s.integrator.step;
  const Vec3 size = kWidth * proportions(c.shape);
  Body body = box_body("body", Body::Kind::Tissue, size, Vec3::Zero(), cells_of(c.shape, num_tets));
  const double top = c.shape == Shape::Ball ? 2 * kWidth : 0.5 * size.z();
  if (c.shape == Shape::Ball)  // about six tetrahedra fill a cube of the element size
    body.geometry =
        SphereGeometry{2 * kWidth, std::cbrt(6 * 33.5 / num_tets) * kWidth, Vec3::Zero()};
  body.material = neo_hookean(kYoung, c.nu);
  body.material->element =
      c.smoothed ? TissueMaterial::Element::Smoothed : TissueMaterial::Element::Plain;
  s.bodies = {body, stand("wall")};
  const double L = 0.5 * size.x(), far = 1;
  if (c.shape == Shape::Ball)
    s.attachments = {attach("body", "wall", {-far, -far, -0.4 * kWidth}, {far, far, 0.4 * kWidth})};
  else {
    // What is pressed is not tied too; one layer of elements leaves no choice.
    const double reach = c.contact && c.shape == Shape::Cubic ? 0.3 * kWidth : far;
    s.attachments = {attach("body", "wall", {-far, -far, -reach}, {1e-6 - L, far, reach})};
  }
  // A cantilever's end goes down by 1.5 ρ g L⁴/(E d²): by about a tenth of its length.
  const double slender = size.x() / kWidth;
  s.loads = {gravity({0, 0, -0.1 * kYoung / (1.5 * 1000 * kWidth) / std::pow(slender, 3)})};
  if (c.contact) {
    s.contact = true;
    const double side = 2.5 * std::max(size.x(), 4 * kWidth);
    const auto plate = [&](const std::string& name, double z) {
      return box_body(name, Body::Kind::Fixed, {side, side, kWidth}, {0, 0, z}, {8, 8, 1});
    };
    s.bodies.push_back(plate("press", top + 0.5 * kWidth));
    s.bodies.push_back(plate("floor", -top - 0.5 * kWidth));
    s.contacts = {{"body", "press", {}}, {"body", "floor", {}}};
    s.loads.push_back(shift("press", s.duration, {0, 0, -0.04 * top}));
  }
  return s;
}

struct Measured {
  std::vector<double> seconds;
  double iterations = 0;  // of the linear solver, of a solution
  bool is_cut = false;
};

/// @param most  [s] then it is cut
void measure(const Scenario& scenario, double most, Measured& result) {
  Simulation run(scenario);
  const double start = cpu_seconds();
  try {
    while (run.state.t < scenario.duration) {
      run.stepper.step(run.state, scenario.duration);
      if (cpu_seconds() - start > most) {
        result.is_cut = true;
        return;
      }
    }
  } catch (const SimulationError&) {
    result.is_cut = true;
    return;
  }
  result.seconds.push_back(cpu_seconds() - start);
  result.iterations = static_cast<double>(run.state.counts.linear_iterations) /
                      static_cast<double>(run.state.counts.linear_solves);
}

void print_row(const Case& c, double num_tets, int runs) {
  const std::vector<Solver> solvers{Solver::Cholesky, Solver::ConjugateGradients,
                                    Solver::Multigrid};
  const Model model = build_model(scene_of(c, num_tets, Solver::Auto));
  std::vector<Measured> measured(solvers.size());
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < solvers.size(); ++i) {
      if (measured[i].is_cut) continue;
      measure(scene_of(c, num_tets, solvers[i]), kFarBehind * best, measured[i]);
      if (!measured[i].seconds.empty()) best = std::min(best, measured[i].seconds.back());
    }
  best = std::numeric_limits<double>::infinity();
  for (const Measured& m : measured)
    if (!m.is_cut && !m.seconds.empty()) best = std::min(best, median(m.seconds));
  std::printf("| %d | %d | %s | %g |", model.tissues[0].elements.num_elements(),
              model.layout.num_unknown_blocks(), words(c).c_str(), c.nu);
  double of_choice = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    const bool chosen = build_model(scene_of(c, num_tets, solvers[i])).linear_solver.kind ==
                        model.linear_solver.kind;
    if (measured[i].is_cut || measured[i].seconds.empty()) {
      std::printf(" -%s |", chosen ? "*" : "");
      continue;
    }
    const double time = median(measured[i].seconds);
    if (chosen) of_choice = time;
    std::printf(" %.3g%s (%.0f) |", 1e3 * time, chosen ? "*" : "", measured[i].iterations);
  }
  std::printf(" %.2f |\n", of_choice / best);
  std::fflush(stdout);
}

bool has_all(const std::string& text, const std::vector<std::string>& wanted) {
  for (const std::string& word : wanted)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

int run_table(int argc, char** argv) {
  std::vector<double> sizes;
  std::vector<std::string> only;
  std::vector<double> ratios{0.45};
  int runs = 3;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--only" && i + 1 < argc)
      only.emplace_back(argv[++i]);
    else if (word == "--runs" && i + 1 < argc)
      runs = std::atoi(argv[++i]);
    else if (word == "--nu" && i + 1 < argc)
      ratios = {std::atof(argv[++i])};
    else
      sizes.push_back(std::atof(argv[i]));
  }
  if (sizes.empty()) sizes = {1000, 8000};
  std::printf(
      "| tets | blocks | shape | element | analysis | | nu | Cholesky | conjugate gradients | "
      "multigrid | auto / best |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double num_tets : sizes)
    for (const Shape shape : {Shape::Slender, Shape::Flat, Shape::Cubic, Shape::Ball})
      for (const bool smoothed : {false, true})
        for (const Analysis analysis : {Analysis::Static, Analysis::Time, Analysis::Long})
          for (const bool contact : {false, true})
            for (const double nu : ratios) {
              const Case c{shape, smoothed, analysis, contact, nu};
              if (has_all(words(c), only)) print_row(c, num_tets, runs);
            }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace articular::sim

int main(int argc, char** argv) { return articular::sim::run_table(argc, argv); }
