#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/output/history.hpp"
#include "sim/run/course.hpp"
#include "tools/python/core/scene.hpp"

namespace articular::python {

/// What an array has of each node of a body.
enum class Quantity { Position, Velocity, ElasticForce, ContactForce };

/// A model on its way, as Python sees it between two steps: on its own, or a run that waits for
/// what Python does.
class Simulation {
 public:
  /// Goes its own way, with a copy of the model: excitations may be set. At the start.
  static std::shared_ptr<Simulation> begin(std::shared_ptr<Scene> scene);
  /// Follows a run, whose model is the scene's.
  explicit Simulation(std::shared_ptr<Scene> scene) : scene_(std::move(scene)) {}

  /// Where the run is now, for what is asked until leave().
  void follow(sim::Course& course);
  void leave() { course_ = nullptr; }
  /// Lets what was changed count. Without Python's lock.
  void apply_changes();

  /// One step. @return false at the end, where there is none
  bool advance();

  /// @throws std::runtime_error while it computes, and of a run outside its callback
  sim::Course& course() const;
  sim::Model& model() const { return own_model_ ? *own_model_ : scene_->model; }
  const sim::Scenario& scenario() const { return scene_->scenario; }

  /// Of each node of a body's mesh [m, m/s, N]. The matrix stays where it is as long as this lives,
  /// and has the numbers of now after each step.
  /// @throws sim::InputError for forces on a bone, whose nodes have none
  const Positions& nodes(Quantity quantity, const std::string& body);
  /// The columns of the history, and their values now.
  const std::vector<std::string>& columns();
  const std::vector<double>& row();

  double excitation(int muscle) const;
  double activation(int muscle) const;
  /// From now on, until it is set again. @throws std::invalid_argument outside [0, 1]
  void set_excitation(int muscle, double excitation);
  /// Now; it then follows the excitation. @throws std::invalid_argument outside [0, 1], and in a
  /// static analysis
  void set_activation(int muscle, double activation);

 private:
  void refresh();
  void fill(Quantity quantity, int body, Positions& values) const;
  sim::History& history();

  std::shared_ptr<Scene> scene_;
  std::unique_ptr<sim::Model> own_model_;
  std::unique_ptr<sim::Course> own_course_;
  sim::Course* course_ = nullptr;
  SignalWatch signals_;
  bool is_changed_ = false;
  /// Made when they are asked for first; their memory never moves.
  std::map<std::pair<Quantity, int>, Positions> nodes_;
  std::unique_ptr<sim::History> history_;
};

}  // namespace articular::python
