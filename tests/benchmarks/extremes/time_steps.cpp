// A column that gravity begins to pull at t = 0 swings about its sag, ρ g L²/2E, in 10.3 ms. The
// closed form of its tip, from the modes of a bar, holds for any t.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kColumnLength = 0.01, kColumnDensity = 1000, kColumnYoung = 15e3,
                 kColumnGravity = 9.81;  // SI
constexpr double kColumnSag =
    kColumnDensity * kColumnGravity * kColumnLength * kColumnLength / (2 * kColumnYoung);  // [m]

double tip(double t) {
  constexpr int kModes = 100;
  const double c = std::sqrt(kColumnYoung / kColumnDensity);
  double u = 0;
  for (int k = 0; k < kModes; ++k) {
    const double wave = (2 * k + 1) * std::numbers::pi / (2 * kColumnLength);
    u += (k % 2 == 0 ? 1 : -1) * 2 * kColumnGravity / (kColumnLength * c * c * wave * wave * wave) *
         (1 - std::cos(wave * c * t));
  }
  return u;
}

std::string scene(double step, const std::string& scheme) {
  const double period = 4 * kColumnLength / std::sqrt(kColumnYoung / kColumnDensity);
  return general(std::max(period, 10 * step), step, "", "scheme = \"" + scheme + "\"") +
         carrier("ceiling") +
         box("column", "tissue",
             {.size = {0.002, 0.002, kColumnLength},
              .cells = {1, 1, 10},
              .center = {0, 0, -kColumnLength / 2}},
             solid(kColumnDensity, "linear", kColumnYoung, 0)) +
         attach("column", "ceiling", {-1, -1, -1e-9}, {1, 1, 1}) + gravity(kColumnGravity) +
         point_probe("tip", "column", {0.001, 0.001, -kColumnLength}) + energy_probe();
}

Finding study(const Bench& bench, double step, const std::string& scheme) {
  const ProgramRun run = bench.run("column", scene(step, scheme), 120);
  if (const auto end = ended_early(run)) return *end;
  const ScenarioResults results(run.results);
  const auto &t = results.column("time [s]"), &z = results.column("tip.position.z [m]");
  double error = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    error = std::max(error, std::abs(-kColumnLength - z[i] - tip(t[i])) / kColumnSag);
  // Undamped it swings to twice the sag: more would be instability.
  return judged(run, error, {.right = 0.05, .stable = 2.2}, "largest error of the tip by the sag");
}

Extreme row(double step, const std::string& scheme, Outcome expected) {
  return {.name = "time step, " + scheme,
          .range = fmt::format("{:g} s", step),
          .expected = expected,
          .quick = step >= 1e-4,
          .study = [=](const Bench& bench) { return study(bench, step, scheme); }};
}

}  // namespace

std::vector<Extreme> time_steps() {
  std::vector<Extreme> rows;
  for (const double step : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0})
    rows.push_back(row(step, "implicit-euler", step < 5e-5 ? Outcome::Right : Outcome::Degraded));
  for (const double step : {1e-6, 1e-4, 1e-2, 1.0})
    rows.push_back(row(step, "dirk-3", step < 5e-4 ? Outcome::Right : Outcome::Degraded));
  return rows;
}

}  // namespace articular::benchmarks
