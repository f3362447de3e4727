#include "sim/build/make_tissue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"
#include "fem/material/viscosity.hpp"
#include "fem/mesh/rest_shape.hpp"
#include "sim/build/make_fibres.hpp"

namespace articular::sim {
namespace {

TissueElements make_elements(const TissueMaterial& material, const MeshData& mesh,
                             const FibreDirections& fibres, std::shared_ptr<ThreadPool> pool) {
  if (material.element == TissueMaterial::Element::Smoothed)
    return TissueElements(fem::SmoothedElasticity(mesh.X, mesh.tets, *material.law, {}, fibres));
  return TissueElements(
      fem::Elasticity(mesh.X, mesh.tets, *material.law, fibres, {.pool = std::move(pool)}));
}

/// Smoothed tissue has dashpots where it takes the energy of its distortion. Its volume is that
/// around a node, which they do not see, and next to constant: they leave it out. With ζ = β κ in
/// elements or domains they would lock.
fem::Dashpots make_dashpots(const TissueMaterial& material, const Tissue& tissue) {
  const double beta = material.stiffness_damping;
  if (const fem::SmoothedElasticity* smoothed = tissue.elements.smoothed())
    return {*smoothed, fem::stiffness_damping(beta, tissue.shear_modulus, 0)};
  return {tissue.X, tissue.elements.tets(),
          fem::stiffness_damping(beta, tissue.shear_modulus, tissue.bulk_modulus),
          tissue.elements.make_matrix()};
}

fem::FibreDrag make_fibre_drag(const fem::MuscleFibre& fibre, const Tissue& tissue) {
  if (const fem::SmoothedElasticity* smoothed = tissue.elements.smoothed())
    return {*smoothed, fibre};
  return {tissue.X, tissue.elements.tets(), tissue.fibres, fibre, tissue.elements.make_matrix()};
}

/// As it is around a fibre, on average: of fibres that lie evenly 1.
double density_around_fibres(const FibreDirections& fibres, const MeshData& mesh) {
  double fibre = 0, around = 0;
  for (Eigen::Index e = 0; e < fibres.cols(); ++e) {
    const double density = fibres.col(e).norm(), volume = fem::checked_volume(mesh.X, mesh.tets, e);
    fibre += volume * density;
    around += volume * density * density;
  }
  return fibre > 0 ? around / fibre : 0;
}

/// See st_venant_kirchhoff.hpp.
std::string_view end_of(const fem::AnyMaterial& law) {
  if (!std::holds_alternative<fem::StVenantKirchhoff>(law)) return {};
  return "the law \"st-venant-kirchhoff\" softens, and ends, where an element is pressed to less "
         "than 0.58 of its length";
}

}  // namespace

Tissue make_tissue(const Scenario& scenario, const Model& model,
                   const std::vector<BodyGeometry>& geometry, const collision::Surface& surface,
                   int index) {
  const auto b = static_cast<std::size_t>(index);
  const Body& body = scenario.bodies[b];
  const TissueMaterial& material = *body.material;
  const MeshData& mesh = geometry[b].mesh;
  FibreDirections fibres;
  if (material.fibres)
    fibres = make_fibres(*material.fibres, body, index, model, geometry, surface);
  try {
    Tissue tissue{
        .body = index,
        .elements = make_elements(material, mesh, fibres, model.pool),
        .dashpots = {},
        .fibre_drag = {},
        .relaxation = {},
        .sheets = {},
        .lumped_mass = fem::lumped_mass(mesh.X, mesh.tets, *body.density),
        .mass_damping = material.mass_damping,
        .nodes = {},
        .X = mesh.X,
        .fibres = fibres,
        .bulk_modulus = fem::bulk_modulus(*material.law),
        .shear_modulus = fem::shear_modulus(*material.law),
        .active_stress = fem::active_stress(*material.law) * density_around_fibres(fibres, mesh),
        .law_ends = end_of(*material.law),
        .bears_turning = !std::holds_alternative<fem::Linear>(*material.law),
        .start_velocity = body.velocity};
    tissue.nodes.resize(static_cast<std::size_t>(mesh.X.cols()));
    if (material.stiffness_damping > 0 && !model.is_static)
      tissue.dashpots = make_dashpots(material, tissue);
    const std::optional<fem::MuscleFibre> fibre = fem::muscle_fibre(*material.law);
    if (fibre && fibre->has_drag() && !model.is_static)
      tissue.fibre_drag = make_fibre_drag(*fibre, tissue);
    if (!material.relaxation.empty())
      tissue.relaxation.emplace(material.relaxation, *material.law,
                                tissue.elements.distortion_points(mesh.X),
                                tissue.elements.make_matrix());
    return tissue;
  } catch (const std::invalid_argument& error) {
    throw InputError(mesh_place(body),
                     fmt::format("tissue `{}`{}: {}", body.name, mesh_name(body), error.what()));
  }
}

}  // namespace articular::sim
