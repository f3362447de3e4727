#include "tests/sim/support/scene.hpp"

#include <memory>

#include "fem/material/any_material.hpp"
#include "sim/build/build_model.hpp"

namespace articular::sim {

Scenario scene(double step, Integrator::Scheme scheme) {
  Scenario scenario;
  scenario.name = scenario.title = "scene";
  scenario.duration = 1;
  scenario.integrator.scheme = scheme;
  scenario.integrator.step = step;
  scenario.integrator.position_tolerance = 1e-9;
  scenario.contact = false;
  scenario.settings_json = "{}";
  return scenario;
}

TissueMaterial material_of(const fem::AnyMaterial& law) {
  TissueMaterial material;
  material.element = TissueMaterial::Element::Plain;  // the faster one: few tests are of elements
  material.law = std::make_shared<const fem::AnyMaterial>(law);
  return material;
}

TissueMaterial neo_hookean(double E, double nu) { return material_of(fem::NeoHookean(E, nu)); }

TissueMaterial linear(double E, double nu) { return material_of(fem::Linear(E, nu)); }

Body box_body(const std::string& name, Body::Kind kind, const Vec3& size, const Vec3& center,
              const Eigen::Vector3i& cells) {
  Body body;
  body.name = name;
  body.kind = kind;
  body.geometry = BoxGeometry{size, cells, center};
  if (kind != Body::Kind::Fixed) body.density = 1000;
  if (kind == Body::Kind::Tissue) body.material = neo_hookean(20e3, 0.3);
  return body;
}

Body mass_body(const std::string& name, double mass, const Vec3& center, const Vec3& inertia) {
  Body body;
  body.name = name;
  body.kind = Body::Kind::Rigid;
  body.mass = mass;
  body.center_of_mass = center;
  body.inertia = inertia.asDiagonal();
  return body;
}

Body stand(const std::string& name) {
  Body body;
  body.name = name;
  body.kind = Body::Kind::Fixed;
  return body;
}

Attachment attach(const std::string& tissue, const std::string& rigid, const Vec3& low,
                  const Vec3& high) {
  Attachment attachment;
  attachment.body = tissue;
  attachment.to = rigid;
  attachment.region.box = {low, high};
  return attachment;
}

Anchor anchor(const std::string& body, const Vec3& point, double radius) {
  return {body, point, radius, {}};
}

GravityLoad gravity(const Vec3& acceleration) { return {acceleration, {}}; }

MotionLoad shift(const std::string& body, double duration, const Vec3& translation) {
  MotionLoad load;
  load.body = body;
  load.motion.time = {0, duration};
  load.motion.translation = {Vec3::Zero(), translation};
  load.motion.interpolation = Motion::Interpolation::Linear;
  return load;
}

ModelChange detection_margin_of(double margin) {
  return [margin](Model& model) { model.detection_margin = margin; };
}

ModelChange contact_stiffness_of(double stiffness) {
  return [stiffness](Model& model) {
    model.contacts.change([stiffness](ContactModel& contact) {
      contact.mean_stiffness = stiffness;
      contact.softening = contact.opposite = 0;
      contact.layers = 1 / stiffness;
    });
  };
}

namespace {

Model changed(Model model, const ModelChange& change) {
  if (change) change(model);
  return model;
}

Vec6 force_and_moment(const Simulation& simulation, int rigid) {
  const int block = simulation.model.rigid_bodies[static_cast<std::size_t>(rigid)].block;
  return simulation.stepper.now().forces.segment<6>(3 * block);
}

}  // namespace

Simulation::Simulation(const Scenario& scenario, const ModelChange& change)
    : model(changed(build_model(scenario), change)),
      stepper(model, step_settings(scenario)),
      state(stepper.initial()) {}

Vec3 Simulation::force_on(int rigid) const { return force_and_moment(*this, rigid).head<3>(); }

Vec3 Simulation::moment_on(int rigid) const { return force_and_moment(*this, rigid).tail<3>(); }

double Simulation::loss() const { return numerical_loss(state, stepper.stored_energy()); }

Vec3 Random::vec3() {
  const double x = (*this)(), y = (*this)(), z = (*this)();
  return {x, y, z};
}

Eigen::VectorXd Random::vector(Eigen::Index size) {
  return Eigen::VectorXd::NullaryExpr(size, [this] { return (*this)(); });
}

}  // namespace articular::sim
