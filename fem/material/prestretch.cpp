#include "fem/material/prestretch.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace articular::fem {

double checked_prestretch(double s) {
  if (s >= 0.5 && s <= 2) return s;
  std::ostringstream message;
  message << "prestretch is " << s << ", must lie between 0.5 and 2";
  throw std::invalid_argument(message.str());
}

Mat3 prestretch_gradient(double s, const Vec3& a0) {
  const double across = 1 / std::sqrt(s);
  return across * Mat3::Identity() + (s - across) * a0 * a0.transpose();
}

// F0 mixes columns of F, which are blocks of three in vec(F).
Mat9 with_prestretch(const Mat9& A, const Mat3& F0) {
  if (F0.isIdentity(0)) return A;  // tissue without prestretch does not pay for it
  Mat9 half = Mat9::Zero(), whole = Mat9::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) half.middleCols<3>(3 * i) += F0(k, i) * A.middleCols<3>(3 * k);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) whole.middleRows<3>(3 * i) += F0(i, k) * half.middleRows<3>(3 * k);
  return whole;
}

}  // namespace articular::fem
