#pragma once

#include <string>

namespace articular::sim {

/// Of coordinates in the result files.
struct LengthUnit {
  double metres = 1e-3;
  std::string name = "mm";
};

}  // namespace articular::sim
