// Muscles and gravity a thousand times too strong.
#include <fmt/format.h>

#include <cmath>

#include "tests/benchmarks/extremes/energy_error.hpp"
#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kLoadedSide = 0.01;  // [m]

std::string muscle(double force, const std::string& radius) {
  return fmt::format(
      "[[muscle]]\nname = \"puller\"\npath = [{{ body = \"ceiling\", point = \"0 0 {} m\" }}, {{ "
      "body = \"block\", point = \"0 0 {} m\"{} }}]\nmax_force = \"{} N\"\n"
      "excitation = {{ time = [\"0 s\", \"10 ms\"], value = [0, 1] }}\n",
      digits(0.05), digits(kLoadedSide / 2), radius, digits(force));
}

/// It pulls at a block of tissue; 0.1 N would stretch the block by 10 %.
Finding pulled_tissue(const Bench& bench, double force) {
  const std::string scene =
      general(0.5, 1e-3) + carrier("floor") + carrier("ceiling") +
      box("block", "tissue", {.cells = {3, 3, 3}},
          solid(1000, "neo-hookean", 1e4, 0.3, ", mass_damping = \"20 1/s\"")) +
      attach("block", "floor", {-1, -1, -1}, {1, 1, -0.00499}) +
      muscle(force, ", radius = \"2 mm\"") + energy_probe();
  const ProgramRun run = bench.run("muscle", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  return judged(run, energy_created(ScenarioResults(run.results)), {.right = 1e-2, .stable = 0.5},
                "energy made of nothing, by the largest there was");
}

/// A bone of 10 g between two ligaments.
Finding pulled_bone(const Bench& bench, double force) {
  const std::string scene =
      general(0.5, 1e-3) + carrier("floor") + carrier("ceiling") +
      box("block", "rigid", {}, density(1e4)) + muscle(force, "") +
      "[[ligament]]\nname = \"band\"\nstiffness = \"1000 N/m\"\ndamping = \"1 N s/m\"\npath = [{ "
      "body "
      "= \"floor\", point = \"0 0 -30 mm\" }, { body = \"block\", point = \"0 0 -5 mm\" }]\n" +
      energy_probe();
  const ProgramRun run = bench.run("muscle", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  return judged(run, energy_created(ScenarioResults(run.results)), {.right = 1e-2, .stable = 0.5},
                "energy made of nothing, by the largest there was");
}

/// A block on a floor: once at rest it puts its weight on it.
/// @param contact  the scenario's end
Finding heavy(const Bench& bench, double g, double young, bool is_static,
              const std::string& contact = "") {
  const std::string scene =
      (is_static ? statics(1, 0.1) : general(1, 1e-3)) +
      box("floor", "fixed",
          {.size = {0.06, 0.06, 0.01}, .cells = {4, 4, 1}, .center = {0, 0, -0.01}}) +
      box("block", "tissue", {.cells = {3, 3, 3}},
          solid(1000, "neo-hookean", young, 0.45, ", mass_damping = \"50 1/s\"")) +
      gravity(9.81 * g) + reaction_probe("floor", "floor") +
      point_probe("top", "block", {0, 0, kLoadedSide / 2}) + contact;
  const ProgramRun run = bench.run("heavy", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  const double weight = 1000 * kLoadedSide * kLoadedSide * kLoadedSide * 9.81 * g;
  const ScenarioResults results(run.results);
  const double force = std::abs(results.last("floor.force.z [N]"));
  Finding finding = judged(run, std::abs(force / weight - 1), {.right = 0.01, .stable = 0.5},
                           "force on the floor against the weight");
  const auto moved = [&](const std::string& column) {
    return results.last(column) - results.column(column).front();
  };
  finding.measured += fmt::format(
      "; sideways by {:.2g} of its side",
      std::hypot(moved("top.position.x [m]"), moved("top.position.y [m]")) / kLoadedSide);
  return finding;
}

}  // namespace

std::vector<Extreme> large_loads() {
  std::vector<Extreme> rows;
  for (const double force : {0.1, 100.0})
    rows.push_back({.name = "muscle on tissue",
                    .range = fmt::format("{:g} times its force", 10 * force),
                    .quick = force == 100,
                    .study = [=](const Bench& bench) { return pulled_tissue(bench, force); }});
  for (const double force : {10.0, 1e4})
    rows.push_back({.name = "muscle on bone",
                    .range = fmt::format("{:g} times its force", 0.1 * force),
                    .quick = force == 1e4,
                    .study = [=](const Bench& bench) { return pulled_bone(bench, force); }});
  // ρ g L is as large as E at 100 kPa, and ten times that at 10.
  for (const bool is_static : {false, true})
    for (const double young : {1e6, 1e5, 1e4})
      rows.push_back(
          {.name = "gravity 1000 g",
           .range = fmt::format("E = {:g} Pa, {}", young, is_static ? "static" : "dynamic"),
           .expected = young > 5e4 ? Outcome::Right : Outcome::Refused,
           .quick = young > 5e5 || young < 5e4,
           .study = [=](const Bench& bench) { return heavy(bench, 1000, young, is_static); }});
  const std::string friction = "[[contact]]\nbodies = [\"block\", \"floor\"]\nfriction = 0.1\n";
  rows.push_back(
      {.name = "gravity 1000 g",
       .range = "E = 100000 Pa, dynamic, friction 0.1",
       .study = [=](const Bench& bench) { return heavy(bench, 1000, 1e5, false, friction); }});
  return rows;
}

}  // namespace articular::benchmarks
