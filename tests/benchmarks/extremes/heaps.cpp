// Many bodies fall into one heap on a floor.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/benchmarks/extremes/energy_error.hpp"
#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kCubeSide = 0.005, kCubeGap = 0.001;  // [m]

/// A cube of n³ cubes of rigid bodies or tissue, a little out of line, so that they don't stay a
/// tower.
std::string cubes(int n, bool rigid) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-kCubeGap / 2, kCubeGap / 2);
  std::string text;
  for (int i = 0; i < n * n * n; ++i) {
    const auto at = [&](int k) {
      return (kCubeSide + kCubeGap) * (k - 0.5 * (n - 1)) + jitter(random);
    };
    const double x = at(i % n), y = at(i / n % n);
    const int layer = i / n / n;
    const double z = kCubeSide / 2 + kCubeGap + (kCubeSide + kCubeGap) * layer;
    text +=
        box(fmt::format("cube {}", i), rigid ? "rigid" : "tissue",
            {.size = {kCubeSide, kCubeSide, kCubeSide}, .cells = {1, 1, 1}, .center = {x, y, z}},
            rigid ? density(1000) : solid(1000, "neo-hookean", 1e5, 0.3));
  }
  return text;
}

struct Heap {
  int n;  // cubes along an edge
  bool rigid, pointwise;
};

Finding study(const Bench& bench, const Heap& heap) {
  const std::string response = heap.pointwise ? "contact_response = \"pointwise\"\n" : "";
  const double limit = heap.n == 10 ? 3600 : 300;  // [s]
  const std::string scene =
      response + general(0.2, 1e-3) + cubes(heap.n, heap.rigid) +
      box("floor", "fixed",
          {.size = {0.3, 0.3, 0.01}, .cells = {10, 10, 1}, .center = {0, 0, -0.005}}) +
      gravity(9.81) + energy_probe();
  const ProgramRun run = bench.run("heap", scene, limit);
  if (const auto end = ended_early(run)) return *end;
  std::ifstream in(run.results / "summary.json");
  const double penetration = nlohmann::json::parse(in).at("max_penetration_m");
  Finding finding = judged(run, penetration / kCubeSide, {.right = 0.05, .stable = 0.5},
                           "largest penetration by the side");
  finding.measured += fmt::format("; energy made of nothing: {:.1g}; {:.0f} s of wall time",
                                  energy_created(ScenarioResults(run.results)), run.seconds);
  return finding;
}

}  // namespace

std::vector<Extreme> heaps() {
  std::vector<Extreme> rows;
  for (const Heap& heap :
       {Heap{2, true, false}, Heap{5, true, false}, Heap{10, true, false}, Heap{2, false, false},
        Heap{5, false, true}, Heap{5, false, false}, Heap{10, false, false}})
    rows.push_back({.name = "bodies in one heap",
                    .range = fmt::format("{} {}{}", heap.n * heap.n * heap.n,
                                         heap.rigid ? "rigid" : "of tissue",
                                         heap.pointwise ? ", pointwise" : ""),
                    .quick = heap.n == 2,
                    .study = [heap](const Bench& bench) { return study(bench, heap); }});
  return rows;
}

}  // namespace articular::benchmarks
