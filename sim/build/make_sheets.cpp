#include "sim/build/make_sheets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/base/mistakes.hpp"
#include "sim/build/make_fibres.hpp"
#include "sim/build/region.hpp"

namespace articular::sim {
namespace {

using collision::Surface;

/// Columns of the surface's faces.
std::vector<int> faces_in(const Sheet& sheet, int body, const Tissue& tissue,
                          const Surface& surface, const Model& model,
                          const std::vector<BodyGeometry>& geometry) {
  const RegionTest test(sheet.at.region, body, model, geometry);
  std::vector<int> faces;
  for (int i = 0; i < surface.faces.cols(); ++i) {
    const Eigen::Vector3i nodes = surface.faces.col(i);
    const Mat3 corners = tissue.X(Eigen::all, nodes);
    if (test.contains_face(nodes, corners.rowwise().mean())) faces.push_back(i);
  }
  if (faces.empty())
    throw InputError(sheet.where, fmt::format("[[sheet]] `{}`: no face of the surface of tissue "
                                              "`{}` has its middle in the region",
                                              sheet.name, sheet.at.tissue));
  return faces;
}

/// The element of each face of a surface.
std::vector<int> element_of_faces(const Triangles& faces, const Tetrahedra& tets, int num_nodes) {
  std::vector<std::vector<int>> around(static_cast<std::size_t>(num_nodes));
  for (int e = 0; e < tets.cols(); ++e)
    for (const int node : tets.col(e)) around[static_cast<std::size_t>(node)].push_back(e);
  std::vector<int> elements;
  for (const auto& face : faces.colwise()) {
    const std::vector<int>& near = around[static_cast<std::size_t>(face[0])];
    elements.push_back(*std::ranges::find_if(near, [&](int e) {
      return (tets.col(e).array() == face[1]).any() && (tets.col(e).array() == face[2]).any();
    }));
  }
  return elements;
}

SheetModel make_sheet(const Sheet& sheet, const Body& body, int index, const Tissue& tissue,
                      const Surface& surface, const Model& model,
                      const std::vector<BodyGeometry>& geometry) {
  const Triangles faces =
      surface.faces(Eigen::all, faces_in(sheet, index, tissue, surface, model, geometry));
  const FibreDirections fibres =
      sheet.fibres ? make_fibres(*sheet.fibres, body, index, model, geometry, surface)
                   : tissue.fibres;
  const std::vector<int> elements =
      element_of_faces(faces, tissue.elements.tets(), static_cast<int>(tissue.X.cols()));
  try {
    return {sheet.name, fem::FibreSheet(tissue.X, faces, fibres(Eigen::all, elements),
                                        sheet.thickness, {sheet.young_modulus, sheet.toe_strain},
                                        tissue.elements.make_plain_matrix())};
  } catch (const std::invalid_argument& error) {
    throw InputError(sheet.where, fmt::format("[[sheet]] `{}`: {}; expected `fibres` along the "
                                              "surface",
                                              sheet.name, error.what()));
  }
}

}  // namespace

void make_sheets(const Scenario& scenario, const std::vector<BodyGeometry>& geometry,
                 const std::vector<Surface>& surfaces, Model& model) {
  read_each(scenario.sheets, [&](const Sheet& sheet) {
    const int body = body_index(scenario, sheet.at.tissue);
    const auto b = static_cast<std::size_t>(body);
    const auto t = static_cast<std::size_t>(model.bodies[b].tissue);
    Tissue& tissue = model.tissues[t];
    tissue.sheets.push_back(
        make_sheet(sheet, scenario.bodies[b], body, tissue, surfaces[t], model, geometry));
  });
}

}  // namespace articular::sim
