#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "sim/contact/contact_friction.hpp"
#include "sim/gap/contact_patch.hpp"
#include "sim/model/configuration.hpp"

/// A contact pair as it stands: the patches of one side's triangles opposite the other side's
/// faces, and what they sum to at the nodes of those triangles: where a node has several smooth
/// groups around it, at each (smoothing_groups.hpp).
namespace articular::sim {

struct ContactPairState {
  struct Patch {
    ContactPatch patch;
    int triangle = 0, face = 0;
    Vec18 forces;  // on its six nodes [N]; of a patch that carries, see find_forces()
  };
  ContactId contact = 0;
  ContactModel pair;          // made once, see ContactPairs
  std::vector<Patch> stored;  // never shrinks: the patches are the first ones
  std::size_t num_patches = 0;
  std::span<const Patch> patches() const { return {stored.data(), num_patches}; }
  // By smoothing group of the side whose triangles these are; zero where it meets nothing:
  Eigen::VectorXd area;                            // W [m²]
  Eigen::VectorXd measure;                         // A [m²]: averaged √(W T), pointwise W
  Eigen::VectorXd depth;                           // g [m]
  Eigen::VectorXd pressure;                        // p [Pa], with that of damping
  Eigen::VectorXd multiplier;                      // λ [Pa]; empty: none
  std::vector<int> groups;                         // that have an area
  Eigen::VectorXd firm_stiffness, soft_stiffness;  // of the groups [Pa/m]
  bool is_soft = false;                            // which of them counts now
  double stiffness(int group) const {              // k [Pa/m], at no depth
    return (is_soft ? soft_stiffness : firm_stiffness)[group];
  }
  /// ∂A/∂W where depths are averaged; 0 where a group meets nothing.
  double measure_slope(int group) const {
    return pair.averaged && area[group] > 0 ? 0.5 * measure[group] / area[group] : 0;
  }
  /// By group, of a pair with a layer that stiffens; else empty, and p = λ + k g.
  std::vector<PressedLayers> on_layers;
  /// λ + k g [Pa], or p(g) of layers: negative where surfaces are apart, k g.
  double signed_pressure(int group) const {
    if (!on_layers.empty()) return on_layers[static_cast<std::size_t>(group)].pressure;
    const double lambda = multiplier.size() > 0 ? multiplier[group] : 0;
    return lambda + stiffness(group) * depth[group];
  }
  /// dp/dg [Pa/m], where surfaces are apart that at no depth.
  double slope(int group) const {
    return on_layers.empty() ? stiffness(group) : on_layers[static_cast<std::size_t>(group)].slope;
  }
  /// Whether a group presses after a change of its depth [m].
  bool presses_after(int group, double change) const {
    return on_layers.empty() ? signed_pressure(group) + stiffness(group) * change > 0
                             : depth[group] + change > 0;
  }
  /// The signed pressure where it presses, else 0 [Pa]: p without that of damping.
  double penalty(int group) const { return std::max(0.0, signed_pressure(group)); }
  /// e with p = de/dg: p²/2k, or that of layers [J/m²].
  double energy_density(int group) const {
    if (!on_layers.empty()) return on_layers[static_cast<std::size_t>(group)].energy;
    const double p = penalty(group);
    return p * p / (2 * stiffness(group));
  }
  /// What Newton's matrix takes groups to do: what they do now, or what was foreseen of them.
  enum class Foreseen : char { AsNow, Presses, IsOpen };
  std::vector<Foreseen> foreseen;  // by group, see contact_forecast.hpp; empty: all as now
  bool presses_in_matrix(int group) const {
    const Foreseen there =
        foreseen.empty() ? Foreseen::AsNow : foreseen[static_cast<std::size_t>(group)];
    return there == Foreseen::AsNow ? pressure[group] > 0 : there == Foreseen::Presses;
  }
  /// Where depths are not averaged, k of each point [Pa/m]; then g and p above are but means.
  double point_stiffness = 0;
  std::vector<NodalDrag> drag;  // empty: neither friction nor damping
  Positions friction_dual;      // g by smoothing group, see contact_friction.hpp; empty: none
};

/// What a pair stores around a group where depths are averaged [J].
double group_energy(const ContactPairState& pair_state, int group);

/// The side whose triangles look for faces, and the side whose faces they meet.
struct ContactSides {
  const Collider& triangles;
  const Collider& faces;
  int triangle_body, face_body;
  bool is_self() const { return triangle_body == face_body; }
};
ContactSides sides_of(const Model& model, const ContactModel& pair);
ContactSides sides_of(const Model& model, const ContactPairState& pair_state);

/// Whether there is pressure at a corner of the triangle.
/// @param groups  of the triangles' side, here and below
bool carries(const ContactPairState& pair_state, int triangle, const Eigen::Matrix3Xi& groups);

/// The six nodes of a patch: the triangle's, then the face's.
std::array<const NodeRef*, 6> nodes_of(const Collider& triangles, const Collider& faces,
                                       int triangle, int face);

/// The corners of a face where they are now [m], one a column.
Mat3 corners_of(const Configuration& configuration, const Collider& collider, int face);

/// A patch's part of Σ p_a A_a δg_a, A_a δg_a = δG_a − g_a δA_a, for p at the nodes of its
/// triangle.
PatchSum mean_depths(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                     const Eigen::Matrix3Xi& groups, const Vec3& p);
/// That of the energy's change; an average's is E_a = A_a e_a, e_a = p_a²/2k_a with p_a = λ_a + k_a
/// g_a.
PatchSum energy_sum(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                    const Eigen::Matrix3Xi& groups);
/// The same with the pressure of damping.
PatchSum pressure_sum(const ContactPairState& pair_state, const ContactPairState::Patch& entry,
                      const Eigen::Matrix3Xi& groups);

/// What a pair stores in all [J].
double stored_energy(const ContactPairState& pair_state, const Eigen::Matrix3Xi& groups);

/// Forces on the six nodes of each patch that carries, by the pressures.
void find_forces(const Eigen::Matrix3Xi& groups, ContactPairState& pair_state);

/// Calls use(nodes, forces) for every patch that carries, with its six nodes and the forces on
/// them.
template <class Use>
void for_each_patch_that_carries(const Model& model, const ContactPairState& pair_state,
                                 Use&& use) {
  const ContactSides side = sides_of(model, pair_state);
  const auto& groups = side.triangles.groups;
  for (const ContactPairState::Patch& entry : pair_state.patches())
    if (carries(pair_state, entry.triangle, groups))
      use(nodes_of(side.triangles, side.faces, entry.triangle, entry.face), entry.forces);
}

}  // namespace articular::sim
