#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <optional>

#include "fem/element/elasticity.hpp"
#include "fem/element/smoothed_elasticity.hpp"
#include "fem/material/any_material.hpp"
#include "fem/mesh/fibre_field.hpp"
#include "sim/model/tissue_elements.hpp"
#include "sim/scenario/scenario_reader.hpp"
#include "tools/python/core/arrays.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/toml_text.hpp"

namespace articular::python {
namespace {

using sim::TissueElements;
using sim::TissueMaterial;

/// The elements of one mesh. They hold work memory, so one thread computes with them at a time.
struct Elements {
  TissueElements elements;
  Positions X;
  std::mutex in_use = {};

  Elements(TissueElements given, Positions points)
      : elements(std::move(given)), X(std::move(points)) {}

  /// Without Python's lock.
  template <class Function>
  auto compute(Function&& function) {
    const py::gil_scoped_release release;
    const std::lock_guard lock(in_use);
    return function();
  }
};

TissueMaterial material_from(const py::dict& given) {
  const sim::Location where{"material"};
  return sim::read_material(sim::parse_toml_value(toml_text(given), "material", where));
}

/// One unit vector an element where the law has fibres, else none.
FibreDirections fibres_of(const TissueMaterial& material, Eigen::Index num_elements,
                          const py::object& directions) {
  if (!directions.is_none()) {
    if (!material.fibres) throw sim::InputError("fibres: the material has a law without fibres");
    return fem::normalized_fibres(positions_from(directions, "fibres", num_elements));
  }
  if (!material.fibres) return {};
  if (const auto* along = std::get_if<Vec3>(&material.fibres->along))
    return fem::constant_fibres(*along, num_elements);
  throw sim::InputError(
      "material: `fibres` of an array or between regions belong to a scenario; expected a "
      "direction, or the argument `fibres` with one row a tetrahedron");
}

TissueElements make_elements(const Positions& X, const Tetrahedra& tets,
                             const TissueMaterial& material, const FibreDirections& fibres) {
  if (material.element == TissueMaterial::Element::Plain)
    return TissueElements(fem::Elasticity(X, tets, *material.law, fibres));
  return TissueElements(fem::SmoothedElasticity(X, tets, *material.law, {}, fibres));
}

std::unique_ptr<Elements> make(const py::object& points, const py::object& tetrahedra,
                               const py::dict& given, const py::object& directions) {
  const Positions X = positions_from(points, "points");
  const Tetrahedra tets = tetrahedra_from(tetrahedra, "tetrahedra");
  const TissueMaterial material = material_from(given);
  const FibreDirections fibres = fibres_of(material, tets.cols(), directions);
  return std::make_unique<Elements>(make_elements(X, tets, material, fibres), X);
}

/// Positions that a user gives for the nodes of this mesh.
Positions of_nodes(const Elements& self, const py::object& points) {
  return positions_from(points, "points", self.X.cols());
}

double energy(Elements& self, const py::object& points, double activation) {
  const Positions x = of_nodes(self, points);
  return self.compute([&] { return self.elements.energy(x, activation); });
}

py::array forces(Elements& self, const py::object& points, double activation) {
  const Positions x = of_nodes(self, points);
  Positions f = Positions::Zero(3, x.cols());
  self.compute([&] {
    Eigen::VectorXd p;
    self.elements.pressure(x, p);
    self.elements.add_internal_force(x, p, activation, f);
  });
  return copy_of(f);
}

/// As scipy's BSR has it: blocks by rows.
py::tuple parts_of(const fem::BlockMatrix& K) {
  py::array_t<double> blocks({K.num_nonzero_blocks(), 3, 3});
  for (int slot = 0; slot < K.num_nonzero_blocks(); ++slot)
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(blocks.mutable_data() + 9 * slot) =
        K.block(slot);
  return py::make_tuple(std::move(blocks),
                        py::array_t<int>(K.num_nonzero_blocks(), K.column().data()),
                        py::array_t<int>(K.num_blocks() + 1, K.row_begin().data()));
}

py::tuple stiffness(Elements& self, const py::object& points, double activation) {
  const Positions x = of_nodes(self, points);
  fem::BlockMatrix K = self.elements.make_matrix();
  self.compute([&] {
    Eigen::VectorXd p;
    self.elements.pressure(x, p);
    self.elements.add_stiffness(x, p, activation, fem::Tangent::Consistent, 1, K);
  });
  return parts_of(K);
}

const fem::SmoothedElasticity& smoothed(const Elements& self) {
  if (const fem::SmoothedElasticity* elements = self.elements.smoothed()) return *elements;
  throw sim::InputError("plain elements have no pressure of their own");
}

/// G, 3 rows a node and a column a pressure: values, columns and beginnings of rows of nodes.
py::tuple pressure_gradient(Elements& self, const py::object& points) {
  const Positions x = of_nodes(self, points);
  const fem::SmoothedElasticity& elements = smoothed(self);
  fem::PressureGradient G = elements.make_pressure_gradient();
  self.compute([&] { elements.set_pressure_gradient(x, G); });
  const auto num_slots = static_cast<py::ssize_t>(G.column().size());
  return py::make_tuple(
      py::array_t<double>({num_slots, py::ssize_t{3}, py::ssize_t{1}}, G.values()),
      py::array_t<int>(num_slots, G.column().data()),
      py::array_t<int>(G.num_nodes() + 1, G.row_begin().data()), G.num_pressures());
}

/// A, its upper half by columns: values, rows and beginnings of columns.
py::tuple pressure_compliance(const Elements& self) {
  const fem::SymmetricMatrix& A = smoothed(self).nodal_pressure().compliance();
  return py::make_tuple(copy_of(A.value), copy_of(A.row), copy_of(A.begin));
}

}  // namespace

void bind_fem(py::module_& module) {
  py::module_ part = module.def_submodule("fem");
  const auto activated = py::arg("activation") = 0.0;
  py::class_<Elements>(part, "Elements", R"(Tetrahedra of one material: N points, M elements.

The activation, 0 to 1, is that of fibres, where the material has any.)")
      .def(
          py::init(&make), py::arg("points"), py::arg("tetrahedra"), py::arg("material"),
          py::arg("fibres") = py::none(),
          R"(points: at rest [m], (N, 3). tetrahedra: (M, 4) numbers of points from 0, of positive volume.
material: a dict with the keys of `material` in scenario files; `element` is "smoothed" or "plain".
fibres: directions, (M, 3), in place of those of the material.

Raises InputError for the material, ValueError for the arrays.)")
      .def_property_readonly(
          "is_smoothed", [](const Elements& self) { return self.elements.smoothed() != nullptr; },
          "Smoothed elements, or plain ones.")
      .def_property_readonly(
          "points", [](const py::object& self) { return view_of(self.cast<Elements&>().X, self); },
          "At rest [m]: (N, 3), read-only, no copy.")
      .def_property_readonly(
          "tetrahedra",
          [](const py::object& self) {
            return view_of(self.cast<Elements&>().elements.tets(), self);
          },
          "(M, 4), read-only, no copy.")
      .def_property_readonly(
          "rest_volume", [](const Elements& self) { return copy_of(self.elements.rest_volume()); },
          "Volume of each element at rest [m^3]: (M,).")
      .def("energy", energy, py::arg("points"), activated,
           "Stored at these points, (N, 3) [m]: W [J].")
      .def("forces", forces, py::arg("points"), activated,
           "The derivative of the energy by the points: what holds the shape [N], (N, 3).")
      .def("stiffness_parts", stiffness, py::arg("points"), activated,
           "Blocks (B, 3, 3), their columns and beginnings of rows, as scipy.sparse.bsr_matrix "
           "takes them: `tangent` and `saddle_point` are made of it.")
      .def("pressure_gradient_parts", pressure_gradient, py::arg("points"),
           "G of smoothed elements: blocks (B, 3, 1), their columns, beginnings of rows, and the "
           "number of pressures.")
      .def(
          "pressure_compliance_parts", pressure_compliance,
          "A of smoothed elements, the upper half by columns: values, rows, beginnings of columns.")
      .def(
          "cauchy_stress",
          [](Elements& self, const py::object& points, double activation) {
            const Positions x = of_nodes(self, points);
            return copy_of(
                self.compute([&] { return self.elements.cauchy_stress(x, activation); }));
          },
          py::arg("points"), activated, "xx yy zz xy yz xz of each element [Pa]: (M, 6).")
      .def(
          "volume_ratio",
          [](Elements& self, const py::object& points) {
            const Positions x = of_nodes(self, points);
            return copy_of(self.compute([&] { return self.elements.volume_ratio(x); }));
          },
          py::arg("points"), "Volume of each element by that at rest: (M,).")
      .def(
          "lumped_mass",
          [](const Elements& self, double density) {
            return copy_of(fem::lumped_mass(self.X, self.elements.tets(), density));
          },
          py::arg("density"), "Mass of each point [kg], (N,), for a density [kg/m^3].");
}

}  // namespace articular::python
