// The linear equations of one correction of Newton's iteration: what they take, how fast our
// solvers are, and the equations as files for solvers of others.
//
//   build/release/bin/newton_system SCENARIO [--steps N] [--out FOLDER] [--solvers NAME,...]
//                                   [--tolerance T] [--runs N] [--set KEY=VALUE]...
//
// Takes N steps (1) and makes the first correction of the next one. Prints a JSON object: elements,
// blocks, processor seconds and memory of all that leads to the equations, and of each solver its
// set-up, solution, iterations and memory. A solver runs in a process of its own; times are medians
// of N runs (3), memory is what it takes beside the equations. Iterations end at a residual of
// T |b| (1e-6).
//
// FOLDER gets files in Matrix Market's form:
//   matrix.mtx, right_side.mtx   A, lower half, in 3x3 blocks; b
//   rigid_motions.mtx            six columns: A hardly resists them
//   gradient.mtx, compliance.mtx, plain.mtx   with smoothed elements: the equations are
//                                (A + G C⁻¹ Gᵀ) x = b, and `plain` is a positive definite matrix
//                                near their own

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sim/assembly/solver_setup.hpp"
#include "sim/build/build_model.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/step/stepper.hpp"
#include "tests/benchmarks/sim/first_correction.hpp"
#include "tests/benchmarks/support/matrix_market.hpp"
#include "tests/benchmarks/support/measured_child.hpp"
#include "tests/benchmarks/support/timing.hpp"

namespace articular::sim {
namespace {

using benchmarks::cpu_seconds;
using nlohmann::ordered_json;

constexpr int kMostIterations = 2000;

struct Arguments {
  std::string scenario, folder;
  std::vector<std::string> overrides, solvers{"cholesky", "conjugate-gradients", "multigrid"};
  int steps = 1, runs = 3;
  double tolerance = 1e-6;
};

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

double number_of(const std::string& option, const std::string& value) {
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != '\0' || !(number >= 0))
    throw std::invalid_argument(option + ": expected a number of 0 or more, got `" + value + "`");
  return number;
}

fem::SolverKind kind_of(const std::string& name, bool with_pressures) {
  if (name == "cholesky")
    return with_pressures ? fem::SolverKind::SaddlePoint : fem::SolverKind::Cholesky;
  if (name == "conjugate-gradients") return fem::SolverKind::ConjugateGradients;
  if (name == "multigrid") return fem::SolverKind::Multigrid;
  throw std::invalid_argument(
      "--solvers: expected cholesky, conjugate-gradients or multigrid, got `" + name + "`");
}

Arguments read_arguments(int argc, char** argv) {
  Arguments given;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("--")) {
      given.scenario = word;
      continue;
    }
    if (i + 1 == argc) throw std::invalid_argument(word + ": a value is missing");
    const std::string value = argv[++i];
    if (word == "--set")
      given.overrides.push_back(value);
    else if (word == "--out")
      given.folder = value;
    else if (word == "--solvers")
      given.solvers = words_of(value);
    else if (word == "--steps")
      given.steps = static_cast<int>(number_of(word, value));
    else if (word == "--runs")
      given.runs = static_cast<int>(std::max(1.0, number_of(word, value)));
    else if (word == "--tolerance")
      given.tolerance = number_of(word, value);
    else
      throw std::invalid_argument("unknown option " + word);
  }
  for (const std::string& name : given.solvers) kind_of(name, false);
  if (given.scenario.empty()) throw std::invalid_argument("a scenario is missing");
  return given;
}

double peak_megabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

ordered_json solve_by(fem::SolverKind kind, const FirstCorrection& correction,
                      const Arguments& given) {
  std::vector<double> setup, solution;
  fem::SolveReport report;
  bool is_ready = true;
  for (int run = 0; run < given.runs && is_ready; ++run) {
    const auto solver = fem::make_linear_solver({kind}, given.tolerance, kMostIterations);
    const double start = cpu_seconds();
    is_ready = prepare_linear(*solver, correction.equations(), correction.nodes());
    const double ready = cpu_seconds();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(correction.right_side().size());
    if (is_ready) report = solver->solve(correction.right_side(), x);
    setup.push_back(ready - start);
    solution.push_back(cpu_seconds() - ready);
  }
  return {{"setup_s", benchmarks::median(setup)},
          {"solve_s", benchmarks::median(solution)},
          {"iterations", report.iterations},
          {"converged", is_ready && report.converged}};
}

ordered_json measure_solvers(const FirstCorrection& correction, const Arguments& given) {
  malloc_trim(0);  // what is free counts for the solver that takes it
  const double before = benchmarks::measure_in_child([] {}).peak_megabytes;
  const bool with_pressures = !correction.equations().pressure.terms.empty();
  ordered_json rows = ordered_json::object();
  for (const std::string& name : given.solvers) {
    const benchmarks::ChildUse use = benchmarks::measure_in_child([&] {
      std::puts(solve_by(kind_of(name, with_pressures), correction, given).dump().c_str());
    });
    rows[name] = use.succeeded ? ordered_json::parse(use.output) : ordered_json::object();
    rows[name]["memory_mb"] = use.peak_megabytes - before;
  }
  return rows;
}

void write_equations(const FirstCorrection& correction, const std::filesystem::path& folder) {
  const NewtonEquations equations = correction.equations();
  std::filesystem::create_directories(folder);
  benchmarks::write_matrix(folder / "matrix.mtx", equations.A);
  benchmarks::write_matrix(folder / "right_side.mtx", Eigen::MatrixXd(correction.right_side()));
  benchmarks::write_matrix(folder / "rigid_motions.mtx", correction.rigid_motions());
  if (equations.pressure.terms.empty()) return;
  benchmarks::write_gradients(folder / "gradient.mtx", equations.pressure.terms);
  benchmarks::write_compliances(folder / "compliance.mtx", equations.pressure.terms);
  benchmarks::write_matrix(folder / "plain.mtx", *equations.pressure.plain);
}

ordered_json measure(const Arguments& given) {
  ordered_json result;
  double start = cpu_seconds();
  const Scenario scenario = read_scenario(given.scenario, given.overrides);
  const Model model = build_model(scenario);
  int tets = 0;
  for (const Tissue& tissue : model.tissues) tets += tissue.elements.num_elements();
  result["tets"] = tets;
  result["blocks"] = model.layout.num_unknown_blocks();
  result["build_s"] = cpu_seconds() - start;
  result["memory_built_mb"] = peak_megabytes();

  start = cpu_seconds();
  State state;
  {
    Stepper stepper(model, step_settings(scenario));
    state = stepper.initial();
    while (state.counts.steps < given.steps) stepper.step(state, scenario.duration);
  }
  result["steps_s"] = cpu_seconds() - start;
  result["newton_iterations"] = state.counts.newton_iterations;
  result["memory_stepped_mb"] = peak_megabytes();

  const FirstCorrection correction(model, step_settings(scenario), state);
  const CorrectionTimes& times = correction.times();
  result["chosen"] = name_of(model.linear_solver.kind);
  result["nonzero_blocks"] = correction.equations().A.num_nonzero_blocks();
  result["search_s"] = times.search;
  result["evaluation_s"] = times.evaluation;
  result["first_assembly_s"] = times.first_assembly;
  result["assembly_s"] = times.assembly;
  result["memory_assembled_mb"] = peak_megabytes();
  if (!given.folder.empty()) write_equations(correction, given.folder);
  result["solvers"] = measure_solvers(correction, given);
  return result;
}

}  // namespace
}  // namespace articular::sim

int main(int argc, char** argv) {
  try {
    std::puts(articular::sim::measure(articular::sim::read_arguments(argc, argv)).dump(2).c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "newton_system: %s\n", error.what());
    return 2;
  }
  return EXIT_SUCCESS;
}
