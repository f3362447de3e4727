#include "sim/output/frames.hpp"

#include "fem/material/von_mises.hpp"
#include "fem/mesh/fibre_field.hpp"

namespace articular::sim {
namespace {

/// What contact puts on all bodies' surfaces, each by body.
struct Contacts {
  std::vector<Positions> forces;  // at the nodes of colliders [N]
  std::vector<SurfaceContact> surfaces;
};

/// At the first nodes of a body's collider.
std::vector<Field> contact_point_fields(const Contacts& contacts, std::size_t body,
                                        Eigen::Index num_nodes) {
  return {{"contact_force", "N", contacts.forces[body].leftCols(num_nodes)},
          {.name = "contact_pressure",
           .unit = "Pa",
           .values = contacts.surfaces[body].node_pressure.head(num_nodes).transpose(),
           .may_be_blank = true}};
}

void append(std::vector<Field> more, std::vector<Field>& fields) {
  for (Field& field : more) fields.push_back(std::move(field));
}

std::vector<Field> tissue_point_fields(const Model& model, const Tissue& tissue,
                                       const Configuration& now, const Positions& x,
                                       const Contacts& contacts) {
  const auto num_nodes = x.cols();
  std::vector<Field> fields = {{"displacement", "m", x - tissue.X}};
  if (!model.is_static) {
    Eigen::MatrixXd velocity(3, num_nodes);
    for (Eigen::Index i = 0; i < num_nodes; ++i)
      velocity.col(i) = now.velocity(tissue.nodes[static_cast<std::size_t>(i)]);
    append({{"velocity", "m/s", std::move(velocity)}}, fields);
  }
  const auto body = static_cast<std::size_t>(tissue.body);
  if (model.bodies[body].collider)
    append(contact_point_fields(contacts, body, num_nodes), fields);
  else  // pictures of scenes without contact have the same arrays
    append({{"contact_force", "N", Eigen::MatrixXd::Zero(3, num_nodes)},
            {"contact_pressure", "Pa", Eigen::MatrixXd::Zero(1, num_nodes)}},
           fields);
  return fields;
}

std::vector<Field> tissue_cell_fields(const Tissue& tissue, const TissueMoment& state,
                                      const Configuration& now) {
  const TissueElements& e = tissue.elements;
  const Positions& x = state.x;
  const double activation = activation_of(tissue, now);
  const Eigen::MatrixXd stress = cauchy_stress(tissue, state, now);
  std::vector<Field> fields = {
      {"cauchy_stress", "Pa", stress},
      {"von_mises", "Pa", fem::von_mises(stress).transpose()},
      {"volume_ratio", "1", e.volume_ratio(x).transpose()},
      {"strain_energy_density", "J/m^3", e.strain_energy_density(x, activation).transpose()}};
  if (tissue.fibres.cols() > 0)
    append({{"fibre_stretch", "1", e.fibre_stretch(x).transpose()},
            {"fibre_direction", "1", fem::moved_fibres(tissue.X, e.tets(), tissue.fibres, x)}},
           fields);
  return fields;
}

/// The drawn mesh of a rigid body is also what touches: its nodes are the collider's first ones.
bool draws_contact_surface(const Model& model, int body) {
  return model.contacts.touches(body) &&
         model.bodies[static_cast<std::size_t>(body)].touches_as_drawn;
}

void write_rigid_body(const Model& model, const Configuration& now, int body_index,
                      const Contacts& contacts, int index, double time, FrameWriter& writer) {
  const BodyModel& body = model.bodies[static_cast<std::size_t>(body_index)];
  const auto b = static_cast<std::size_t>(body.rigid);
  const bool shows_contact = draws_contact_surface(model, body_index);
  const bool stands_still = !model.rigid_bodies[b].unknown && !model.rigid_bodies[b].motion;
  if (index > 0 && stands_still && !shows_contact) {
    writer.repeat_rigid_body(body.name, 0, index, time);
    return;
  }
  const Pose& pose = now.poses[b];
  const Positions x = (pose.R * body.X).colwise() + pose.p;
  const Positions start = start_positions(model, body);
  std::vector<Field> fields = {{"displacement", "m", x - start}};
  if (!model.is_static) {
    const RigidVelocity& velocity = now.velocities[b];
    Eigen::MatrixXd v(3, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      v.col(i) = velocity.linear + velocity.angular.cross(x.col(i) - pose.p);
    append({{"velocity", "m/s", std::move(v)}}, fields);
  }
  if (shows_contact)
    append(contact_point_fields(contacts, static_cast<std::size_t>(body_index), x.cols()), fields);
  writer.write_rigid_body({body.name, x, body.triangles, std::move(fields), {}}, index, time);
}

void write_contact_surface(const Model& model, const Configuration& now, int body_index,
                           const Contacts& contacts, int index, double time, FrameWriter& writer) {
  const auto b = static_cast<std::size_t>(body_index);
  const Collider& collider = *model.bodies[b].collider;
  const SurfaceContact& surface = contacts.surfaces[b];
  Positions x;
  positions_of(now, collider.nodes, x);
  writer.write_contact_surface({model.bodies[b].name,
                                x,
                                collider.surface.faces,
                                contact_point_fields(contacts, b, x.cols()),
                                {{"contact_pressure", "Pa", surface.face_pressure.transpose()},
                                 {.name = "contact_gap",
                                  .unit = "m",
                                  .values = surface.face_gap.transpose(),
                                  .may_be_blank = true}}},
                               index, time);
}

void write_lines(const Model& model, const Stepper& stepper, int index, double time,
                 FrameWriter& writer) {
  const Configuration& now = stepper.now().configuration;
  const auto count = static_cast<Eigen::Index>(model.lines.size());
  LinesFrame frame;
  Eigen::MatrixXd activation = Eigen::MatrixXd::Zero(1, count), force = activation,
                  length = activation, kind = activation;
  for (Eigen::Index l = 0; l < count; ++l) {
    const Line& line = model.lines[static_cast<std::size_t>(l)];
    const LineState& state = stepper.now().lines[static_cast<std::size_t>(l)];
    const std::span<const WeightedPoint> points =
        path_of(stepper.now(), static_cast<std::size_t>(l));
    Positions path(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      path.col(static_cast<Eigen::Index>(i)) = now.position(points[i]);
    frame.names.push_back(line.name);
    frame.paths.push_back(std::move(path));
    if (line.muscle >= 0) activation(0, l) = now.activation[line.muscle];
    force(0, l) = state.tension;
    length(0, l) = state.length;
    kind(0, l) = line.muscle >= 0 ? 0 : 1;
  }
  frame.cell_fields = {{"activation", "1", activation},
                       {"force", "N", force},
                       {"length", "m", length},
                       {"kind", "1", kind}};
  writer.write_lines(frame, index, time);
}

}  // namespace

void write_frame(const Model& model, const Stepper& stepper, bool contact_surfaces, int index,
                 double time, FrameWriter& writer) {
  const Configuration& now = stepper.now().configuration;
  const ContactResponse& contact = stepper.now().contact;
  const Contacts contacts{nodal_contact_forces(model, contact),
                          surface_contacts(model, contact, now)};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const int body_index = static_cast<int>(b);
    if (body.tissue >= 0) {
      const auto t = static_cast<std::size_t>(body.tissue);
      const Tissue& tissue = model.tissues[t];
      const TissueMoment& state = stepper.now().tissues[t];
      writer.write_tissue({body.name, state.x, tissue.elements.tets(),
                           tissue_point_fields(model, tissue, now, state.x, contacts),
                           tissue_cell_fields(tissue, state, now)},
                          index, time);
    } else if (body.X.cols() > 0) {
      write_rigid_body(model, now, body_index, contacts, index, time, writer);
    }
    if (contact_surfaces && model.contacts.touches(body_index))
      write_contact_surface(model, now, body_index, contacts, index, time, writer);
  }
  if (!model.lines.empty()) write_lines(model, stepper, index, time, writer);
  writer.finish_frame(index, time);
}

}  // namespace articular::sim
