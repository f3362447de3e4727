#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>

#include "fem/base/types.hpp"

namespace articular::fem {

/// The same numbers in every run and with every library: the engine is fixed by the standard, and
/// the distribution is written here.
class Random {
 public:
  double uniform(double low, double high) {
    const double unit = static_cast<double>(engine_()) / static_cast<double>(engine_.max());
    return low + (high - low) * unit;
  }
  template <class Matrix>
  Matrix matrix(Eigen::Index rows, Eigen::Index cols) {
    return Matrix::NullaryExpr(rows, cols, [this] { return uniform(-1, 1); });
  }
  Mat3 matrix3() { return matrix<Mat3>(3, 3); }
  Mat3 rotation() {
    const Eigen::Vector4d q = matrix<Eigen::Vector4d>(4, 1);
    return Eigen::Quaterniond(q).normalized().toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_{20240229};
};

}  // namespace articular::fem
