#include "tests/benchmarks/collision/v_shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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

int at_least_one(double cells) { return std::max(1, static_cast<int>(std::lround(cells))); }

}  // namespace

BarSize bar_with(int num_tets) {
  const double height = std::cbrt(num_tets / (6 * kLength * kWidth));
  BarSize size{0, at_least_one(kWidth * height), at_least_one(height)};
  size.length = at_least_one(num_tets / (6.0 * size.width * size.height));
  return size;
}

std::vector<collision::MeshView> VShapes::views(const Positions& x) const {
  std::vector<collision::MeshView> views;
  for (std::size_t k = 0; k < bodies_.size(); ++k) views.push_back(bodies_[k].at(x[k]));
  return views;
}

TwoVShapes::TwoVShapes(const BarSize& size) : cell_edge_(cell_edge(size)) {
  std::mt19937 random(kSeed);
  bodies_.assign(2, bar(size));
  const Eigen::Matrix3Xd v = bend_to_v(bodies_[0], kOpening);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(kTurn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d middle = v.rowwise().mean();
  const Eigen::Matrix3Xd turned = (turn * (v.colwise() - middle)).colwise() + middle;
  a_ = jittered(v, kJitter * cell_edge_, random);
  b_ = jittered(turned, kJitter * cell_edge_, random);
}

Positions TwoVShapes::at(double apart) const {
  // Both move, as no method shall gain by a body that rests.
  const Eigen::Vector3d way(0, 0, 0.5 * apart);
  return {a_.colwise() - way, b_.colwise() + way};
}

CrossedVShape::CrossedVShape(const BarSize& size) : cell_edge_(cell_edge(size)) {
  std::mt19937 random(kSeed);
  bodies_.push_back(bar(size));
  leg_ = 0.35 * bodies_[0].X.row(0).maxCoeff();  // bend_to_v bends the middle 30 % of the bar
  jitter_ = jittered(Eigen::Matrix3Xd::Zero(3, bodies_[0].X.cols()), kJitter * cell_edge_, random);
}

Positions CrossedVShape::at(double apart) const { return {bend_to_v(bodies_[0], apart) + jitter_}; }

std::vector<Positions> oscillation(const VShapes& shapes, double apart, double motion) {
  const double step = motion * shapes.per_edge();
  return {shapes.at(apart), shapes.at(apart + step), shapes.at(apart), shapes.at(apart - step)};
}

}  // namespace articular::benchmarks
