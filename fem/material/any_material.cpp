#include "fem/material/any_material.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "fem/mesh/rest_shape.hpp"

namespace articular::fem {

void check_fibres(const AnyMaterial& material, const FibreDirections& fibres,
                  const Tetrahedra& tets) {
  // Directions of a file are normalised where they are read; a product of rotations stays as close.
  constexpr double kUnit = 1e-9;  // [-]
  const bool fibred = std::visit([]<class M>(const M&) { return Fibred<M>; }, material);
  std::ostringstream message;
  if ((fibred || fibres.cols() > 0) && fibres.cols() != tets.cols()) {
    message << "there are " << fibres.cols() << " directions of fibres for " << tets.cols()
            << " tetrahedra, must be one each";
    throw std::invalid_argument(message.str());
  }
  for (Eigen::Index e = 0; e < fibres.cols(); ++e) {
    if (std::abs(fibres.col(e).norm() - 1) <= kUnit) continue;  // false for NaN
    message << "direction of the fibres of " << name_of(tets, e) << " is ("
            << fibres.col(e).transpose() << "), must be a unit vector";
    throw std::invalid_argument(message.str());
  }
}

}  // namespace articular::fem
