#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"

/// What contact carries, for probes, warnings and pictures.
namespace articular::sim {

/// What one contact pair carries; force and moment on body a, of a body with itself none.
struct ContactSummary {
  ContactId contact = 0;
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 center = Vec3::Zero();  // ∫ p x dA / ∫ p dA [m]; where nothing carries, the origin
  Vec3 moment = Vec3::Zero();  // about that centre [N m]
  /// Where that centre is on either body, in the geometry at the start [m].
  Vec3 center_on_a = Vec3::Zero(), center_on_b = Vec3::Zero();
  double area = 0;          // [m²] rest area of what carries, see contact_area.hpp
  double normal_force = 0;  // ∫ p dA over it [N]
  double max_pressure = 0;  // [Pa] around a node of either body, see contact_pressure.hpp
  /// [Pa] normal force through a face, of either body, by its area: of faces without blank corners
  double max_face_pressure = 0;
  bool is_resolved = true;      // or too few nodes have a pressure to tell the largest
  double max_depth = 0;         // [m] mean depth at a node
  Vec3 deepest = Vec3::Zero();  // that node [m]
  double max_point_depth = 0;   // [m] of any point: facets can't follow a curve
  double energy = 0;            // [J]
};

/// What contact with all others puts on the surface of one body.
struct SurfaceContact {
  Eigen::VectorXd node_pressure;  // [Pa] see contact_pressure.hpp; NaN where it is not resolved
  Eigen::VectorXd face_pressure;  // [Pa] normal force through a face by its area now
  Eigen::VectorXd face_gap;       // [m] mean over what lies opposite another surface, < 0 in
                                  // penetration; NaN where nothing does within the open depth
};

/// Of the contacts where something is near, in the order of the model.
std::vector<ContactSummary> contact_summaries(const Model& model, const ContactResponse& response,
                                              const Configuration& configuration);
/// What one contact carries through a part of a body's surface.
/// @param selected  by face of the body's collider; the body is one of the contact's two; empty:
/// all
ContactSummary summary_through(const Model& model, const ContactResponse& response,
                               const Configuration& configuration, ContactId contact, int body,
                               const std::vector<char>& selected);

/// Contact force at each node of each collider [N] (by body).
std::vector<Positions> nodal_contact_forces(const Model& model, const ContactResponse& response);
/// By body, over the nodes and faces of its collider; empty without one.
std::vector<SurfaceContact> surface_contacts(const Model& model, const ContactResponse& response,
                                             const Configuration& configuration);

}  // namespace articular::sim
