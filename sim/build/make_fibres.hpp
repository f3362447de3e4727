#pragma once

#include <vector>

#include "collision/mesh/surface.hpp"
#include "sim/build/body_geometry.hpp"
#include "sim/model/model.hpp"

namespace articular::sim {

/// The fibres of each element of a tissue, as its material or a sheet on it wants them.
/// @param index     of the body among the scenario's
/// @param geometry  of each of them
/// @param surface   of the tissue
/// @throws InputError with the place in the scenario
FibreDirections make_fibres(const Fibres& fibres, const Body& body, int index, const Model& model,
                            const std::vector<BodyGeometry>& geometry,
                            const collision::Surface& surface);

}  // namespace articular::sim
