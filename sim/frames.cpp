#include "sim/frames.hpp"

#include "fem/von_mises.hpp"

namespace articular::sim {
namespace {

/// Area of the collider's outer surface that belongs to each node [m²].
Eigen::VectorXd nodal_area(const Collider& collider) {
  Eigen::VectorXd area = Eigen::VectorXd::Zero(collider.X.cols());
  for (std::size_t f = 0; f < collider.face_area.size(); ++f)
    for (int k = 0; k < 3; ++k)
      area[collider.surface.faces(k, static_cast<Eigen::Index>(f))] += collider.face_area[f] / 3;
  return area;
}

std::vector<Field> tissue_point_fields(const Model& model, const Tissue& tissue,
                                       const Configuration& now, const Positions& x,
                                       const Positions& contact_force) {
  const auto num_nodes = x.cols();
  Eigen::MatrixXd velocity(3, num_nodes);
  for (Eigen::Index i = 0; i < num_nodes; ++i)
    velocity.col(i) = now.velocity(tissue.nodes[static_cast<std::size_t>(i)]);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3, num_nodes);
  Eigen::MatrixXd pressure = Eigen::MatrixXd::Zero(1, num_nodes);
  const auto& collider = model.bodies[static_cast<std::size_t>(tissue.body)].collider;
  if (collider && contact_force.cols() == num_nodes) {
    force = contact_force;
    const Eigen::VectorXd area = nodal_area(*collider);
    for (Eigen::Index i = 0; i < num_nodes; ++i)
      if (area[i] > 0) pressure(0, i) = force.col(i).norm() / area[i];
  }
  return {{"displacement", "m", x - tissue.X},
          {"velocity", "m/s", velocity},
          {"contact_force", "N", force},
          {"contact_pressure", "Pa", pressure}};
}

/// @param lags  of the tissue's relaxation
std::vector<Field> tissue_cell_fields(const Tissue& tissue, const Positions& x,
                                      const Configuration& now, const Eigen::VectorXd& lags) {
  const TissueElements& e = tissue.elements;
  const double activation = activation_of(tissue, now);
  Eigen::MatrixXd stress = e.cauchy_stress(x, activation);
  if (tissue.relaxation) tissue.relaxation->add_cauchy_stress(x, lags, stress);
  std::vector<Field> fields = {
      {"cauchy_stress", "Pa", stress},
      {"von_mises", "Pa", fem::von_mises(stress).transpose()},
      {"volume_ratio", "1", e.volume_ratio(x).transpose()},
      {"strain_energy_density", "J/m^3", e.strain_energy_density(x, activation).transpose()}};
  if (tissue.fibres.cols() > 0)
    fields.push_back({"fibre_stretch", "1", e.fibre_stretch(x).transpose()});
  return fields;
}

/// A fixed bone is written once.
bool stands_still(const Bone& bone) { return !bone.unknown && !bone.motion; }

void write_bone(const Model& model, const Configuration& now, const BodyModel& body, int index,
                double time, FrameWriter& writer) {
  const auto b = static_cast<std::size_t>(body.bone);
  if (index > 0 && stands_still(model.bones[b])) {
    writer.repeat_bone(body.name, 0, index, time);
    return;
  }
  const Pose& pose = now.poses[b];
  const Positions x = (pose.R * body.X).colwise() + pose.p;
  const Positions start = body.X.colwise() + model.bones[b].rest.p;
  const RigidVelocity& velocity = now.velocities[b];
  Eigen::MatrixXd v(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    v.col(i) = velocity.linear + velocity.angular.cross(x.col(i) - pose.p);
  writer.write_bone({body.name,
                     x,
                     body.triangles,
                     {{"displacement", "m", x - start}, {"velocity", "m/s", v}},
                     {}},
                    index, time);
}

void write_lines(const Model& model, const Stepper& stepper, int index, double time,
                 FrameWriter& writer) {
  const Configuration& now = stepper.dynamics().configuration();
  const auto count = static_cast<Eigen::Index>(model.lines.size());
  LinesFrame frame;
  Eigen::MatrixXd activation = Eigen::MatrixXd::Zero(1, count), force = activation,
                  length = activation, kind = activation;
  for (Eigen::Index l = 0; l < count; ++l) {
    const Line& line = model.lines[static_cast<std::size_t>(l)];
    const LineState& state = stepper.dynamics().lines()[static_cast<std::size_t>(l)];
    Positions path(3, static_cast<Eigen::Index>(line.path.size()));
    for (std::size_t i = 0; i < line.path.size(); ++i)
      path.col(static_cast<Eigen::Index>(i)) = now.position(line.path[i]);
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

void write_frame(const Model& model, const Stepper& stepper, int index, double time,
                 FrameWriter& writer) {
  const Configuration& now = stepper.dynamics().configuration();
  const std::vector<Positions> contact_forces = stepper.contact_forces();
  for (const BodyModel& body : model.bodies) {
    if (body.tissue >= 0) {
      const Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
      Positions x;
      positions_of(now, tissue.nodes, x);
      writer.write_tissue(
          {body.name, x, tissue.elements.tets(),
           tissue_point_fields(model, tissue, now, x,
                               contact_forces[static_cast<std::size_t>(tissue.body)]),
           tissue_cell_fields(tissue, x, now, stepper.dynamics().lags(body.tissue))},
          index, time);
    } else if (body.X.cols() > 0) {
      write_bone(model, now, body, index, time, writer);
    }
  }
  if (!model.lines.empty()) write_lines(model, stepper, index, time, writer);
  writer.finish_frame(index, time);
}

}  // namespace articular::sim
