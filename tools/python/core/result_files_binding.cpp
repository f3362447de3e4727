#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <stdexcept>

#include "sim/mesh/frame_series.hpp"
#include "sim/mesh/vtk_xml_file.hpp"
#include "tools/python/core/arrays.hpp"
#include "tools/python/core/bindings.hpp"

namespace articular::python {
namespace {

py::dict fields_of(const std::vector<sim::VtkXmlField>& fields) {
  py::dict arrays;
  for (const sim::VtkXmlField& field : fields) {
    const auto columns = static_cast<py::ssize_t>(field.components);
    const auto rows = static_cast<py::ssize_t>(field.values.size()) / columns;
    arrays[py::str(field.name)] = columns == 1
                                      ? py::array_t<double>(rows, field.values.data())
                                      : py::array_t<double>({rows, columns}, field.values.data());
  }
  return arrays;
}

/// Beginnings and nodes.
py::tuple cells_of(const sim::VtkXmlCells& cells) {
  return py::make_tuple(copy_of(cells.begin), copy_of(cells.nodes));
}

/// A .vtu or .vtp of a run: arrays by name.
py::dict read_mesh_file(const std::filesystem::path& file) {
  sim::VtkXmlContent content;
  {
    const py::gil_scoped_release release;
    content = sim::read_vtk_xml(file, sim::VtkXmlFields::All);
  }
  py::dict mesh;
  const auto num_points = static_cast<py::ssize_t>(content.points.size() / 3);
  mesh["points"] = py::array_t<double>({num_points, py::ssize_t{3}}, content.points.data());
  mesh["cells"] = cells_of(content.cells);
  mesh["lines"] = cells_of(content.lines);
  mesh["polygons"] = cells_of(content.polygons);
  mesh["types"] = copy_of(content.types);
  mesh["point_data"] = fields_of(content.point_fields);
  mesh["cell_data"] = fields_of(content.cell_fields);
  mesh["texts"] = py::cast(content.texts);
  return mesh;
}

/// Time, part and file of each entry of a .pvd.
py::list read_series(const std::filesystem::path& pvd) {
  py::list entries;
  for (const sim::SeriesEntry& entry : sim::read_series(pvd))
    entries.append(py::make_tuple(entry.time, entry.part, entry.file));
  return entries;
}

}  // namespace

void bind_result_files(py::module_& module) {
  module.def("read_mesh_file", read_mesh_file, py::arg("file"),
             "Arrays of a .vtu or .vtp, by name. See Frame.mesh.");
  module.def("read_series", read_series, py::arg("pvd"),
             "Time [s], part and file of each entry of a .pvd. See Results.frames.");
}

}  // namespace articular::python
