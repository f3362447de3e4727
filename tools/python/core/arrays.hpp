#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/base/types.hpp"

/// Matrices of this project with one column a node or an element, and numpy arrays with one row.
/// Both lie in memory alike.
namespace articular::python {

namespace py = pybind11;

/// Refuses writing, also if somebody asks numpy for it: an array's memory is then that of no array.
py::array read_only(py::array array);

/// Without a copy; read-only. Keeps `owner` alive, which must keep the matrix where it is.
template <class Matrix>
py::array view_of(const Matrix& matrix, py::handle owner) {
  using Scalar = typename Matrix::Scalar;
  constexpr auto kSize = static_cast<py::ssize_t>(sizeof(Scalar));
  return read_only(py::array_t<Scalar>({matrix.cols(), matrix.rows()},
                                       {kSize * matrix.rows(), kSize}, matrix.data(), owner));
}

template <class Matrix>
py::array copy_of(const Matrix& matrix) {
  using Scalar = typename Matrix::Scalar;
  constexpr auto kSize = static_cast<py::ssize_t>(sizeof(Scalar));
  return py::array_t<Scalar>({matrix.cols(), matrix.rows()}, {kSize * matrix.rows(), kSize},
                             matrix.data());
}

template <class Number>
py::array copy_of(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

inline py::array copy_of(const Eigen::VectorXd& numbers) {
  return py::array_t<double>(numbers.size(), numbers.data());
}

/// An array of three columns of finite numbers.
/// @param name  for messages
/// @param rows  how many it must have; -1: any number
/// @throws std::invalid_argument (ValueError) for another shape or a number that is not finite,
///         py::type_error for anything but real numbers
Positions positions_from(const py::object& given, const std::string& name, py::ssize_t rows = -1);

/// An array of four columns of whole numbers.
/// @throws std::invalid_argument for another shape or a number out of the range of int,
/// py::type_error
///         for anything but whole numbers
Tetrahedra tetrahedra_from(const py::object& given, const std::string& name);

}  // namespace articular::python
