#pragma once

#include <cmath>

namespace articular::tools {

/// To a multiple of `unit`; no zero has a minus.
inline double rounded(double x, double unit) { return unit * std::round(x / unit) + 0.0; }

}  // namespace articular::tools
