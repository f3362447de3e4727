// A rigid sphere that is pressed into smoothed tissue and dragged, the nearer to incompressible the
// harder for contact.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kDepth = 0.001, kWay = 0.016;                 // [m]
constexpr double kPressed = 0.03, kEnd = 0.07;                 // [s]
constexpr double kShear = 1e4;                                 // [Pa]
constexpr double kMostIterations = 8, kStableIterations = 20;  // a step

std::string dragged(double bulk_by_shear, bool is_static) {
  return (is_static ? statics(kEnd, 2e-3) : general(kEnd, 1e-3)) + carrier("floor") +
         ball("ball", "fixed", 0.01, 0.002, {-0.008, 0, 0.0201}) +
         box("block", "tissue",
             {.size = {0.04, 0.02, 0.01}, .cells = {16, 8, 4}, .center = {0, 0, 0.005}},
             density(1000) + fmt::format("material = {{ law = \"mooney-rivlin\", c10 = \"{} Pa\", "
                                         "bulk_modulus = \"{} Pa\", element = \"smoothed\" }}\n",
                                         digits(kShear / 2), digits(bulk_by_shear * kShear))) +
         attach("block", "floor", {-1, -1, -1e-6}, {1, 1, 1e-6}) +
         fmt::format(
             "[[load]]\nkind = \"motion\"\nbody = \"ball\"\n"
             "time = [\"0 s\", \"{0} s\", \"{1} s\"]\n"
             "translation = [\"0 0 0 m\", \"0 0 {2} m\", \"{3} 0 {2} m\"]\n",
             digits(kPressed), digits(kEnd), digits(-kDepth - 1e-4), digits(kWay)) +
         contact_probe("ball", "ball", "block");
}

/// Iterations a step; a try that was rejected counts as a hundred.
Finding study(const Bench& bench, double bulk_by_shear, bool is_static) {
  const ProgramRun run = bench.run("drag", dragged(bulk_by_shear, is_static), 600);
  if (const auto end = ended_early(run)) return *end;
  std::ifstream in(run.results / "summary.json");
  const nlohmann::json counts = nlohmann::json::parse(in).at("counts");
  const double iterations =
      counts.at("newton_iterations").get<double>() / counts.at("sundials_steps").get<double>();
  const double rejected = counts.at("rejected_newton").get<double>();
  Finding finding = judged(
      run, iterations + 100 * rejected,
      {.right = is_static ? kStableIterations : kMostIterations, .stable = kStableIterations},
      "iterations a step");
  finding.measured += fmt::format("; rejected tries: {}", rejected);
  return finding;
}

}  // namespace

std::vector<Extreme> dragged_spheres() {
  std::vector<Extreme> rows;
  for (const bool is_static : {false, true})
    for (const double bulk_by_shear : {50.0, 500.0, 5000.0})
      rows.push_back(
          {.name = "sphere dragged over tissue",
           .range = fmt::format("bulk modulus {:g} shear moduli, {}", bulk_by_shear,
                                is_static ? "static" : "dynamic"),
           .study = [=](const Bench& bench) { return study(bench, bulk_by_shear, is_static); }});
  return rows;
}

}  // namespace articular::benchmarks
