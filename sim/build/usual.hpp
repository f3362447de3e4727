#pragma once

namespace articular::sim {

/// What a quantity of tissue, bone or tool may be. Beyond it a unit was most often meant otherwise.
struct Usual {
  double least, most;
};

inline bool is_usual(double value, const Usual& range) {
  return value >= range.least && value <= range.most;
}

}  // namespace articular::sim
