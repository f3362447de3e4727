#pragma once

#include <string>

#include "tests/sim/support/scene.hpp"

/// A tissue block on a wall under a plate that is wider than it.
namespace articular::sim {

constexpr double kSide = 0.02;      // of the block [m]
constexpr double kStiffness = 1e7;  // of the contact [Pa/m]

/// The halves of a contact at the sides of the plane x = 0.
inline ContactProbe half(const std::string& first, const std::string& second, double sign) {
  const Vec3 low(sign > 0 ? 0 : -1, -1, -1), high(sign > 0 ? 1 : 0, 1, 1);
  Region region;
  region.box = {low, high};
  return {first, second, region};
}

/// The block does not spread: its pressure is even where the plate stays level.
/// @param down  moves the plate
inline Scenario pressed_block(double step, const MotionLoad& down) {
  Scenario s = scene(step);
  s.contact = true;
  s.bodies = {
      box_body("block", Body::Kind::Tissue, {kSide, kSide, kSide}, Vec3::Zero(), {4, 4, 2}),
      box_body("plate", Body::Kind::Fixed, {2 * kSide, 2 * kSide, kSide}, {0, 0, kSide}, {6, 6, 1}),
      stand("wall")};
  s.bodies[0].material = linear(20e3, 0);
  s.attachments = {attach("block", "wall", {-1, -1, -1}, {1, 1, -0.49 * kSide})};
  s.contacts = {{"plate", "block", {}}};
  s.loads = {down};
  return s;
}

}  // namespace articular::sim
