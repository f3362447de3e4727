#include "tools/python/core/arrays.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace articular::python {
namespace {

std::string shape_words(const py::array& array) {
  std::string words;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    words += (i > 0 ? " x " : "") + std::to_string(array.shape(i));
  return words.empty() ? "a single value" : words;
}

/// @param kinds  numpy's letters of the types that may be
py::array array_from(const py::object& given, const std::string& name, py::ssize_t columns,
                     std::string_view kinds, const char* numbers) {
  py::array array = py::module_::import("numpy").attr("asarray")(given);
  if (array.size() > 0 && kinds.find(array.dtype().kind()) == std::string_view::npos)
    throw py::type_error(fmt::format("{}: expected {}, found the type {}", name, numbers,
                                     std::string(py::str(array.dtype()))));
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw std::invalid_argument(fmt::format("{}: expected N rows of {} numbers, found {}", name,
                                            columns, shape_words(array)));
  return array;
}

}  // namespace

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

Positions positions_from(const py::object& given, const std::string& name, py::ssize_t rows) {
  using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const Rows array = Rows::ensure(array_from(given, name, 3, "fiu", "real numbers"));
  if (!array) throw py::error_already_set();
  if (rows >= 0 && array.shape(0) != rows)
    throw std::invalid_argument(
        fmt::format("{}: expected {} rows, one a node, found {}", name, rows, array.shape(0)));
  Positions positions = Eigen::Map<const Positions>(array.data(), 3, array.shape(0));
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    if (!positions.col(i).allFinite())
      throw std::invalid_argument(fmt::format("{}: row {} is not finite", name, i));
  return positions;
}

Tetrahedra tetrahedra_from(const py::object& given, const std::string& name) {
  using Rows = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const Rows array = Rows::ensure(array_from(given, name, 4, "iu", "whole numbers"));
  if (!array) throw py::error_already_set();
  Tetrahedra tets(4, array.shape(0));
  for (Eigen::Index i = 0; i < tets.size(); ++i) {
    const std::int64_t node = array.data()[i];
    if (node < 0 || node > std::numeric_limits<int>::max())
      throw std::invalid_argument(
          fmt::format("{}: row {} names node {}, which there is not", name, i / 4, node));
    tets.data()[i] = static_cast<int>(node);
  }
  return tets;
}

}  // namespace articular::python
