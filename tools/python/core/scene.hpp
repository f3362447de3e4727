#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/model/model.hpp"
#include "sim/scenario/scenario.hpp"

/// What Python's Scenario and Model hold, and how they compute: without Python's lock, and so that
/// Ctrl-C ends it.
namespace articular::python {

namespace py = pybind11;

/// A scenario as it was read, with what was set since: it is read anew each time.
struct ScenarioFile {
  std::filesystem::path file;
  std::vector<std::string> overrides;  // as --set takes them
  sim::Scenario read;
};

/// A scenario made ready to compute. Elements hold work memory, which all models that are copies of
/// this one share: one of them computes at a time.
struct Scene {
  explicit Scene(const sim::Scenario& given);

  const sim::Scenario scenario;
  sim::Model model;
  std::atomic<bool> computes = false;
};

/// Reads meshes and builds the model, without Python's lock; then gives its warnings to Python.
std::shared_ptr<Scene> make_scene(const sim::Scenario& scenario);

/// Each as a Python warning of the class RunWarning, at the line that called articular.
void warn(const std::vector<std::string>& warnings);

/// @throws InputError with the nearest name
int body_named(const sim::Model& model, const std::string& name);

/// Holds a scene while something computes with it.
class Computing {
 public:
  /// @throws std::runtime_error where another thread does
  explicit Computing(Scene& scene);
  ~Computing() { scene_.computes = false; }
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;

 private:
  Scene& scene_;
};

/// Asks Python now and then whether a signal has come, and keeps the exception that it makes.
class SignalWatch {
 public:
  /// Without Python's lock. @return whether there is an exception
  bool is_raised();
  /// For who has another reason to end.
  void keep(const py::error_already_set& error) { error_ = error; }
  bool holds() const { return error_.has_value(); }
  /// With Python's lock: raises what was kept.
  void raise();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::optional<py::error_already_set> error_;
};

}  // namespace articular::python
