#pragma once

#include <optional>
#include <vector>

#include "sim/gap/contact_patch.hpp"
#include "sim/model/surface_law.hpp"

/// Friction and damping of two surfaces in contact, at the nodes a at which depths are averaged
/// (contact_response.hpp). On a patch, u is how the triangle's point moves relative to the face's
/// point opposite: both looked at on the face, where the triangle carries a stick of the length of
/// the depth along its normal. With the weights of the depths,
///
///   V_a = ∫ w N_a u dA / W_a   (over all patches around a; its part across the mean normal)
///   t_a = −μ p_a V_a / √(|V_a|² + v_s²),
///
/// regularised Coulomb friction [Wriggers 2006, ch. 5.2]. The forces on the six nodes are those
/// whose power is Σ W_a t_a·V_a: as u vanishes for a common rigid motion, they are equal and
/// opposite and make no net moment.
///
/// The derivative −∂t/∂V = μ p/s (I − ŝ ŝᵀ), with s = √(|V|² + v_s²) and ŝ = V/s, is next to
/// nothing along a slip faster than v_s: where a node has to stop, Newton's iteration would throw
/// it far to the other side, and on and on. It goes to its end where the friction dual g = ŝ is an
/// unknown of its own, with a matrix of I − (g ŝᵀ + ŝ gᵀ)/2, semidefinite as |g| ≤ 1, the same once
/// they are equal: the primal-dual method for total variation [Chan 1999], whose root is this one.
///
/// [Chan 1999] Chan, Golub, Mulet. A nonlinear primal-dual method for total variation-based image
/// restoration. SIAM J. Sci. Comput. 20:1964.
/// [Wriggers 2006] Wriggers. Computational Contact Mechanics, 2nd ed. Springer.
namespace articular::sim {

struct Collider;
struct Configuration;
struct ContactPairState;

/// At one node: on the side whose triangles are averaged over.
struct NodalDrag {
  Vec3 traction = Vec3::Zero();  // t [Pa]
  Vec3 slip = Vec3::Zero();      // V [m/s]
  Vec3 along = Vec3::Zero();     // unit tangents,
  Vec3 across = Vec3::Zero();    // the axes of the matrix
  double drag_along = 0;         // that stands for −∂t/∂V, along them [Pa s/m]
  double drag_across = 0;
  double closing = 0;     // rate of the mean depth [m/s]
  double pressure = 0;    // of damping, part of the node's [Pa]
  double damping = 0;     // its derivative by `closing` [Pa s/m]
  double stiffening = 1;  // derivative of the node's pressure by that of the penalty
};

/// @param pressure       of the penalty [Pa], > 0
/// @param normal         unit
/// @param friction_dual  g, no longer than 1; none: ŝ
NodalDrag nodal_drag(const SurfaceLaw& law, double pressure, double closing, const Vec3& slip,
                     const Vec3& normal, const std::optional<Vec3>& friction_dual = {});

/// g that goes with a change δV of the slip: g s = V to first order, shortened to 1.
/// @param friction_dual  the last one; none: ŝ
Vec3 next_friction_dual(const SurfaceLaw& law, const Vec3& slip, const Vec3& change,
                        const std::optional<Vec3>& friction_dual);

/// Σ_a t_a·∫ w N_a u dA by the velocities of the six nodes. @param t  one a node of the triangle
Vec18 slip_gradient(const ContactPatch& patch, const Mat3& t);
/// ∫ w N_a u dA [m³/s] for velocities of the six nodes [m/s], one a column.
Mat3 slip_integrals(const ContactPatch& patch, const Eigen::Matrix<double, 3, 6>& v);

/// Drag at the nodes of a contact pair whose depths and pressures are known; adds to the pressures.
void find_drag(const SurfaceLaw& law, const Collider& triangles, const Collider& faces,
               const Configuration& configuration, ContactPairState& pair_state);

/// f += scale D u for velocities u of the blocks, where D is minus the derivative of forces by
/// velocities that drag has.
void add_drag_product(const ContactPairState& pair_state, const Collider& triangles,
                      const Collider& faces, const Configuration& configuration,
                      const Eigen::VectorXd& u, double scale, Eigen::VectorXd& f);

/// Friction duals after a change of the blocks' velocities from those of find_drag().
void update_friction_duals(const SurfaceLaw& law, const Collider& triangles, const Collider& faces,
                           const Configuration& configuration, const Eigen::VectorXd& change,
                           ContactPairState& pair_state);

/// What friction and damping lose [W].
double drag_power(const ContactPairState& pair_state);

}  // namespace articular::sim
