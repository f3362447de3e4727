#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "tests/collision/meshes.hpp"

/// The shapes that collision is measured on: V-shaped bars (Fig. 1.5.4-1.5.7), jittered so that
/// nothing touches.
namespace articular::benchmarks {

using collision::testing::Mesh;

/// Cells of a bar.
struct BarSize {
  int length, width, height;
  int num_tets() const { return 6 * length * width * height; }
};

/// The bar with the proportions of the measurements and nearest to that many tetrahedra.
BarSize bar_with(int num_tets);

/// Positions of all bodies at one time [m].
using Positions = std::vector<Eigen::Matrix3Xd>;

/// One or two bodies and how they move. The frames are to be cycled.
struct Workload {
  std::vector<Mesh> bodies;
  std::vector<Positions> frames;
};

/// Two V-shapes, the second pushed along the axis of the first. The height of the bars is 1 m.
/// @param shift   how far the second is away from the first [m]: less is deeper, 0 is most
/// @param motion  way of a node from frame to frame, in cell edges
Workload two_v_shapes(const BarSize& size, double shift, double motion, int num_frames);

/// One V-shape whose legs go through each other.
/// @param angle  between the legs [rad]; the smaller the deeper, negative where they have crossed
Workload crossed_v_shape(const BarSize& size, double angle, double motion, int num_frames);

}  // namespace articular::benchmarks
