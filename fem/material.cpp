#include "fem/material.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace articular::fem {

Lame lame_parameters(double E, double nu) {
  if (!(E > 0) || !std::isfinite(E)) {
    std::ostringstream message;
    message << "Young's modulus is " << E << " Pa, must be positive and finite";
    throw std::invalid_argument(message.str());
  }
  if (!(nu > -1 && nu < 0.5)) {
    std::ostringstream message;
    message << "Poisson's ratio is " << nu << ", must lie between -1 and 0.5 (both excluded)";
    throw std::invalid_argument(message.str());
  }
  return {.mu = E / (2 * (1 + nu)), .lambda = E * nu / ((1 + nu) * (1 - 2 * nu))};
}

}  // namespace articular::fem
