#pragma once

#include "sim/wrap/taut_string.hpp"

namespace articular::sim {

/// Drops what is lifted off, see wrap(), and what goes over an
/// edge and back. @return whether there was any
bool drop_lifted(std::span<const PlacedSurface> surfaces, std::vector<EdgeCrossing>& crossings,
                 const StringShape& shape, std::vector<char>& lifted);

}  // namespace articular::sim
