#pragma once

#include <vector>

#include "sim/model/configuration.hpp"
#include "sim/model/state.hpp"

/// Motion as a fixed or rigid body sees it, in a frame that goes with the body and lies as the
/// world's at the start. Frames are indices into Model::rigid_bodies; -1: the world's.
namespace articular::sim {

/// Of a place x [m], in world coordinates.
Vec3 position_in(int frame, const Model& model, const Configuration& now, const Vec3& x);
/// Of a place x that moves with v [m/s].
Vec3 velocity_in(int frame, const Configuration& now, const Vec3& x, const Vec3& v);

Vec3 position_of(const PointInFrame& place, const Model& model, const Configuration& now);
Vec3 velocity_of(const PointInFrame& place, const Configuration& now);

/// Of each ObservedWay of the model's probes.
std::vector<Way> ways_that_begin(const Model& model, const Configuration& start);
/// By a step.
void lengthen(const Model& model, const Configuration& before, const Configuration& after,
              std::vector<Way>& ways);

/// Any motion of a rigid body is a turn about an axis and a slide along it.
struct HelicalAxis {
  Vec3 direction = Vec3::UnitX();  // unit vector: of the turn, which is positive
  Vec3 center = Vec3::Zero();      // of the axis, its point next to a given one [m]
  double turn = 0;                 // [rad], up to π; or [rad/s]
  double slide = 0;                // along the direction [m]; or [m/s]
};

/// Of the turn R, which is more than nothing, of a body of which a point has come from q to q_now
/// [m]; next to q.
HelicalAxis helical_axis(const Mat3& R, const Vec3& q, const Vec3& q_now);
/// Of a body that turns by ω ≠ 0 [rad/s], of which the point q moves with v [m/s]; next to q.
HelicalAxis instant_axis(const Vec3& omega, const Vec3& q, const Vec3& v);

}  // namespace articular::sim
