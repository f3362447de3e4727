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
  py::class_<BodyOf>(module, "Body")
      .def_property_readonly("name", [](const BodyOf& self) { return self.body().name; })
      .def_property_readonly("kind", kind_of)
      .def_property_readonly("positions", positions_of_body)
      .def_property_readonly("tetrahedra", tetrahedra_of)
      .def_property_readonly("triangles", triangles_of)
      .def("__repr__", [](const BodyOf& self) {
        return fmt::format("<articular.Body {}: {}>", self.body().name, kind_of(self));
      });
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Model")
      .def(py::init([](const ScenarioFile& scenario) { return make_scene(scenario.read); }),
           py::arg("scenario"))
      .def_property_readonly("bodies", bodies_of)
      .def_property_readonly("muscles", names_of_muscles)
      .def_property_readonly("ligaments", names_of_ligaments)
      .def_property_readonly("contacts", contacts_of)
      .def_property_readonly("is_static", [](const Scene& self) { return self.model.is_static; })
      .def_property_readonly(
          "num_unknowns",
          [](const Scene& self) { return 3 * self.model.layout.num_unknown_blocks(); })
      .def_property_readonly("warnings", [](const Scene& self) { return self.model.warnings; })
      .def("steps", [](const std::shared_ptr<Scene>& self) { return Simulation::begin(self); })
      .def("__repr__", [](const Scene& self) {
        return fmt::format("<articular.Model of {}: {} bodies>", self.scenario.name,
                           self.model.bodies.size());
      });
}

}  // namespace articular::python
