// Bad meshes under a uniform strain, which linear tetrahedra hold exactly whatever their shape.
#include <fmt/format.h>

#include <cmath>

#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/shapes.hpp"
#include "tests/benchmarks/extremes/judge.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

constexpr double kMeshedSide = 0.01, kMeshedYoung = 1e4, kMeshedStrain = 0.01;  // [m], [Pa]

std::string material(const std::string& element) {
  return solid(1000, "corotated", kMeshedYoung, 0, ", element = \"" + element + "\"");
}

/// Presses a block of this height, from z = 0, by 1 %: at once in statics, in 2 s in time.
Finding press(const Bench& bench, const std::string& block, double height, bool is_static) {
  const std::string scene = (is_static ? statics(1, 1) : general(3, 0.02)) + carrier("floor") +
                            carrier("press") + block +
                            attach("block", "floor", {-1, -1, -1}, {1, 1, 1e-9}) +
                            attach("block", "press", {-1, -1, (1 - 1e-6) * height}, {1, 1, 1}) +
                            motion("press", is_static ? 1 : 2, {0, 0, -kMeshedStrain * height}) +
                            reaction_probe("floor", "floor");
  const ProgramRun run = bench.run("press", scene, 120);
  if (const auto end = ended_early(run)) return *end;
  const double force = std::abs(ScenarioResults(run.results).last("floor.force.z [N]"));
  return judged(run,
                std::abs(force / (kMeshedYoung * kMeshedSide * kMeshedSide * kMeshedStrain) - 1),
                {.right = 0.01, .stable = 0.3}, "force against E A ε");
}

/// Elements whose edges are 5 mm and 5 mm/ratio.
Finding stretched(const Bench& bench, double ratio, const std::string& element, bool is_static) {
  const double height = 4 * 0.5 * kMeshedSide / ratio;
  return press(bench,
               box("block", "tissue",
                   {.size = {kMeshedSide, kMeshedSide, height},
                    .cells = {2, 2, 4},
                    .center = {0, 0, height / 2}},
                   material(element)),
               height, is_static);
}

std::string written(const Bench& bench, const sim::MeshData& mesh, const std::string& element) {
  sim::write_mesh(bench.folder() / "block.vtu", mesh, 1);
  return "[[body]]\nname = \"block\"\nkind = \"tissue\"\nmesh = { file = \"block.vtu\", unit = "
         "\"m\" "
         "}\n" +
         material(element);
}

sim::MeshData block_mesh(int cells) {
  return sim::box_mesh({.size = {kMeshedSide, kMeshedSide, kMeshedSide},
                        .cells = Eigen::Vector3i::Constant(cells),
                        .center = {0, 0, kMeshedSide / 2}});
}

/// The inner node of a block of 2 x 2 x 2 cells almost in its bottom: elements with this height by
/// their longest edge.
Finding slivers(const Bench& bench, double flatness, const std::string& element, bool is_static) {
  sim::MeshData mesh = block_mesh(2);
  for (auto x : mesh.X.colwise())
    if (x.isApprox(Eigen::Vector3d(0, 0, kMeshedSide / 2), 1e-9)) x.z() = flatness * kMeshedSide;
  return press(bench, written(bench, mesh, element), kMeshedSide, is_static);
}

/// Seven cells a side, each longer than the one before: sizes 1 : 1000.
Finding graded(const Bench& bench, const std::string& element, bool is_static) {
  constexpr int kCells = 7;
  const double growth = std::pow(1000, 1.0 / (kCells - 1));
  const auto place = [&](double x) {  // of 0..1, by cells
    return (std::pow(growth, kCells * x) - 1) / (std::pow(growth, kCells) - 1);
  };
  sim::MeshData mesh = block_mesh(kCells);
  for (auto x : mesh.X.colwise())
    x = kMeshedSide * Eigen::Vector3d(place(x.x() / kMeshedSide + 0.5) - 0.5,
                                      place(x.y() / kMeshedSide + 0.5) - 0.5,
                                      place(x.z() / kMeshedSide));
  return press(bench, written(bench, mesh, element), kMeshedSide, is_static);
}

}  // namespace

std::vector<Extreme> meshes() {
  std::vector<Extreme> rows;
  const auto add = [&](const std::string& name, const std::string& range, Outcome expected,
                       bool quick, const auto& study) {
    for (const bool is_static : {true, false})
      for (const std::string element : {"plain", "smoothed"})
        rows.push_back(
            {.name = name,
             .range = fmt::format("{}, {}, {}", range, is_static ? "static" : "dynamic", element),
             .expected = expected,
             .quick = quick && is_static && element == "plain",
             .study = [=](const Bench& bench) { return study(bench, element, is_static); }});
  };
  for (const double ratio : {1e2, 1e4})
    add("stretched elements", fmt::format("{:g}:1", ratio), Outcome::Right, true,
        [=](const Bench& bench, const std::string& element, bool is_static) {
          return stretched(bench, ratio, element, is_static);
        });
  for (const double flatness : {1e-3, 1e-6, 1e-9, 1e-15})
    add("slivers", fmt::format("height 1:{:g}", 1 / flatness),
        flatness < 1e-12 ? Outcome::Refused : Outcome::Right, flatness == 1e-6,
        [=](const Bench& bench, const std::string& element, bool is_static) {
          return slivers(bench, flatness, element, is_static);
        });
  add("graded mesh", "sizes 1:1000", Outcome::Right, true, graded);
  return rows;
}

}  // namespace articular::benchmarks
