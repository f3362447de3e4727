#pragma once

#include <string>
#include <vector>

#include "sim/build/body_geometry.hpp"

namespace articular::sim {

/// Bodies that are not what their numbers seem to say: balls of so large elements that a tenth of
/// the volume, and of the mass, is missing, layers whose Poisson's ratio makes them as good as
/// rigid, contact meshes that do not lie on the body, and a mass, a centre of mass or an
/// inertia that is not that of the mesh.
/// @param geometry  of each body at the start
/// @return one line each, with the place in the scenario
std::vector<std::string> body_doubts(const Scenario& scenario,
                                     const std::vector<BodyGeometry>& geometry);

}  // namespace articular::sim
