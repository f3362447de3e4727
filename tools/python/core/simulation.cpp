#include "tools/python/core/simulation.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "sim/base/error.hpp"
#include "sim/scenario/curve.hpp"

namespace articular::python {
namespace {

void check_part(double value, const char* name) {
  if (!(value >= 0 && value <= 1))
    throw std::invalid_argument(fmt::format("{}: expected 0 to 1, found {}", name, value));
}

const sim::Tissue& tissue_of(const sim::Model& model, int body) {
  const sim::BodyModel& given = model.bodies[static_cast<std::size_t>(body)];
  if (given.tissue >= 0) return model.tissues[static_cast<std::size_t>(given.tissue)];
  throw sim::InputError(fmt::format(
      "`{}` is a bone, whose nodes have no forces of their own: `contacts` has the force on it",
      given.name));
}

/// Of the nodes of a bone's mesh; those of a tissue know what moves them.
void fill_bone(const sim::Model& model, const sim::Configuration& now, Quantity quantity, int body,
               Positions& values) {
  const sim::BodyModel& bone = model.bodies[static_cast<std::size_t>(body)];
  const auto rigid = static_cast<std::size_t>(bone.rigid);
  const sim::Pose& pose = now.poses[rigid];
  const sim::RigidVelocity& velocity = now.velocities[rigid];
  for (Eigen::Index i = 0; i < bone.X.cols(); ++i) {
    const Vec3 lever = pose.R * bone.X.col(i);
    values.col(i) = quantity == Quantity::Position
                        ? Vec3(pose.p + lever)
                        : velocity.linear + velocity.angular.cross(lever);
  }
}

}  // namespace

std::shared_ptr<Simulation> Simulation::begin(std::shared_ptr<Scene> scene) {
  auto self = std::make_shared<Simulation>(std::move(scene));
  const Computing computing(*self->scene_);
  SignalWatch& signals = self->signals_;
  try {
    const py::gil_scoped_release release;
    self->own_model_ = std::make_unique<sim::Model>(self->scene_->model);
    self->own_course_ = std::make_unique<sim::Course>(self->scene_->scenario, *self->own_model_);
    self->course_ = self->own_course_.get();
    self->course_->set_stop([&signals] { return signals.is_raised(); });
    self->course_->set_watch(
        [&signals](double, const sim::NewtonIteration&) { return signals.is_raised(); });
    self->course_->begin();
    self->course_->set_apart();
  } catch (const sim::Interruption&) {
    signals.raise();
    throw;
  }
  return self;
}

void Simulation::follow(sim::Course& course) {
  course_ = &course;
  refresh();
}

void Simulation::apply_changes() {
  if (std::exchange(is_changed_, false)) course_->restart();
}

bool Simulation::advance() {
  sim::Course& course = this->course();
  if (!own_course_) throw std::runtime_error("a run goes on by itself when the callback returns");
  if (course.is_done()) return false;
  {
    const Computing computing(*scene_);
    bool is_interrupted = false;
    {
      const py::gil_scoped_release release;
      try {
        apply_changes();
        course.step();
        if (course.checkpoint_is_due()) course.restart();
      } catch (const sim::Interruption&) {
        is_interrupted = true;
        course.restart();
      }
    }
    if (is_interrupted) signals_.raise();
  }
  refresh();
  return true;
}

sim::Course& Simulation::course() const {
  if (course_ == nullptr) throw std::runtime_error("a run can be asked within its `on_step` only");
  if (own_course_ && scene_->computes)
    throw std::runtime_error("a step is being computed in another thread");
  return *course_;
}

void Simulation::refresh() {
  for (auto& [key, values] : nodes_) fill(key.first, key.second, values);
}

const Positions& Simulation::nodes(Quantity quantity, const std::string& body) {
  course();
  const int b = body_named(model(), body);
  const auto found = nodes_.find({quantity, b});
  if (found != nodes_.end()) return found->second;
  const sim::BodyModel& given = model().bodies[static_cast<std::size_t>(b)];
  const bool is_force = quantity == Quantity::ElasticForce || quantity == Quantity::ContactForce;
  const Eigen::Index size =
      is_force || given.tissue >= 0 ? tissue_of(model(), b).X.cols() : given.X.cols();
  Positions values = Positions::Zero(3, size);
  fill(quantity, b, values);
  return nodes_.emplace(std::pair(quantity, b), std::move(values)).first->second;
}

void Simulation::fill(Quantity quantity, int body, Positions& values) const {
  const sim::Stepper& stepper = course_->stepper();
  const sim::BodyModel& given = model().bodies[static_cast<std::size_t>(body)];
  switch (quantity) {
    case Quantity::Position:
    case Quantity::Velocity: {
      const sim::Configuration& now = stepper.now().configuration;
      if (given.tissue < 0) return fill_bone(model(), now, quantity, body, values);
      const auto& nodes = model().tissues[static_cast<std::size_t>(given.tissue)].nodes;
      for (Eigen::Index i = 0; i < values.cols(); ++i) {
        const sim::NodeRef& node = nodes[static_cast<std::size_t>(i)];
        values.col(i) = quantity == Quantity::Position ? now.position(node) : now.velocity(node);
      }
      return;
    }
    case Quantity::ElasticForce:
      values = stepper.now().tissues[static_cast<std::size_t>(given.tissue)].force;
      return;
    case Quantity::ContactForce: {
      const Positions forces = stepper.contact_forces()[static_cast<std::size_t>(body)];
      if (forces.cols() == values.cols()) values = forces;  // of what nothing can touch: none, 0
      return;
    }
  }
}

sim::History& Simulation::history() {
  if (!history_) history_ = std::make_unique<sim::History>(model(), scenario().output.length_unit);
  return *history_;
}

const std::vector<std::string>& Simulation::columns() { return history().columns(); }

const std::vector<double>& Simulation::row() {
  const sim::Course& now = course();
  history().record(now.state(), now.stepper());
  history().take_rows();
  return history().last();
}

double Simulation::excitation(int muscle) const {
  return sim::steady_activation(model().muscles[static_cast<std::size_t>(muscle)],
                                course().state().t);
}

double Simulation::activation(int muscle) const {
  return course().state().y[model().layout.activations() + muscle];
}

void Simulation::set_excitation(int muscle, double excitation) {
  check_part(excitation, "excitation");
  sim::Curve& curve = model().muscles[static_cast<std::size_t>(muscle)].given.excitation;
  curve = {};
  curve.time = {course().state().t};
  curve.value = {excitation};
}

void Simulation::set_activation(int muscle, double activation) {
  check_part(activation, "activation");
  if (model().is_static)
    throw std::invalid_argument(
        "activation: in a static analysis it is the excitation; set that instead");
  sim::Course& now = course();
  now.state().y[model().layout.activations() + muscle] = activation;
  is_changed_ = true;
}

}  // namespace articular::python
