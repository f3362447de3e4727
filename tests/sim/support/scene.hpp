#pragma once

#include <functional>
#include <random>
#include <string>

#include "sim/step/stepper.hpp"

/// Small scenes put together in code.
namespace articular::sim {

Scenario scene(double step, Integrator::Scheme scheme = Integrator::Scheme::ImplicitEuler);

TissueMaterial material_of(const fem::AnyMaterial& law);
/// Of Young's modulus [Pa] and Poisson's ratio.
TissueMaterial neo_hookean(double E, double nu);
TissueMaterial linear(double E, double nu);

Body box_body(const std::string& name, Body::Kind kind, const Vec3& size,
              const Vec3& center = Vec3::Zero(),
              const Eigen::Vector3i& cells = Eigen::Vector3i::Ones());
/// A rigid body that only has a mass.
Body mass_body(const std::string& name, double mass, const Vec3& center = Vec3::Zero(),
               const Vec3& inertia = Vec3::Ones());
/// A fixed body that only carries points.
Body stand(const std::string& name);

/// The nodes of a tissue between two corners move with a bone.
Attachment attach(const std::string& tissue, const std::string& rigid, const Vec3& low,
                  const Vec3& high);
Anchor anchor(const std::string& body, const Vec3& point, double radius = 0);
GravityLoad gravity(const Vec3& acceleration);
/// A fixed body shifted along a straight line, at constant speed.
MotionLoad shift(const std::string& body, double duration, const Vec3& translation);

/// Sets numbers of a model that no scenario sets.
using ModelChange = std::function<void(Model&)>;
ModelChange detection_margin_of(double margin);      // [m]
ModelChange contact_stiffness_of(double stiffness);  // [Pa/m], of all contacts, at all nodes

/// A scene's model with what advances it.
struct Simulation {
  explicit Simulation(const Scenario& scenario, const ModelChange& change = {});
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
  const Configuration& now() const { return stepper.now().configuration; }
  /// Force [N] and moment [N m] on a bone.
  Vec3 force_on(int rigid) const;
  Vec3 moment_on(int rigid) const;
  double loss() const;

  const Model model;
  Stepper stepper;
  State state;
};

/// Repeatable random numbers in [-1, 1].
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()() { return uniform_(generator_); }
  Vec3 vec3();
  Eigen::VectorXd vector(Eigen::Index size);

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

}  // namespace articular::sim
