#pragma once

#include "sim/wrap/wrapped_path.hpp"

namespace articular::sim {

/// Where crossings lie at a node, the string goes over the edges on the other side of it, if it is
/// shorter there. It is not where the surface has the shape of a saddle: there a taut string may
/// run through a node. @return whether it did anywhere
bool pass_nodes(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work);

}  // namespace articular::sim
