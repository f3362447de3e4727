#pragma once

#include <string>

#include "fem/base/types.hpp"

namespace articular::sim {

/// A place in a message, such as "(1.000 -2.500 30.000) mm". @param x  [m]
std::string place_text(const Vec3& x);

}  // namespace articular::sim
