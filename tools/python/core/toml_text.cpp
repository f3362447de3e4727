#include "tools/python/core/toml_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace articular::python {
namespace {

namespace py = pybind11;

/// JSON's escapes are TOML's too.
std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// In TOML a number is an integer unless it has a point or an exponent.
std::string number_text(double number) {
  const std::string text = fmt::format("{}", number);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string list_text(py::handle list) {
  std::string text;
  for (const py::handle element : list) text += (text.empty() ? "" : ", ") + toml_text(element);
  return "[" + text + "]";
}

std::string table_text(const py::dict& table) {
  std::string text;
  for (const auto& [key, value] : table) {
    if (!py::isinstance<py::str>(key)) throw py::type_error("a key of a table must be a text");
    text +=
        (text.empty() ? "" : ", ") + quoted(py::cast<std::string>(key)) + " = " + toml_text(value);
  }
  return "{" + text + "}";
}

}  // namespace

std::string toml_text(py::handle value) {
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value) ? "true" : "false";
  if (py::isinstance<py::str>(value)) return quoted(py::cast<std::string>(value));
  if (py::isinstance<py::float_>(value)) return number_text(py::cast<double>(value));
  if (py::isinstance<py::dict>(value)) return table_text(py::reinterpret_borrow<py::dict>(value));
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return list_text(value);
  if (py::hasattr(value, "tolist")) return toml_text(value.attr("tolist")());  // numpy
  if (PyIndex_Check(value.ptr()) != 0) return std::to_string(py::cast<long long>(value));
  throw py::type_error(fmt::format("no value of a scenario can be a {}",
                                   std::string(py::str(py::type::of(value).attr("__name__")))));
}

}  // namespace articular::python
