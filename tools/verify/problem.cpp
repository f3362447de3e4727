#include "tools/verify/problem.hpp"

#include <cmath>
#include <utility>

namespace articular::tools {

bool Finding::passed() const { return std::abs(deviation()) <= tolerance; }

Finding relative(std::string quantity, std::string unit, double expected, double got,
                 double tolerance) {
  return {std::move(quantity), std::move(unit), expected, got, std::abs(expected), tolerance};
}

Finding vanishing(std::string quantity, std::string unit, double got, double scale,
                  double tolerance) {
  return {std::move(quantity), std::move(unit), 0, got, scale, tolerance};
}

}  // namespace articular::tools
