#pragma once

#include <span>

#include "sim/model/configuration.hpp"
#include "sim/model/state.hpp"
#include "sim/model/system_matrix.hpp"

/// Muscles and ligaments as lines through points: one tension along the whole path.
namespace articular::sim {

/// From one point of a line to the next.
struct Segment {
  Vec3 direction = Vec3::Zero();  // of length one; zero where the points coincide
  double length = 0;              // [m]
};

/// From point i of a path to the next.
Segment segment(std::span<const WeightedPoint> path, std::size_t i,
                const Configuration& configuration);

/// visit(point, force) for both ends of each segment of a line under a tension [N].
template <class Visit>
void for_each_pull(std::span<const WeightedPoint> path, const Configuration& configuration,
                   double tension, const Visit& visit) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec3 pull = tension * segment(path, i, configuration).direction;
    visit(path[i], pull);
    visit(path[i + 1], -pull);
  }
}

struct LineState {
  double length = 0, rate = 0;  // of the path [m], [m/s]
  double beyond = 0;            // [m] of a muscle's tendon past the end of the path
  double tension = 0;           // [N]; food pushes: less than 0
  double active = 0;     // [N] part of it that does the muscle's work; the rest is stored or damped
  double damping = 0;    // [N] part of it that a ligament's damper makes
  double stored = 0;     // [J] passive muscle or ligament energy
  double stiffness = 0;  // ∂tension/∂length [N/m], not negative: descending parts count as 0
  double viscosity = 0;  // ∂tension/∂rate [N s/m]
  double tension_per_activation = 0;  // [N]
};

/// @param path  its points now: those of Line::path, and of a line that wraps those between them
/// @param boluses  of the model; where there are none, no food pushes
LineState line_state(const Model& model, const Line& line, std::span<const WeightedPoint> path,
                     const Configuration& configuration, std::span<const BolusState> boluses = {});

/// f += a line's pull on its points.
void add_line_force(std::span<const WeightedPoint> path, const Configuration& configuration,
                    double tension, Eigen::VectorXd& f);

/// Moment of a tension of 1 N in a line on a rigid body about a point [m].
Vec3 moment_of_line(std::span<const WeightedPoint> path, const Configuration& configuration,
                    int rigid, const Vec3& about);

/// A += the part of stiffness and damping of a line that does not wrap.
void add_line_stiffness(const Model& model, const Line& line, const Configuration& configuration,
                        const LineState& state, const SystemScale& scale, fem::BlockMatrix& A);

/// Couplings that add_line_stiffness writes.
void append_stencil(const Model& model, const Line& line, Stencils& stencils);

}  // namespace articular::sim
