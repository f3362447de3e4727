#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace articular::python {

/// A Python value as it would stand behind `key = ` in a scenario: true, 0.5, "15 kPa", lists and
/// tuples, dicts as tables, numpy's numbers and arrays.
/// @throws pybind11::type_error for others
std::string toml_text(pybind11::handle value);

}  // namespace articular::python
