#pragma once

#include <array>

#include "fem/base/types.hpp"

/// Where a moving point goes through a moving triangle.
namespace articular::sim {

struct Passage {
  double when = 0;      // part of the motion, 0 .. 1
  bool inward = false;  // from the triangle's front to behind it; else out again
};

struct Passages {
  std::array<Passage, 3> of;  // in the order of time
  int count = 0;
};

/// The point moves from x0 to x1, each corner of the triangle from its place in q0 to that in q1
/// (corners one a column, counter-clockwise seen from its front), all of them straight and evenly.
/// The times are the roots of
///
///   f(s) = (b − a) × (c − a) · (x − a),
///
/// a cubic, where the point lies in the triangle or on its rim. On its plane counts as in front of
/// it: a point that lies there at the start and ends behind has gone through at s = 0, and motions
/// one after the other have each passage once. A triangle without an area lets everything by.
Passages passages(const Vec3& x0, const Vec3& x1, const Mat3& q0, const Mat3& q1);

}  // namespace articular::sim
