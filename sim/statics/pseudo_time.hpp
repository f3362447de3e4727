#pragma once

/// How long the steps in pseudo-time are by which a static solution approaches equilibrium, said by
/// how far they move what the forces accelerate most.
namespace articular::sim {

/// Of the trusted motion: the first step.
inline constexpr double kFirstMotion = 0.25;
/// After a solution that was found, and after one that was not.
inline constexpr double kMotionRise = 4, kMotionFall = 0.2;

}  // namespace articular::sim
