#include "tests/benchmarks/extremes/stability_limit.hpp"

#include <cmath>
#include <stdexcept>

#include "sim/dynamics.hpp"
#include "sim/scenario.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

double largest_frequency(const sim::Model& model) {
  constexpr int kIterations = 2000;
  sim::Dynamics dynamics(model);
  const Eigen::VectorXd y = sim::initial_state(model);
  dynamics.evaluate(y.data(), 0);
  const fem::BlockMatrix& K =
      dynamics.matrix({.mass = 0, .damping = 0, .stiffness = 1}, fem::Tangent::Consistent);
  const Eigen::Index size = 3 * model.layout.num_unknown_blocks();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(size);
  Eigen::VectorXd mass, u = Eigen::VectorXd::Random(size), Ku(size);
  dynamics.multiply_mass(ones, mass);  // lumped: of nodes alone it is diagonal
  double square = 0;
  for (int i = 0; i < kIterations; ++i) {
    K.multiply(u, Ku);
    u = Ku.cwiseQuotient(mass);
    square = u.norm();
    u /= square;
  }
  return std::sqrt(square);
}

}  // namespace

StabilityLimit find_stability_limit(const Bench& bench, const std::string& scene) {
  const ProgramRun run = bench.run("limit", scene, 600);
  if (run.exit_code != 0) throw std::runtime_error(run.message);
  const ScenarioResults results(run.results);
  const double time = results.summary().at("simulated_time_s");
  return {.mean_step = time / results.count("sundials_steps"),
          .largest_frequency = largest_frequency(
              sim::build_model(sim::read_scenario(bench.folder() / "limit.toml")))};
}

}  // namespace articular::benchmarks
