#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/configuration.hpp"
#include "sim/contact_friction.hpp"
#include "sim/contact_patch.hpp"

/// One direction of a contact pair: the patches of a side's triangles opposite the other side's
/// faces, and what they sum to at the nodes of those triangles.
namespace articular::sim {

struct ContactDirection {
  struct Patch {
    ContactPatch patch;
    int triangle = 0, face = 0;
  };
  int contact = 0;            // index into Model::contacts
  bool reversed = false;      // the triangles are the contact's second body's
  std::vector<Patch> stored;  // never shrinks: the patches are the first ones
  std::size_t num_patches = 0;
  std::span<const Patch> patches() const { return {stored.data(), num_patches}; }
  // By node of the side whose triangles these are; zero where it meets nothing:
  Eigen::VectorXd area;                              // W [m²]
  Eigen::VectorXd measure;                           // A [m²]
  Eigen::VectorXd depth;                             // g [m]
  Eigen::VectorXd pressure;                          // p [Pa], with that of damping
  Eigen::VectorXd multiplier;                        // λ [Pa]; empty: none
  std::vector<int> nodes;                            // that have an area
  const Eigen::VectorXd* model_stiffness = nullptr;  // at these nodes [Pa/m]
  double stiffening = 1;
  double stiffness(int node) const { return (*model_stiffness)[node] * stiffening; }  // k [Pa/m]
  /// Where depths are not averaged, k of each point [Pa/m]; then g and p above are but means.
  double point_stiffness = 0;
  std::vector<NodalDrag> drag;  // empty: neither friction nor damping
};

/// The side whose triangles look for faces, and the side whose faces they meet.
struct ContactSides {
  const Collider& triangles;
  const Collider& faces;
  int triangle_body, face_body;
  bool is_self() const { return triangle_body == face_body; }
};
ContactSides sides_of(const Model& model, int contact, bool reversed);
ContactSides sides_of(const Model& model, const ContactDirection& direction);

/// Whether a node of the triangle has pressure.
bool carries(const ContactDirection& direction, int triangle, const Eigen::Matrix3Xi& faces);

/// The six nodes of a patch: the triangle's, then the face's.
std::array<const NodeRef*, 6> nodes_of(const Collider& triangles, const Collider& faces,
                                       int triangle, int face);

/// The corners of a face where they are now [m], one a column.
Mat3 corners_of(const Configuration& configuration, const Collider& collider, int face);

/// Pressures at the nodes of a patch's triangle [Pa].
/// @param faces  of the triangles' side
Vec3 nodal_pressures(const ContactDirection& direction, const ContactDirection::Patch& entry,
                     const Eigen::Matrix3Xi& faces);

/// Forces on a patch's six nodes [N].
Vec18 forces_on_nodes(const ContactDirection& direction, const ContactDirection::Patch& entry,
                      const Eigen::Matrix3Xi& faces);

}  // namespace articular::sim
