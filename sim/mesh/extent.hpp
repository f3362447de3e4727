#pragma once

#include "fem/base/types.hpp"

namespace articular::sim {

/// The longest side of the box around points [m]; 0 without any.
inline double extent(const Positions& X) {
  return X.cols() > 0 ? (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).maxCoeff() : 0;
}

}  // namespace articular::sim
