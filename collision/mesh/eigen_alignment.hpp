#pragma once

#include <Eigen/Core>

/// Eigen's heap memory depends on compiler flags (-mavx, -march=native): a program compiled with
/// others than this library crashes when it frees a matrix that the library has made. Such a
/// program does not link: `undefined reference to EigenHeapAlignment<32>::kOfTheLibrary`.
namespace articular::collision {

template <int bytes>
struct EigenHeapAlignment {
  static const char kOfTheLibrary;
};
template <>
const char EigenHeapAlignment<EIGEN_DEFAULT_ALIGN_BYTES>::kOfTheLibrary;

[[gnu::used]] inline const char* const kSameEigenHeapAlignment =
    &EigenHeapAlignment<EIGEN_DEFAULT_ALIGN_BYTES>::kOfTheLibrary;

}  // namespace articular::collision
