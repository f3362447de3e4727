#include <fmt/format.h>
#include <pybind11/stl.h>

#include "collision/mesh/surface.hpp"
#include "tools/python/core/arrays.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/simulation.hpp"

namespace articular::python {
namespace {

/// A body of a model, which it keeps alive.
struct BodyOf {
  std::shared_ptr<Scene> scene;
  std::size_t index;

  const sim::BodyModel& body() const { return scene->model.bodies[index]; }
  const sim::Tissue* tissue() const {
    return body().tissue < 0 ? nullptr
                             : &scene->model.tissues[static_cast<std::size_t>(body().tissue)];
  }
};

const char* kind_of(const BodyOf& self) {
  switch (self.body().kind) {
    case sim::Body::Kind::Fixed:
      return "fixed";
    case sim::Body::Kind::Rigid:
      return "rigid";
    case sim::Body::Kind::Tissue:
      break;
  }
  return "tissue";
}

py::array positions_of_body(const py::object& self) {
  const auto& body = self.cast<const BodyOf&>();
  if (const sim::Tissue* tissue = body.tissue()) return view_of(tissue->X, self);
  return read_only(copy_of(sim::start_positions(body.scene->model, body.body())));
}

py::array tetrahedra_of(const py::object& self) {
  const auto& body = self.cast<const BodyOf&>();
  if (const sim::Tissue* tissue = body.tissue()) return view_of(tissue->elements.tets(), self);
  return read_only(copy_of(Tetrahedra(4, 0)));
}

py::array triangles_of(const py::object& self) {
  const auto& body = self.cast<const BodyOf&>();
  const sim::Tissue* tissue = body.tissue();
  if (tissue == nullptr) return view_of(body.body().triangles, self);
  const auto num_nodes = static_cast<int>(tissue->X.cols());
  return read_only(
      copy_of(Triangles(collision::build_surface(tissue->elements.tets(), num_nodes).faces)));
}

py::dict bodies_of(const std::shared_ptr<Scene>& scene) {
  py::dict bodies;
  for (std::size_t b = 0; b < scene->model.bodies.size(); ++b)
    bodies[py::str(scene->model.bodies[b].name)] = py::cast(BodyOf{scene, b});
  return bodies;
}

std::vector<std::string> names_of_muscles(const Scene& scene) {
  std::vector<std::string> names;
  for (const sim::MuscleModel& muscle : scene.model.muscles) names.push_back(muscle.given.name);
  return names;
}

std::vector<std::string> names_of_ligaments(const Scene& scene) {
  std::vector<std::string> names;
  for (const sim::LigamentModel& ligament : scene.model.ligaments)
    names.push_back(ligament.given.name);
  return names;
}

std::vector<std::string> names_of_sheets(const Scene& scene) {
  std::vector<std::string> names;
  for (const sim::Tissue& tissue : scene.model.tissues)
    for (const sim::SheetModel& sheet : tissue.sheets) names.push_back(sheet.name);
  return names;
}

/// All that may meet.
std::vector<std::pair<std::string, std::string>> contacts_of(const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> pairs;
  const auto name = [&](int body) {
    return scene.model.bodies[static_cast<std::size_t>(body)].name;
  };
  for (const sim::ContactId id : scene.model.contacts.all()) {
    const sim::ContactModel contact = scene.model.contacts[id];
    pairs.emplace_back(name(contact.a), name(contact.b));
  }
  return pairs;
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<BodyOf>(module, "Body",
                     "A tissue or a bone of a model, at the start. It keeps the model alive.")
      .def_property_readonly(
          "name", [](const BodyOf& self) { return self.body().name; }, "Its name in the scenario.")
      .def_property_readonly("kind", kind_of, "\"tissue\", \"rigid\" or \"fixed\".")
      .def_property_readonly(
          "positions", positions_of_body,
          "Nodes of its mesh at the start [m]: (N, 3), read-only. No copy, of a tissue.")
      .def_property_readonly(
          "tetrahedra", tetrahedra_of,
          "Numbers of nodes from 0: (M, 4), read-only. No copy. Bones have none.")
      .def_property_readonly(
          "triangles", triangles_of,
          "Its surface, numbers of nodes, counterclockwise from outside: (K, 3), read-only.")
      .def("__repr__", [](const BodyOf& self) {
        return fmt::format("<articular.Body {}: {}>", self.body().name, kind_of(self));
      });
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Model",
                                            R"(A scenario made ready to compute. It never changes.

>>> model = Model(Scenario("mandible/opening"))
>>> model.bodies["disc_left"].positions.shape[1]
3)")
      .def(py::init([](const ScenarioFile& scenario) { return make_scene(scenario.read); }),
           py::arg("scenario"),
           R"(Reads the meshes and builds the model. Later changes of the scenario do not reach it.

Raises InputError for what only the geometry can tell. Doubts about the scene are RunWarnings.)")
      .def_property_readonly("bodies", bodies_of,
                             "All bodies by their names, in the scenario's order.")
      .def_property_readonly("muscles", names_of_muscles, "Names of muscles.")
      .def_property_readonly("ligaments", names_of_ligaments, "Names of ligaments.")
      .def_property_readonly("sheets", names_of_sheets, "Names of sheets of fibres.")
      .def_property_readonly("contacts", contacts_of, "Names of each two bodies that may touch.")
      .def_property_readonly(
          "is_static", [](const Scene& self) { return self.model.is_static; },
          "As of the scenario.")
      .def_property_readonly(
          "num_unknowns",
          [](const Scene& self) { return 3 * self.model.layout.num_unknown_blocks(); },
          "Unknown velocities (or displacements): 3 a free node, 6 a free bone.")
      .def_property_readonly(
          "warnings", [](const Scene& self) { return self.model.warnings; },
          "Doubts about the scene, a sentence each.")
      .def(
          "steps", [](const std::shared_ptr<Scene>& self) { return Simulation::begin(self); },
          R"(A Simulation at the start, which goes from step to step. It writes nothing.

>>> model = Model(Scenario("verification/pendulum", set={"duration": "5 ms"}))
>>> for step in model.steps():
...     pass
>>> step.time
0.005)")
      .def("__repr__", [](const Scene& self) {
        return fmt::format("<articular.Model of {}: {} bodies>", self.scenario.name,
                           self.model.bodies.size());
      });
}

}  // namespace articular::python
