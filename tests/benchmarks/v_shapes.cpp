#include "tests/benchmarks/v_shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace articular::benchmarks {
namespace {

using collision::testing::bend_to_v;
using collision::testing::box_mesh;
using collision::testing::jittered;

constexpr double kHeight = 1;         // of a bar [m]
constexpr double kLength = 12;        // of a bar, in heights
constexpr double kWidth = 1.5;        // of a bar, in heights
constexpr double kOpening = 1;        // angle between the legs of two V-shapes [rad]
constexpr double kTurn = 0.25;        // of the second V about the axis of the first [rad]
constexpr double kJitter = 0.05;      // of every node, in cell edges: no two faces stay parallel
constexpr unsigned kSeed = 20030501;  // any, but always the same

double cell_edge(const BarSize& size) { return kHeight / size.height; }

Mesh bar(const BarSize& size) {
  return box_mesh(size.length, size.width, size.height, cell_edge(size));
}

/// Where in its oscillation a frame is, from -1 to 1, such that the mean way from frame to frame
/// along the circle is 1/4 of the full swing or less.
double phase(int frame, int num_frames) {
  return std::sin(2 * std::numbers::pi * (frame + 0.5) / num_frames);
}

}  // namespace

BarSize bar_with(int num_tets) {
  const double height = std::cbrt(num_tets / (6 * kLength * kWidth));
  BarSize size{0, static_cast<int>(std::lround(kWidth * height)),
               static_cast<int>(std::lround(height))};
  size.width = std::max(size.width, 1);
  size.height = std::max(size.height, 1);
  size.length =
      std::max(2, static_cast<int>(std::lround(num_tets / (6.0 * size.width * size.height))));
  return size;
}

Workload two_v_shapes(const BarSize& size, double shift, double motion, int num_frames) {
  std::mt19937 random(kSeed);
  const double edge = cell_edge(size);
  Workload workload;
  workload.bodies.assign(2, bar(size));
  const Eigen::Matrix3Xd v = bend_to_v(workload.bodies[0], kOpening);
  const Eigen::Matrix3Xd a = jittered(v, kJitter * edge, random);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(kTurn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d middle = v.rowwise().mean();
  Eigen::Matrix3Xd b =
      jittered((turn * (v.colwise() - middle)).colwise() + middle, kJitter * edge, random);
  b.row(2).array() += shift;
  for (int i = 0; i < num_frames; ++i) {
    const Eigen::Vector3d way = phase(i, num_frames) * motion * edge * Eigen::Vector3d(0.3, 0.2, 1);
    workload.frames.push_back({a.colwise() - 0.5 * way, b.colwise() + 0.5 * way});
  }
  return workload;
}

Workload crossed_v_shape(const BarSize& size, double angle, double motion, int num_frames) {
  std::mt19937 random(kSeed);
  Workload workload;
  workload.bodies.push_back(bar(size));
  const Mesh& mesh = workload.bodies[0];
  const Eigen::Matrix3Xd jitter =
      jittered(Eigen::Matrix3Xd::Zero(3, mesh.X.cols()), kJitter * cell_edge(size), random);
  const double leg = 0.35 * mesh.X.row(0).maxCoeff();
  for (int i = 0; i < num_frames; ++i) {
    const double turn = phase(i, num_frames) * motion * cell_edge(size) / leg;
    workload.frames.push_back({bend_to_v(mesh, angle + turn) + jitter});
  }
  return workload;
}

}  // namespace articular::benchmarks
