#pragma once

#include "sim/wrap/wrapped_path.hpp"

namespace articular::sim {

/// Drops what is lifted off, see wrap(). @return whether there was any
bool drop_lifted(std::span<const PlacedSurface> surfaces, std::vector<EdgeCrossing>& crossings,
                 const StringShape& shape, std::vector<char>& lifted);

/// Where crossings lie at a node, the string goes over the edges on the other side of it, if it is
/// shorter there. It is not where the surface has the shape of a saddle: there a taut string may
/// run through a node. @return whether it did anywhere
bool pass_nodes(std::span<const PlacedSurface> surfaces, WrappedString& string, WrapWork& work);

}  // namespace articular::sim
