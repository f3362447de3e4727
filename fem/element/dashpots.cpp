#include "fem/element/dashpots.hpp"

#include "fem/simd/viscosity_kernels.hpp"

namespace articular::fem {
namespace {

EightMotions motions(const MovingStencils::Octet& octet, const KelvinVoigt& law) {
  return {octet.F, octet.rate, octet.share * law.eta(), octet.share * law.lambda()};
}

}  // namespace

Dashpots::Dashpots(const Positions& X, const Tetrahedra& tets, const KelvinVoigt& law,
                   const BlockMatrix& matrix)
    : law_(law), stencils_(X, tets, matrix) {}

Dashpots::Dashpots(const SmoothedElasticity& smoothed, const KelvinVoigt& law)
    : law_(law), stencils_(smoothed) {}

auto Dashpots::stress() const {
  return [this, &kernels = viscosity_kernels(stencils_.instruction_set())](
             const Octet& octet, Eight* P) { kernels.first_piola(motions(octet, law_), P); };
}

auto Dashpots::tangent(double damping, double stiffness) const {
  return [this, damping, stiffness, &kernels = viscosity_kernels(stencils_.instruction_set())](
             const Octet& octet, Eight* C) {
    kernels.tangent(motions(octet, law_), damping, stiffness, C);
  };
}

void Dashpots::add_force(const Positions& x, const Positions& v, Positions& f) const {
  stencils_.add_force(x, v, stress(), f);
}

void Dashpots::add_tangent(const Positions& x, const Positions& v, double damping, double stiffness,
                           BlockMatrix& K) const {
  stencils_.add_tangent(x, v, tangent(damping, stiffness), K);
}

void Dashpots::add_plain_damping(const Positions& x, double damping, BlockMatrix& K) const {
  stencils_.add_plain_tangent(x, x, tangent(damping, 0), K);
}

double Dashpots::power(const Positions& x, const Positions& v) const {
  return stencils_.power(x, v, stress());
}

}  // namespace articular::fem
