#include "fem/material/material.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace articular::fem {

Lame lame_parameters(double E, double nu) {
  checked_positive(E, "Young's modulus", "Pa");
  if (!(nu > -1 && nu < 0.5)) {
    std::ostringstream message;
    message << "Poisson's ratio is " << nu << ", must lie between -1 and 0.5 (both excluded)";
    throw std::invalid_argument(message.str());
  }
  return {.mu = E / (2 * (1 + nu)), .lambda = E * nu / ((1 + nu) * (1 - 2 * nu))};
}

double checked_positive(double value, const char* name, const char* unit) {
  if (value > 0 && std::isfinite(value)) return value;
  std::ostringstream message;
  message << name << " is " << value << ' ' << unit << ", must be positive and finite";
  throw std::invalid_argument(message.str());
}

double checked_not_negative(double value, const char* name, const char* unit) {
  if (value >= 0 && std::isfinite(value)) return value;
  std::ostringstream message;
  message << name << " is " << value << ' ' << unit << ", must be finite and not negative";
  throw std::invalid_argument(message.str());
}

}  // namespace articular::fem
