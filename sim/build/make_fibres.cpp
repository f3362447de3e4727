#include "sim/build/make_fibres.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "fem/mesh/fibre_field.hpp"
#include "sim/build/region.hpp"

namespace articular::sim {
namespace {

using collision::Surface;

std::vector<int> nodes_in(const Region& region, int body, const Model& model,
                          const std::vector<BodyGeometry>& geometry, const Surface& surface,
                          const Positions& X) {
  std::vector<bool> on_surface(static_cast<std::size_t>(X.cols()), false);
  for (const int node : surface.faces.reshaped()) on_surface[static_cast<std::size_t>(node)] = true;
  const RegionTest test(region, body, model, geometry);
  std::vector<int> nodes;
  for (int i = 0; i < X.cols(); ++i)
    if (test.contains_node(i, X.col(i), on_surface[static_cast<std::size_t>(i)]))
      nodes.push_back(i);
  return nodes;
}

FibreDirections fibres_of_array(const std::string& name, Fibres::Density density, const Body& body,
                                const MeshData& mesh) {
  const auto* file = std::get_if<MeshFile>(&body.geometry);
  if (file == nullptr)
    throw std::invalid_argument(fmt::format(
        "its shape is made here, so it has no cell array `{}`; expected `direction`, or `from` "
        "and `to`",
        name));
  const Mat3 turn = rotation_matrix(file->placement.rotation);
  for (const auto& [array, directions] : mesh.cell_vectors) {
    if (array != name) continue;
    return density == Fibres::Density::Conserved ? FibreDirections(turn * directions)
                                                 : fem::normalized_fibres(turn * directions);
  }
  std::string names;
  for (const auto& [array, directions] : mesh.cell_vectors)
    names += (names.empty() ? "" : ", ") + array;
  throw std::invalid_argument(
      fmt::format("its mesh has no cell array `{}` with three components{}", name,
                  names.empty() ? " (none at all: expected a .vtu or .vtk file with one)"
                                : fmt::format("; it has {}", names)));
}

FibreDirections fibres_between(const FibresBetween& between, Fibres::Density density, int index,
                               const MeshData& mesh, const Model& model,
                               const std::vector<BodyGeometry>& geometry, const Surface& surface) {
  const auto from = nodes_in(between.from, index, model, geometry, surface, mesh.X);
  const auto to = nodes_in(between.to, index, model, geometry, surface, mesh.X);
  if (from.empty() || to.empty())
    throw std::invalid_argument(
        fmt::format("the region {} holds no node", from.empty() ? "`from`" : "`to`"));
  return density == Fibres::Density::Conserved ? fem::conserved_fibres(mesh.X, mesh.tets, from, to)
                                               : fem::harmonic_fibres(mesh.X, mesh.tets, from, to);
}

}  // namespace

FibreDirections make_fibres(const Fibres& fibres, const Body& body, int index, const Model& model,
                            const std::vector<BodyGeometry>& geometry, const Surface& surface) {
  const MeshData& mesh = geometry[static_cast<std::size_t>(index)].mesh;
  try {
    if (const auto* direction = std::get_if<Vec3>(&fibres.along))
      return fem::constant_fibres(*direction, mesh.tets.cols());
    if (const auto* array = std::get_if<FibreArray>(&fibres.along))
      return fibres_of_array(array->name, fibres.density, body, mesh);
    return fibres_between(std::get<FibresBetween>(fibres.along), fibres.density, index, mesh, model,
                          geometry, surface);
  } catch (const std::invalid_argument& error) {
    throw InputError(fibres.where, fmt::format("fibres of tissue `{}`{}: {}", body.name,
                                               mesh_name(body), error.what()));
  }
}

}  // namespace articular::sim
