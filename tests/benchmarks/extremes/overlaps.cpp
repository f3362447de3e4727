// Bodies that lie half in each other at the start.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kOverlappingSide = 0.01, kOverlappingYoung = 1e4;  // [m], [Pa]

std::string tissue(const std::string& name, double z, double size) {
  return box(name, "tissue",
             {.size = {size, size, kOverlappingSide}, .cells = {3, 3, 3}, .center = {0.001, 0, z}},
             solid(1000, "neo-hookean", kOverlappingYoung, 0.3, ", mass_damping = \"20 1/s\""));
}

/// Nothing holds them: apart they have no strain energy left, and touch no more than a little.
Finding free_blocks(const Bench& bench, double overlap, bool is_static) {
  const std::string scene = (is_static ? statics(1, 1) : general(0.5, 2e-3)) +
                            tissue("lower", 0, 1.2 * kOverlappingSide) +
                            tissue("upper", kOverlappingSide * (1 - overlap), kOverlappingSide) +
                            energy_probe() + contact_probe("contact", "lower", "upper");
  const ProgramRun run = bench.run("blocks", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  const ScenarioResults results(run.results);
  return judged(run, results.last("contact.max_penetration [m]") / kOverlappingSide,
                {.right = 0.01, .stable = 0.3}, "overlap left, by the side");
}

/// The lower one's bottom is held and so is the upper one's top: the force is that of both squeezed
/// to the height that is left, E A ε without lateral strain.
Finding held_blocks(const Bench& bench, double overlap, bool is_static) {
  const auto block = [](const std::string& name, double z) {
    return box(name, "tissue", {.cells = {3, 3, 3}, .center = {0, 0, z}},
               solid(1000, "corotated", kOverlappingYoung, 0, ", mass_damping = \"20 1/s\""));
  };
  const double top = kOverlappingSide * (1.5 - overlap);
  const std::string scene =
      (is_static ? statics(1, 1) : general(0.5, 2e-3)) + carrier("floor") + carrier("ceiling") +
      block("lower", 0) + block("upper", kOverlappingSide * (1 - overlap)) +
      attach("lower", "floor", {-1, -1, -1}, {1, 1, 1e-5 - kOverlappingSide / 2}) +
      attach("upper", "ceiling", {-1, -1, top - 1e-5}, {1, 1, 1}) +
      reaction_probe("floor", "floor");
  const ProgramRun run = bench.run("blocks", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  const double force = std::abs(ScenarioResults(run.results).last("floor.force.z [N]"));
  // In time contact gives by a tenth of what elements do, on both sides.
  return judged(
      run,
      std::abs(force / (kOverlappingYoung * kOverlappingSide * kOverlappingSide * overlap / 2) - 1),
      {.right = is_static ? 0.01 : 0.1, .stable = 0.5}, "force against E A ε");
}

}  // namespace

std::vector<Extreme> overlaps() {
  std::vector<Extreme> rows;
  for (const bool is_static : {true, false})
    for (const double overlap : {0.1, 0.3, 0.5}) {
      const std::string range =
          fmt::format("{:g} of a body, {}", overlap, is_static ? "static" : "dynamic");
      // Set apart, nothing holds them any more: in statics that has to be refused.
      rows.push_back(
          {.name = "overlap at the start, free",
           .range = range,
           .expected = is_static ? Outcome::Refused : Outcome::Right,
           .quick = overlap == 0.5 && is_static,
           .study = [=](const Bench& bench) { return free_blocks(bench, overlap, is_static); }});
      rows.push_back(
          {.name = "overlap at the start, held",
           .range = range,
           .expected = overlap > 0.4 && !is_static ? Outcome::Refused : Outcome::Right,
           .quick = overlap == 0.5 && is_static,
           .study = [=](const Bench& bench) { return held_blocks(bench, overlap, is_static); }});
    }
  return rows;
}

}  // namespace articular::benchmarks
