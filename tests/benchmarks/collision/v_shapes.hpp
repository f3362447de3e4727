#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/collision/support/meshes.hpp"

/// The shapes that collision is measured on: V-shaped bars (Fig. 1.5.4-1.5.7), jittered so that
/// nothing touches.
namespace articular::benchmarks {

using collision::testing::Mesh;

/// Cells of a bar.
struct BarSize {
  int length, width, height;
  int num_tets() const { return 6 * length * width * height; }
};

/// The bar with the proportions of the measurements and nearly that many tetrahedra.
BarSize bar_with(int num_tets);

/// Positions of all bodies at one time [m].
using Positions = std::vector<Eigen::Matrix3Xd>;

/// V-shapes that go through each other along a path with one parameter.
class VShapes {
 public:
  virtual ~VShapes() = default;
  /// How far apart the shapes are: the less, the more pairs, down to `deepest()`.
  virtual Positions at(double apart) const = 0;
  virtual double deepest() const = 0;
  virtual double separate() const = 0;  // from here on there are no pairs
  /// Change of the parameter that moves the most moving nodes by an edge of a cell to each other.
  virtual double per_edge() const = 0;

  const std::vector<Mesh>& bodies() const { return bodies_; }
  int num_tets() const { return static_cast<int>(bodies_[0].tets.cols()); }  // of a body
  std::vector<collision::MeshView> views(const Positions& x) const;

 protected:
  std::vector<Mesh> bodies_;
};

/// Two V-shapes, one pushed through the other along its axis. Apart by a length; bars are 1 m high.
class TwoVShapes final : public VShapes {
 public:
  explicit TwoVShapes(const BarSize& size);
  Positions at(double apart) const override;
  double deepest() const override { return 0; }
  double separate() const override { return 2.5; }
  double per_edge() const override { return cell_edge_; }

 private:
  double cell_edge_;        // [m]
  Eigen::Matrix3Xd a_, b_;  // in the same place [m]
};

/// One V-shape whose legs go through each other. Apart by the angle between them.
class CrossedVShape final : public VShapes {
 public:
  explicit CrossedVShape(const BarSize& size);
  Positions at(double apart) const override;
  double deepest() const override { return -0.6; }
  double separate() const override { return -0.2; }
  double per_edge() const override { return cell_edge_ / leg_; }

 private:
  double cell_edge_;         // [m]
  double leg_;               // length that the angle turns [m]
  Eigen::Matrix3Xd jitter_;  // [m]
};

/// Frames to be cycled, in the middle `apart` from each other.
/// @param motion  way of a node from frame to frame at most, in cell edges
std::vector<Positions> oscillation(const VShapes& shapes, double apart, double motion);

}  // namespace articular::benchmarks
