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

SheetModel make_sheet(const Sheet& sheet, const Body& body, int index, const Tissue& tissue,
                      const Surface& surface, const Model& model,
                      const std::vector<BodyGeometry>& geometry) {
  const std::vector<int> columns =
      faces_in(sheet.at.region, index, model, geometry, tissue, surface.faces);
  if (columns.empty())
    throw InputError(sheet.where, fmt::format("[[sheet]] `{}`: no face of the surface of tissue "
                                              "`{}` has its middle in the region",
                                              sheet.name, sheet.at.tissue));
  const Triangles faces = surface.faces(Eigen::all, columns);
  const FibreDirections fibres =
      sheet.fibres ? make_fibres(*sheet.fibres, body, index, model, geometry, surface)
                   : tissue.fibres;
  std::vector<int> elements(columns.size());  // under the faces
  std::ranges::transform(columns, elements.begin(), [&surface](int column) {
    return surface.face_tet[static_cast<std::size_t>(column)];
  });
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

bool have_common_faces(const fem::FibreSheet& p, const fem::FibreSheet& q) {
  for (const auto& face : p.faces().colwise())
    for (const auto& other : q.faces().colwise())
      if (face == other) return true;
  return false;
}

/// A sheet and its mirror image pull twice where they lie on the same faces.
void refuse_own_image(const Scenario& scenario, const Sheet& sheet, const Tissue& tissue) {
  for (const Sheet& other : scenario.sheets) {
    if (&other == &sheet) return;
    if (other.at.tissue != sheet.at.tissue || other.where.line != sheet.where.line) continue;
    const auto image = std::ranges::find(tissue.sheets, other.name, &SheetModel::name);
    if (have_common_faces(image->fibres, tissue.sheets.back().fibres))
      throw InputError(sheet.where,
                       fmt::format("[[sheet]] `{}`: it has faces in common with its image `{}`, "
                                   "where both would pull; expected a region on one side of x = 0, "
                                   "or no `mirror`",
                                   sheet.name, other.name));
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
    refuse_own_image(scenario, sheet, tissue);
  });
}

}  // namespace articular::sim
