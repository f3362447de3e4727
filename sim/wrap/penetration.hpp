#pragma once

#include "sim/wrap/wrapped_path.hpp"

namespace articular::sim {

/// How deep a segment may lie in what is solid, by the size of the surface: above round-off.
constexpr double kPenetration = 1e-8;

/// Leads the first segment that runs through what is solid over the surface. @return whether there
/// was one
bool lead_around(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work);

}  // namespace articular::sim
