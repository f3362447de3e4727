#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "fem/any_material.hpp"
#include "sim/stepper.hpp"

/// Small scenes put together in code.
namespace articular::sim {

inline Scenario scene(double step, Integrator::Scheme scheme = Integrator::Scheme::ImplicitEuler) {
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

inline Material material_of(const fem::Material& law) {
  Material material;
  material.law = std::make_shared<const fem::Material>(law);
  return material;
}

inline Body box_body(const std::string& name, Body::Kind kind, const Vec3& size,
                     const Vec3& center = Vec3::Zero(),
                     const Eigen::Vector3i& cells = Eigen::Vector3i::Ones()) {
  Body body;
  body.name = name;
  body.kind = kind;
  body.box = BoxGeometry{size, cells, center};
  if (kind != Body::Kind::Fixed) body.density = 1000;
  if (kind == Body::Kind::Tissue) body.material = material_of(fem::NeoHookean(20e3, 0.3));
  return body;
}

/// A rigid body that only has a mass.
inline Body mass_body(const std::string& name, double mass, const Vec3& center = Vec3::Zero(),
                      const Vec3& inertia = Vec3::Ones()) {
  Body body;
  body.name = name;
  body.kind = Body::Kind::Rigid;
  body.mass = mass;
  body.center_of_mass = center;
  body.inertia = inertia.asDiagonal();
  return body;
}

/// A fixed body that only carries points.
inline Body stand(const std::string& name) {
  Body body;
  body.name = name;
  body.kind = Body::Kind::Fixed;
  return body;
}

/// The nodes of a tissue between two corners move with a bone.
inline Attachment attach(const std::string& tissue, const std::string& bone, const Vec3& low,
                         const Vec3& high) {
  Attachment attachment;
  attachment.body = tissue;
  attachment.to = bone;
  attachment.region.box = {low, high};
  return attachment;
}

inline Anchor anchor(const std::string& body, const Vec3& point, double radius = 0) {
  return {body, point, radius, {}};
}

inline Load gravity(const Vec3& acceleration) {
  Load load;
  load.acceleration = acceleration;
  return load;
}

/// A fixed body shifted along a straight line, at constant speed.
inline Load shift(const std::string& body, double duration, const Vec3& translation) {
  Load load;
  load.kind = Load::Kind::Motion;
  load.body = body;
  load.motion.time = {0, duration};
  load.motion.translation = {Vec3::Zero(), translation};
  load.motion.smooth = false;
  return load;
}

/// A scene's model with what advances it.
struct Simulation {
  explicit Simulation(Scenario scenario)
      : model(build_model(std::move(scenario))), stepper(model), state(stepper.initial()) {}
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Steps until a time; each(…) is called after every step.
  template <class Each>
  void advance(double until, Each&& each) {
    while (state.t < until) {
      stepper.step(state, until);
      each();
    }
  }
  void advance(double until) {
    advance(until, [] {});
  }
  const Configuration& now() const { return stepper.dynamics().configuration(); }
  /// Force [N] and moment [N m] on a bone.
  Vec3 force_on(int bone) const { return bone_force(bone, 0); }
  Vec3 moment_on(int bone) const { return bone_force(bone, 3); }
  double loss() const { return numerical_loss(state, stepper.stored_energy()); }

  const Model model;
  Stepper stepper;
  State state;

 private:
  Vec3 bone_force(int bone, int offset) const {
    const int block = model.bones[static_cast<std::size_t>(bone)].block;
    return stepper.dynamics().forces().segment<3>(3 * block + offset);
  }
};

/// Repeatable random numbers in [-1, 1].
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()() { return uniform_(generator_); }
  Vec3 vec3() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }
  Eigen::VectorXd vector(Eigen::Index size) {
    return Eigen::VectorXd::NullaryExpr(size, [this] { return (*this)(); });
  }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

}  // namespace articular::sim
