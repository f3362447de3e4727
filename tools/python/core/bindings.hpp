#pragma once

#include <pybind11/pybind11.h>

/// The parts of the module articular._core. Types for editors stand in articular/_core/*.pyi.
namespace articular::python {

namespace py = pybind11;

void bind_exceptions(py::module_& module);
void bind_scenario(py::module_& module);
void bind_model(py::module_& module);
void bind_simulation(py::module_& module);
void bind_run(py::module_& module);
void bind_result_files(py::module_& module);
void bind_collision(py::module_& module);
void bind_fem(py::module_& module);

}  // namespace articular::python
