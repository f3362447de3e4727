#include "tools/python/core/scene.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/build/build_model.hpp"
#include "sim/step/overlap_report.hpp"

namespace articular::python {

Scene::Scene(const sim::Scenario& given) : scenario(given), model(sim::build_model(given)) {
  sim::warn_of_overlaps(scenario, model);
}

std::shared_ptr<Scene> make_scene(const sim::Scenario& scenario) {
  std::shared_ptr<Scene> scene;
  {
    const py::gil_scoped_release release;
    scene = std::make_shared<Scene>(scenario);
  }
  warn(scene->model.warnings);
  return scene;
}

void warn(const std::vector<std::string>& warnings) {
  const py::object category = py::module_::import("articular._core").attr("RunWarning");
  for (const std::string& text : warnings)
    if (PyErr_WarnEx(category.ptr(), text.c_str(), 2) != 0) throw py::error_already_set();
}

int body_named(const sim::Model& model, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].name == name) return static_cast<int>(b);
    names.push_back(model.bodies[b].name);
  }
  throw sim::InputError(
      fmt::format("no body `{}`{}", sim::one_line(name), sim::suggestion(name, names)));
}

Computing::Computing(Scene& scene) : scene_(scene) {
  if (scene_.computes.exchange(true))
    throw std::runtime_error(
        "another thread computes with this model; each thread needs a Model of its own");
}

bool SignalWatch::is_raised() {
  constexpr std::chrono::milliseconds kInterval(50);
  if (error_) return true;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kInterval) return false;
  last_ = now;
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) error_.emplace();
  return error_.has_value();
}

void SignalWatch::raise() {
  if (!error_) return;
  const py::error_already_set error = *error_;
  error_.reset();
  throw error;  // NOLINT(misc-throw-by-value-catch-by-reference): it was kept
}

}  // namespace articular::python
