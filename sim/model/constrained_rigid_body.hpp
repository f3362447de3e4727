#pragma once

#include "sim/model/configuration.hpp"
#include "sim/scenario/driven_motion.hpp"

/// Rigid bodies of which some freedoms are held: no velocity along axes that stand in space, of the
/// point p of the rigid body's pose. Translations of that point and a rotation about one axis
/// through it (two held) stay where they are to round-off, as their velocities are none in every
/// stage.
///
/// The point need not be the centre of mass, which lies at c = R center from it:
///
///   ⎡  m I    −m [c]× ⎤ ⎡ v̇ ⎤   ⎡ f − m ω × (ω × c) ⎤
///   ⎣ m [c]×   I_p    ⎦ ⎣ ω̇ ⎦ = ⎣ τ − ω × I_p ω     ⎦ + hold,   I_p = I_c − m [c]× [c]×
///
/// Held freedoms may be driven. The state has the free ones' part alone, p_f, R_f, v_f and ω_f, as
/// without a drive; with its shift s(t), its turn D(t) and the turn's angular velocity ω_D
///
///   p = p_f + s,   R = R_f D,   v = v_f + ṡ,   ω = ω_f + R_f ω_D,
///   v̇ = v̇_f + s̈,   ω̇ = ω̇_f + ω_f × R_f ω_D + R_f ω̇_D
///
/// holds in every stage, and what can vary is what could without.
namespace articular::sim {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Of forces or velocities of a rigid body's translation (k = 0) or rotation (1): onto the free
/// ones.
Mat3 free_projection(const Hold& hold, std::size_t k);

/// Of block forces or velocities of a rigid body (translation, rotation): the part along its free
/// ones.
Vec6 free_part(const RigidBody& rigid, const Vec6& value);

/// Mass matrix of a rigid body about the point of its pose [kg, kg m, kg m²].
Mat6 rigid_mass(const RigidBody& rigid, const Pose& pose);

/// m ω × (ω × c) and ω × I_p ω [N, N m].
Vec6 gyroscopic_force(const RigidBody& rigid, const Pose& pose, const Vec3& omega);

/// Rates v̇_f, ω̇_f of a rigid body's free freedoms [m/s², rad/s²] under block forces about its
/// point.
Vec6 rigid_acceleration(const RigidBody& rigid, const Pose& pose, const RigidVelocity& velocity,
                        Instant at, const Vec6& force);

/// Force and moment, about the rigid body's point, that it puts on what holds it.
Vec6 force_on_hold(const RigidBody& rigid, const Pose& pose, const RigidVelocity& velocity,
                   Instant at, const Vec6& force);

/// Way of a rigid body's driven freedoms from one time to another [m, rad] in the world's axes: its
/// shift and, as a rotation vector, its turn, with R_f as it is where the rigid body has the
/// rotation R at t.
Vec6 driven_way(const RigidBody& rigid, double t_from, double t_to, const Mat3& R, double t);

}  // namespace articular::sim
