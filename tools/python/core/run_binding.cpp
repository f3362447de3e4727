#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>

#include "sim/run/run.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/simulation.hpp"

namespace articular::python {
namespace {

/// True where the callback asks to stop.
bool asks_to_stop(const py::object& answer) {
  if (answer.is_none()) return false;
  if (py::isinstance<py::bool_>(answer)) return answer.cast<bool>();
  throw py::type_error("on_step: expected True (to stop), False or None");
}

/// Calls Python between the steps of a run, and keeps what it raises until the run has ended in
/// good order.
class Callback {
 public:
  Callback(std::shared_ptr<Simulation> simulation, py::object function, SignalWatch& signals)
      : simulation_(std::move(simulation)), function_(std::move(function)), signals_(signals) {}

  /// Without Python's lock.
  void operator()(sim::Course& course) {
    {
      const py::gil_scoped_acquire acquire;
      simulation_->follow(course);
      try {
        stops_ = asks_to_stop(function_(simulation_));
      } catch (const py::error_already_set& error) {
        signals_.keep(error);
      } catch (const py::type_error& error) {
        error.set_error();
        signals_.keep(py::error_already_set());
      }
    }
    simulation_->apply_changes();
    simulation_->leave();
  }
  bool stops() const { return stops_; }

 private:
  std::shared_ptr<Simulation> simulation_;
  py::object function_;
  SignalWatch& signals_;
  bool stops_ = false;
};

std::filesystem::path folder_of(const sim::Scenario& scenario,
                                const std::optional<std::filesystem::path>& out) {
  if (out) return *out;
  return scenario.output.directory.value_or(std::filesystem::path("out") / scenario.name);
}

/// @return the folder of the results
std::filesystem::path run(const ScenarioFile& scenario,
                          const std::optional<std::filesystem::path>& out,
                          const py::object& on_step, bool resume, bool overwrite) {
  const std::shared_ptr<Scene> scene = make_scene(scenario.read);
  SignalWatch signals;
  std::vector<std::string> warnings;
  std::optional<Callback> callback;
  if (!on_step.is_none()) callback.emplace(std::make_shared<Simulation>(scene), on_step, signals);

  sim::RunOptions options;
  options.directory = folder_of(scene->scenario, out);
  options.resume = resume;
  options.overwrite = overwrite;
  const auto is_to_stop = [&] { return signals.is_raised() || (callback && callback->stops()); };
  options.is_to_stop = is_to_stop;
  options.after_iteration = [&](double, const sim::NewtonIteration&) { return is_to_stop(); };
  options.after_step = [&](const sim::State&, double) { return is_to_stop(); };
  options.warn = [&](const std::string& warning) { warnings.push_back(warning); };
  if (callback) options.steer = [&](sim::Course& course) { (*callback)(course); };
  {
    const py::gil_scoped_release release;
    sim::run(scene->scenario, scene->model, options);
  }
  signals.raise();
  warn(warnings);
  return options.directory;
}

}  // namespace

void bind_run(py::module_& module) {
  module.def("run", run, py::arg("scenario"), py::arg("out") = py::none(), py::kw_only(),
             py::arg("on_step") = py::none(), py::arg("resume") = false,
             py::arg("overwrite") = false,
             "A whole run; returns the folder of its results. See articular.run.");
}

}  // namespace articular::python
