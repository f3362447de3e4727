#include <vector>

#include "sim/mesh/cell_collector.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/mesh_sets.hpp"
#include "sim/mesh/vtk_xml_file.hpp"

namespace articular::sim {
namespace {

template <class TypeOf>
void add_all(const VtkXmlCells& cells, CellCollector& collector, TypeOf type_of) {
  for (std::size_t e = 0; e + 1 < cells.begin.size(); ++e)
    collector.add(type_of(e), cells.begin[e + 1] - cells.begin[e],
                  cells.nodes.data() + cells.begin[e]);
}

/// Cell arrays with three components, of the tetrahedra alone.
std::vector<std::pair<std::string, Eigen::Matrix3Xd>> tetrahedra_vectors(
    const VtkXmlContent& content) {
  std::vector<Eigen::Index> tets;
  for (std::size_t e = 0; e < content.types.size(); ++e)
    if (content.types[e] == vtk_cell::kTetrahedron) tets.push_back(static_cast<Eigen::Index>(e));
  std::vector<std::pair<std::string, Eigen::Matrix3Xd>> vectors;
  for (const VtkXmlField& field : content.cell_fields) {
    const Eigen::Map<const Eigen::Matrix3Xd> all(field.values.data(), 3,
                                                 static_cast<Eigen::Index>(content.types.size()));
    vectors.emplace_back(field.name, all(Eigen::all, tets));
  }
  return vectors;
}

}  // namespace

MeshData read_vtk_xml_mesh(const std::filesystem::path& file) {
  const VtkXmlContent content = read_vtk_xml(file, VtkXmlFields::OfMeshes);
  CellCollector cells(file.string());
  MeshData mesh;
  if (content.is_grid) {
    add_all(content.cells, cells, [&](std::size_t e) { return content.types[e]; });
    mesh.cell_vectors = tetrahedra_vectors(content);
  } else {
    add_all(content.polygons, cells, [](std::size_t) { return vtk_cell::kPolygon; });
    add_all(content.strips, cells, [](std::size_t) { return vtk_cell::kTriangleStrip; });
  }
  cells.put_into(mesh);
  mesh.X = Eigen::Map<const Positions>(content.points.data(), 3,
                                       static_cast<Eigen::Index>(content.points.size() / 3));
  for (const VtkXmlField& field : content.point_fields)
    add_set_of_points(field.name, field.values, mesh);
  return mesh;
}

}  // namespace articular::sim
