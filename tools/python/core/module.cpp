#include "sim/base/error.hpp"
#include "sim/base/version.hpp"
#include "tools/python/core/bindings.hpp"

namespace articular::python {

void bind_exceptions(py::module_& module) {
  const auto in_package = [](py::handle type) { type.attr("__module__") = "articular"; };
  in_package(py::register_exception<sim::InputError>(module, "InputError", PyExc_ValueError));
  in_package(
      py::register_exception<sim::SimulationError>(module, "SimulationError", PyExc_RuntimeError));
  in_package(py::register_exception<sim::SystemError>(module, "SystemFailure", PyExc_OSError));
  module.attr("RunWarning") = py::reinterpret_steal<py::object>(
      PyErr_NewException("articular.RunWarning", PyExc_UserWarning, nullptr));
}

}  // namespace articular::python

PYBIND11_MODULE(_core, module) {
  using namespace articular::python;
  module.doc() = "The compiled part of articular.";
  bind_exceptions(module);
  bind_scenario(module);
  bind_model(module);
  bind_simulation(module);
  bind_run(module);
  bind_result_files(module);
  bind_collision(module);
  bind_fem(module);
}
