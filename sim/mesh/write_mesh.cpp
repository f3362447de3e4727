#include "sim/base/error.hpp"
#include "sim/mesh/mesh_io.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::sim {

void write_mesh(const std::filesystem::path& file, const MeshData& mesh, double unit) {
  const std::string expected = mesh.tets.cols() > 0 ? ".vtu" : ".vtp";
  if (lower_ending(file) != expected)
    throw InputError({file.string()}, "this mesh is written as `" + expected + "`, not as `" +
                                          lower_ending(file) + "`");
  const auto set = mesh.tets.cols() > 0 ? make_grid(mesh.X, unit, mesh.tets, mesh.triangles)
                                        : make_surface(mesh.X, unit, mesh.triangles);
  for (const auto& [name, values] : mesh.cell_vectors) add_cell_vectors(*set, name, values);
  for (const MeshSet& nodes : mesh.sets)
    if (nodes.faces.empty() && nodes.tets.empty()) add_node_set(*set, nodes.name, nodes.nodes);
  write_vtk_file(file, *set, Compressed::Yes);
}

}  // namespace articular::sim
