#pragma once

#include <optional>
#include <variant>

#include "fem/material/blemker_muscle.hpp"
#include "fem/material/corotated.hpp"
#include "fem/material/coupled_neo_hookean.hpp"
#include "fem/material/holmes_mow.hpp"
#include "fem/material/linear.hpp"
#include "fem/material/mooney_rivlin.hpp"
#include "fem/material/neo_hookean.hpp"
#include "fem/material/ogden.hpp"
#include "fem/material/st_venant_kirchhoff.hpp"
#include "fem/material/transversely_isotropic.hpp"
#include "fem/material/veronda_westmann.hpp"
#include "fem/material/yeoh.hpp"

namespace articular::fem {

/// Every law that elements can have; another one joins by its name here.
using AnyLaw =
    std::variant<Linear, Corotated, StVenantKirchhoff, NeoHookean, CoupledNeoHookean, HolmesMow,
                 MooneyRivlin<VolumeChange>, MooneyRivlin<LogVolumeChange>, Yeoh<VolumeChange>,
                 Yeoh<LogVolumeChange>, Ogden<VolumeChange>, Ogden<LogVolumeChange>,
                 VerondaWestmann<VolumeChange>, VerondaWestmann<LogVolumeChange>,
                 TransverselyIsotropic<VolumeChange>, TransverselyIsotropic<LogVolumeChange>,
                 BlemkerMuscle<VolumeChange>, BlemkerMuscle<LogVolumeChange>>;

/// A name that headers can declare without the laws.
struct AnyMaterial : AnyLaw {
  using AnyLaw::AnyLaw;
};

/// @throws std::invalid_argument where a material with fibres has none, or one is 0 or not finite
void check_fibres(const AnyMaterial& material, const FibreDirections& fibres,
                  const Tetrahedra& tets);

/// The largest active stress of its fibres [Pa]; 0 of laws that do not pull.
double active_stress(const AnyMaterial& material);
/// The stretch of its fibres as drawn; 1 of laws that know of none.
double prestretch(const AnyMaterial& material);
/// The stretch at which collagen becomes straight; none of laws without.
std::optional<double> toe_end(const AnyMaterial& material);
/// The fibres of a muscle law; none of others.
std::optional<MuscleFibre> muscle_fibre(const AnyMaterial& material);

}  // namespace articular::fem
