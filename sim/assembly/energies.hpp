#pragma once

#include "sim/assembly/moment.hpp"

/// Energies at one moment [J].
namespace articular::sim {

/// Of all that moves, tissue nodes that driven bodies carry among it.
double kinetic_energy(const Moment& now);
/// Of the tissues.
double elastic_energy(const Moment& now);
/// Of all masses but those of fixed and driven bodies themselves.
double gravity_energy(const Moment& now);
/// ∂W/∂a of a tissue's elastic energy by its activation.
double energy_per_activation(const Moment& now, std::size_t tissue);

}  // namespace articular::sim
