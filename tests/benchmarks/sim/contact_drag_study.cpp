// What is pushed across a mesh must not feel its lines: the normal force of a rigid sphere that is
// dragged over a block, and of a punch with edges.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <functional>

#include "fem/material/any_material.hpp"
#include "tests/benchmarks/sim/contact_study.hpp"

namespace articular::sim {
namespace {

constexpr double kDragSide = 0.02;  // of the block, half as high [m]
constexpr double kDragYoung = 1e6;  // [Pa]
constexpr double kDragPoisson = 0.3;
constexpr double kDragJitter = 0.2;
constexpr int kPressSteps = 4;
/// The diagonals of the cells are mirrored from one to the next: two cells are a mesh period.
constexpr int kCells = 2, kStepsPerCell = 8;

/// The block's top is z = 0.
void add_block(Scene& scene, int cells, double part) {
  const std::vector<double> side = uniform_lines(-kDragSide / 2, kDragSide / 2, cells);
  MeshData mesh = block_mesh({side, side, uniform_lines(-kDragSide / 2, 0, cells / 2)});
  jitter(mesh, kDragSide / cells, part, 1);
  scene.tissue("block", mesh, fem::NeoHookean(kDragYoung, kDragPoisson));
  Body floor;
  floor.name = "floor";
  floor.kind = Body::Kind::Fixed;
  scene.add(floor);
  scene.tie("block", "floor", -0.501 * kDragSide, -0.499 * kDragSide);
}

/// Down by `depth` beside the middle, then along x over it, by a cell before and behind.
std::vector<Vec3> path(double depth, double h) {
  const double x = 0.5 * kCells * h, y = 0.2 * h;
  return {{-x, y, 0}, {-x, y, -depth}, {x, y, -depth}};
}

double half_range(const Eigen::VectorXd& values) {
  return 0.5 * (values.maxCoeff() - values.minCoeff());
}

Ripple ripple_of(const std::vector<double>& forces) {
  const Eigen::VectorXd f = Eigen::VectorXd::Map(forces.data(), std::ssize(forces));
  const Eigen::VectorXd s = Eigen::VectorXd::LinSpaced(f.size(), -1, 1);
  Eigen::MatrixXd powers(f.size(), 3);
  powers << Eigen::VectorXd::Ones(f.size()), s, s.cwiseProduct(s);
  const Eigen::VectorXd rest = f - powers * powers.colPivHouseholderQr().solve(f);
  Ripple ripple;
  ripple.mean = f.mean();
  ripple.raw = 100 * half_range(f) / f.mean();
  ripple.detrended = 100 * half_range(rest) / f.mean();
  return ripple;
}

Ripple push(const Scene& scene, const StudyOptions& options) {
  ContactRun run(scene, options);
  run.steps(1, kPressSteps);
  run.reset_costs();
  std::vector<double> forces = {run.contact().force.z()};
  double penetration = 0;
  for (int i = 1; i <= kCells * kStepsPerCell; ++i) {
    run.step(1 + static_cast<double>(i) / (kCells * kStepsPerCell));
    forces.push_back(run.contact().force.z());
    penetration = std::max(penetration, run.contact().penetration);
  }
  Ripple ripple = ripple_of(forces);
  ripple.penetration = penetration;
  ripple.costs = run.costs();
  return ripple;
}

template <class Push>
void print_row(const std::string& name, double h, Push&& push) {
  try {
    const Ripple ripple = push();
    std::printf("| %s | %.6f | %.3f | %.3f | %.2f | %s\n", name.c_str(), ripple.mean, ripple.raw,
                ripple.detrended, 100 * ripple.penetration / h, cost_columns(ripple.costs).c_str());
    std::fflush(stdout);
  } catch (const std::exception& error) {
    print_failure(name, error);
  }
}

void print_header(const char* title, const char* first) {
  std::printf(
      "\n## %s\n\n| %s | mean force [N] | ripple [%%] | without trend [%%] | "
      "penetration/h [%%] | %s\n|---|---|---|---|---|%s\n",
      title, first, kCostHeader, kCostRule);
}

constexpr double kDragRadius = kDragSide / 2, kDragIndentation = kDragSide / 20;

Body sphere() {
  Body body;
  body.name = "sphere";
  body.kind = Body::Kind::Fixed;
  body.geometry =
      SphereGeometry{kDragRadius, kDragRadius / 10, {0, 0, kDragRadius}};  // 4,800 facets
  return body;
}

void drag_row(int cells, double part, const StudyOptions& options) {
  const double h = kDragSide / cells;
  print_row(fmt::format("{}{} | {:.1f}", cells, part > 0 ? ", jittered" : "",
                        std::sqrt(kDragRadius * kDragIndentation) / h),
            h, [&] { return drag_sphere(cells, part, options); });
}

constexpr double kPunch = 0.3 * kDragSide;            // the side of its square face [m]
constexpr double kPunchDepth = 0.02 * kDragSide / 2;  // 2 % of the block's height
constexpr double kPunchTurn = 0.5235987755982988;     // 30 degrees

void add_rigid_punch(Scene& scene) {
  Body body;
  body.name = "punch";
  body.kind = Body::Kind::Fixed;
  body.geometry = BoxGeometry{{kPunch, kPunch, kPunch / 2}, {2, 2, 1}, {0, 0, kPunch / 4}};
  body.placement.rotation = {0, 0, kPunchTurn};
  scene.add(body);
  scene.touch("punch", "block");
}

void add_tissue_punch(Scene& scene, double stiffness_ratio) {
  const std::vector<double> side = uniform_lines(-kPunch / 2, kPunch / 2, 3);
  MeshData mesh = block_mesh({side, side, uniform_lines(0, kPunch / 2, 2)});
  Placement turned;
  turned.rotation = {0, 0, kPunchTurn};
  place(turned, mesh.X);
  scene.tissue("tissue punch", mesh, fem::NeoHookean(stiffness_ratio * kDragYoung, kDragPoisson));
  Body press;
  press.name = "punch";
  press.kind = Body::Kind::Fixed;
  scene.add(press);
  scene.tie("tissue punch", "punch", 0.499 * kPunch, 0.501 * kPunch);
  scene.touch("tissue punch", "block");
}

void lines_row(const std::string& name, int cells, double part, const StudyOptions& options,
               const std::function<void(Scene&)>& add_punch) {
  const double h = kDragSide / cells;
  Scene scene(options);
  add_block(scene, cells, part);
  add_punch(scene);
  scene.drive("punch", path(kPunchDepth, h));
  print_row(fmt::format("{}{} | {}", cells, part > 0 ? ", jittered" : "", name), h,
            [&] { return push(scene, options); });
}

}  // namespace

Ripple drag_sphere(int cells, double part, const StudyOptions& options) {
  Scene scene(options);
  add_block(scene, cells, part);
  scene.add(sphere());
  scene.touch("sphere", "block");
  scene.drive("sphere", path(kDragIndentation, kDragSide / cells));
  return push(scene, options);
}

void study_drag(const StudyOptions& options) {
  print_header("Drag: rigid sphere over a block, 8 steps a cell",
               "cells of the block's side | contact radius/h");
  for (const int cells : {8, 12, 16, 26})
    for (const double part : {0.0, kDragJitter})
      if (cells <= options.finest) drag_row(cells, part, options);
}

void study_lines(const StudyOptions& options) {
  print_header("Lines: a square punch, turned by 30 degrees, 2 % deep, 8 steps a cell",
               "cells of the block's side | punch");
  for (const int cells : {8, 16})
    for (const double part : {0.0, kDragJitter}) {
      if (cells > options.finest) continue;
      lines_row("rigid", cells, part, options, add_rigid_punch);
      lines_row("tissue, 10 E", cells, part, options,
                [](Scene& scene) { add_tissue_punch(scene, 10); });
    }
}

}  // namespace articular::sim
