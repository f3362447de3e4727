#pragma once

#include <string>

#include "sim/base/error.hpp"

namespace articular::sim {

/// What a quantity of tissue, bone or tool may be. Beyond it a unit was most often meant otherwise.
struct Usual {
  double least, most;
};

inline bool is_usual(double value, const Usual& range) {
  return value >= range.least && value <= range.most;
}

/// The warning of what is beyond it.
inline std::string unit_doubt(const Location& where, const std::string& what) {
  return prefix(where) + what + "; is its unit the one that was meant?";
}

}  // namespace articular::sim
