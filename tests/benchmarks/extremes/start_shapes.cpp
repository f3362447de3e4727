// A block whose nodes begin where they can't have come to by themselves is let go, and must find
// its shape again: strain energy gone, by what a strain of 0.1 % has.
#include <fmt/format.h>

#include <random>

#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kShapedSide = 0.01, kShapedYoung = 1e4;  // [m], [Pa]

struct Law {
  std::string words;     // for the table
  std::string material;  // lines of the body
};

Law law(const std::string& name, const std::string& element) {
  return {name + ", " + element,
          solid(1000, name, kShapedYoung, 0.3,
                ", mass_damping = \"20 1/s\", element = \"" + element + "\"")};
}

using Move = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

Finding study(const Bench& bench, const std::string& material, bool tied, const Move& move) {
  std::string scene =
      general(2, 2e-3) + box("block", "tissue", {.cells = {3, 3, 3}}, material) + energy_probe();
  if (tied)
    scene +=
        carrier("floor") + attach("block", "floor", {-1, -1, -1}, {1, 1, 1e-5 - kShapedSide / 2});
  const ProgramRun run =
      bench.run_from("block", scene, 120, [&](const sim::Model& model, sim::State& state) {
        for (int block = 0; block < model.layout.num_free_nodes; ++block) {
          auto x = state.y.segment<3>(model.layout.node_x(block));
          x = move(x);
        }
      });
  if (const auto end = ended_early(run)) return *end;
  const double rest = ScenarioResults(run.results).last("energy.elastic [J]");
  constexpr double kStrain = 1e-3;
  return judged(
      run,
      rest / (0.5 * kShapedYoung * kShapedSide * kShapedSide * kShapedSide * kStrain * kStrain),
      {.right = 1, .stable = 1e6}, "elastic energy by that of 0.1 % strain");
}

void add(const std::string& name, const Law& law, bool tied, const Move& move, bool quick,
         std::vector<Extreme>& rows) {
  rows.push_back(
      {.name = name,
       .range = law.words,
       // Its energy is infinite where an element has no volume.
       .expected = law.words.find("isochoric") == 0 ? Outcome::Refused : Outcome::Right,
       .quick = quick,
       .study = [=](const Bench& bench) { return study(bench, law.material, tied, move); }});
}

}  // namespace

std::vector<Extreme> start_shapes() {
  std::vector<Extreme> rows;
  const std::vector<Law> laws = {law("neo-hookean", "plain"), law("corotated", "plain"),
                                 law("neo-hookean", "smoothed"), law("corotated", "smoothed"),
                                 law("isochoric-neo-hookean", "plain")};
  for (const Law& law : laws) {
    const bool quick = &law == laws.data();
    add(
        "every element inverted", law, true,
        [](const Eigen::Vector3d& x) {
          return Eigen::Vector3d(x.x(), x.y(), -kShapedSide - x.z());
        },
        quick, rows);
    add(
        "turned inside out, nothing held", law, false,
        [](const Eigen::Vector3d& x) { return Eigen::Vector3d(-x); }, quick, rows);
    add(
        "random nodal positions", law, true,
        [random = std::mt19937(1)](const Eigen::Vector3d&) mutable {
          std::uniform_real_distribution<double> place(-kShapedSide / 2, kShapedSide / 2);
          const double x = place(random), y = place(random);
          return Eigen::Vector3d(x, y, place(random));
        },
        quick, rows);
    add(
        "all free nodes in one point", law, true,
        [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 0); }, quick, rows);
  }
  return rows;
}

}  // namespace articular::benchmarks
