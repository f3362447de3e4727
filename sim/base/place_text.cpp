#include "sim/base/place_text.hpp"

#include <fmt/format.h>

namespace articular::sim {

std::string place_text(const Vec3& x) {
  return fmt::format("({:.3f} {:.3f} {:.3f}) mm", 1e3 * x.x(), 1e3 * x.y(), 1e3 * x.z());
}

std::string place_text(const Location& where) {
  return where.line > 0 ? fmt::format("{}:{}", where.file, where.line) : where.file;
}

}  // namespace articular::sim
