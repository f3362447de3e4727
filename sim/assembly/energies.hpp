#pragma once

#include "sim/assembly/moment.hpp"

/// Energies at one moment [J].
namespace articular::sim {

/// Of all that moves, tissue nodes that driven bodies carry among it.
double kinetic_energy(const Moment& now);
/// Of the tissues.
double elastic_energy(const Moment& now);
/// Of all masses but those of fixed and driven bodies themselves, in gravity without a profile.
double gravity_energy(const Moment& now);
/// Of the same masses in any uniform gravity [m/s²].
double weight_energy(const Model& model, const Configuration& now, const Vec3& gravity);
/// ∂W/∂a of a tissue's elastic energy by its activation.
double energy_per_activation(const Moment& now, std::size_t tissue);

}  // namespace articular::sim
