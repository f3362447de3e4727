#pragma once

#include "fem/base/types.hpp"

namespace articular::fem {

/// A ⊗ 1, the matrix of dF ↦ dF A for a symmetric A.
inline Mat9 on_columns(const Mat3& A) {
  Mat9 result;
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l) result.block<3, 3>(3 * j, 3 * l) = A(j, l) * Mat3::Identity();
  return result;
}

}  // namespace articular::fem
