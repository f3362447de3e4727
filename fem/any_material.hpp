#pragma once

#include <variant>

#include "fem/blemker_muscle.hpp"
#include "fem/corotated.hpp"
#include "fem/linear.hpp"
#include "fem/mooney_rivlin.hpp"
#include "fem/neo_hookean.hpp"
#include "fem/transversely_isotropic.hpp"
#include "fem/veronda_westmann.hpp"
#include "fem/yeoh.hpp"

namespace articular::fem {

/// Every law that elements can have; another one joins by its name here.
using AnyLaw =
    std::variant<Linear, Corotated, NeoHookean, MooneyRivlin<VolumeChange>,
                 MooneyRivlin<LogVolumeChange>, Yeoh<VolumeChange>, Yeoh<LogVolumeChange>,
                 VerondaWestmann<VolumeChange>, VerondaWestmann<LogVolumeChange>,
                 TransverselyIsotropic<VolumeChange>, TransverselyIsotropic<LogVolumeChange>,
                 BlemkerMuscle<VolumeChange>, BlemkerMuscle<LogVolumeChange>>;

/// A name that headers can declare without the laws.
struct Material : AnyLaw {
  using AnyLaw::AnyLaw;
};

/// @throws std::invalid_argument where a material with fibres has none, or one is no unit vector
void check_fibres(const Material& material, const FibreDirections& fibres, const Tetrahedra& tets);

}  // namespace articular::fem
