#include "fem/material/any_material.hpp"

#include <sstream>
#include <stdexcept>

#include "fem/mesh/rest_shape.hpp"

namespace articular::fem {

void check_fibres(const AnyMaterial& material, const FibreDirections& fibres,
                  const Tetrahedra& tets) {
  const bool fibred = std::visit([]<class M>(const M&) { return Fibred<M>; }, material);
  std::ostringstream message;
  if ((fibred || fibres.cols() > 0) && fibres.cols() != tets.cols()) {
    message << "there are " << fibres.cols() << " directions of fibres for " << tets.cols()
            << " tetrahedra, must be one each";
    throw std::invalid_argument(message.str());
  }
  for (Eigen::Index e = 0; e < fibres.cols(); ++e) {
    if (fibres.col(e).norm() > 0 && fibres.col(e).allFinite()) continue;
    message << "direction of the fibres of " << name_of(tets, e) << " is ("
            << fibres.col(e).transpose() << "), must be finite and not 0";
    throw std::invalid_argument(message.str());
  }
}

double active_stress(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const M& m) {
        if constexpr (requires { m.active_stress(); }) {
          return m.active_stress();
        } else {
          return 0.0;
        }
      },
      material);
}

double prestretch(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const M& m) {
        if constexpr (requires { m.prestretch(); }) {
          return m.prestretch();
        } else {
          return 1.0;
        }
      },
      material);
}

std::optional<double> toe_end(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const M& m) -> std::optional<double> {
        if constexpr (requires { m.toe_end(); }) {
          return m.toe_end();
        } else {
          return std::nullopt;
        }
      },
      material);
}

std::optional<MuscleFibre> muscle_fibre(const AnyMaterial& material) {
  return std::visit(
      []<class M>(const M& m) -> std::optional<MuscleFibre> {
        if constexpr (requires { m.fibre(); }) {
          return m.fibre();
        } else {
          return std::nullopt;
        }
      },
      material);
}

}  // namespace articular::fem
