#pragma once

#include <string>

#include "fem/base/types.hpp"
#include "sim/base/error.hpp"

namespace articular::sim {

/// A place in a message, such as "(1.000 -2.500 30.000) mm". @param x  [m]
std::string place_text(const Vec3& x);
/// "jaw.toml:12", for messages that point at a second place.
std::string place_text(const Location& where);

}  // namespace articular::sim
