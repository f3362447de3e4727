// Cost of a step by phase.
//
//   build/release/bin/step_phases scenarios/mandible/opening.toml [STEPS] [--set KEY=VALUE]...
//
// runs the first STEPS (default 50) steps of a scenario without writing frames and prints CSV:
// milliseconds a step (wall and process time), its phases, work per step, and a hash of the final
// state. A faster program with another hash computed something else.

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "sim/step/stepper.hpp"

namespace {

using namespace articular;

std::uint64_t hash_of(const Eigen::VectorXd& y) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  const auto* bytes = reinterpret_cast<const unsigned char*>(y.data());
  for (std::size_t i = 0; i < static_cast<std::size_t>(y.size()) * sizeof(double); ++i)
    hash = (hash ^ bytes[i]) * 1099511628211ULL;
  return hash;
}

void print(const char* name, double value) { std::printf("%s,%.4f\n", name, value); }

int measure(const std::string& file, int steps, const std::vector<std::string>& overrides) {
  const sim::Scenario scenario = sim::read_scenario(file, overrides);
  const sim::Model model = sim::build_model(scenario);
  sim::Stepper stepper(model, sim::step_settings(scenario));
  sim::State state = stepper.initial();
  const double setup_solve = stepper.times().solve;
  const auto wall_start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  while (state.counts.steps < steps && state.t < scenario.duration)
    stepper.step(state, scenario.duration);
  const double n = static_cast<double>(state.counts.steps);
  const std::chrono::duration<double, std::milli> wall =
      std::chrono::steady_clock::now() - wall_start;
  const double cpu = 1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  const sim::PhaseTimes times = stepper.times();

  std::printf("quantity,per_step\n");
  print("wall_ms", wall.count() / n);
  print("cpu_ms", cpu / n);
  print("collision_update_ms", 1e3 * times.collision_update / n);
  print("collision_traversal_ms", 1e3 * times.collision_traversal / n);
  print("collision_narrow_ms", 1e3 * times.collision_narrow / n);
  print("crossings_ms", 1e3 * times.crossings / n);
  print("elastic_force_ms", 1e3 * times.elastic_force / n);
  print("contact_force_ms", 1e3 * times.contact_force / n);
  print("assembly_ms", 1e3 * times.assembly / n);
  print("solve_ms", 1e3 * (times.solve - setup_solve) / n);
  print("newton_iterations", static_cast<double>(state.counts.newton_iterations) / n);
  print("factorizations", static_cast<double>(state.counts.factorizations) / n);
  print("narrow_tests", static_cast<double>(state.counts.narrow_tests) / n);
  print("reported_pairs", static_cast<double>(state.counts.reported_pairs) / n);
  std::printf("steps,%lld\nsimulated_ms,%.3f\nstate_hash,%016llx\n",
              static_cast<long long>(state.counts.steps), 1e3 * state.t,
              static_cast<unsigned long long>(hash_of(state.y)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> overrides, rest;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--set" && i + 1 < argc)
      overrides.emplace_back(argv[++i]);
    else
      rest.push_back(argument);
  }
  if (rest.empty() || rest.size() > 2) {
    std::fprintf(stderr, "usage: step_phases SCENARIO [STEPS] [--set KEY=VALUE]...\n");
    return 2;
  }
  try {
    return measure(rest[0], rest.size() > 1 ? std::atoi(rest[1].c_str()) : 50, overrides);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "step_phases: %s\n", error.what());
    return 2;
  }
}
