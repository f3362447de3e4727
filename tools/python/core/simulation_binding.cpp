#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"
#include "sim/contact/contact_summary.hpp"
#include "tools/python/core/arrays.hpp"
#include "tools/python/core/bindings.hpp"
#include "tools/python/core/simulation.hpp"

namespace articular::python {
namespace {

/// A muscle or ligament of a simulation, which it keeps alive.
struct LineOf {
  std::shared_ptr<Simulation> simulation;
  std::string name;
  int line = -1;    // -1: a muscle made of a tissue's fibres
  int muscle = -1;  // -1: a ligament

  const sim::LineState& state() const {
    if (line < 0)
      throw sim::InputError(fmt::format(
          "muscle `{}` is made of a tissue's fibres: it has no length and no force of a line",
          name));
    return simulation->course().stepper().now().lines[static_cast<std::size_t>(line)];
  }
  const sim::MuscleModel& given() const {
    return simulation->model().muscles[static_cast<std::size_t>(muscle)];
  }
};

struct MuscleOf : LineOf {};

/// A sheet of fibres on a tissue of a simulation, which it keeps alive.
struct SheetOf {
  std::shared_ptr<Simulation> simulation;
  std::size_t tissue, sheet;

  const sim::SheetModel& given() const { return simulation->model().tissues[tissue].sheets[sheet]; }
  const std::string& body() const {
    const int index = simulation->model().tissues[tissue].body;
    return simulation->model().bodies[static_cast<std::size_t>(index)].name;
  }
  const Positions& x() const { return simulation->course().stepper().now().tissues[tissue].x; }
};

struct ContactState {
  std::string a, b;
  sim::ContactSummary summary;
};

/// Which triangles of one body lie opposite which faces of the other.
struct ContactFaces {
  std::string triangle_body, face_body;
  py::array pairs;
};

py::array nodes_view(const py::object& self, Quantity quantity, const std::string& body) {
  return view_of(self.cast<Simulation&>().nodes(quantity, body), self);
}

auto nodes_of_body(Quantity quantity) {
  return [quantity](const py::object& self, const std::string& body) {
    return nodes_view(self, quantity, body);
  };
}

py::tuple pose(const Simulation& self, const std::string& body) {
  const sim::BodyModel& given =
      self.model().bodies[static_cast<std::size_t>(body_named(self.model(), body))];
  if (given.rigid < 0)
    throw sim::InputError(fmt::format("`{}` is a tissue: it has no pose", given.name));
  const sim::Pose& now =
      self.course().stepper().now().configuration.poses[static_cast<std::size_t>(given.rigid)];
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const RowMajor R = now.R;
  return py::make_tuple(py::array_t<double>(3, now.p.data()),
                        py::array_t<double>({3, 3}, R.data()));
}

std::string name_of(const Simulation& self, int body) {
  return self.model().bodies[static_cast<std::size_t>(body)].name;
}

std::vector<ContactState> contacts(const Simulation& self) {
  std::vector<ContactState> contacts;
  for (sim::ContactSummary& summary : self.course().stepper().dynamics().contacts()) {
    const sim::ContactModel pair = self.model().contacts[summary.contact];
    contacts.push_back({name_of(self, pair.a), name_of(self, pair.b), summary});
  }
  return contacts;
}

/// Pairs of faces that press on each other or are about to: as many as there are now, so a copy.
std::vector<ContactFaces> contact_pairs(const Simulation& self) {
  std::vector<ContactFaces> found;
  for (const sim::ContactPairState* state : self.course().stepper().now().contact.pair_states()) {
    Eigen::Matrix2Xi pairs(2, static_cast<Eigen::Index>(state->patches().size()));
    for (Eigen::Index i = 0; i < pairs.cols(); ++i) {
      const auto& patch = state->patches()[static_cast<std::size_t>(i)];
      pairs.col(i) = Eigen::Vector2i(patch.triangle, patch.face);
    }
    const sim::ContactSides sides = sim::sides_of(self.model(), *state);
    found.push_back(
        {name_of(self, sides.triangle_body), name_of(self, sides.face_body), copy_of(pairs)});
  }
  return found;
}

py::dict muscles(const std::shared_ptr<Simulation>& self) {
  py::dict lines;
  const auto& all = self->model().muscles;
  for (std::size_t m = 0; m < all.size(); ++m)
    lines[py::str(all[m].given.name)] =
        py::cast(MuscleOf{{self, all[m].given.name, all[m].line, static_cast<int>(m)}});
  return lines;
}

py::dict ligaments(const std::shared_ptr<Simulation>& self) {
  py::dict lines;
  for (const sim::LigamentModel& ligament : self->model().ligaments)
    lines[py::str(ligament.given.name)] =
        py::cast(LineOf{self, ligament.given.name, ligament.line});
  return lines;
}

py::dict sheets(const std::shared_ptr<Simulation>& self) {
  py::dict sheets;
  const auto& tissues = self->model().tissues;
  for (std::size_t t = 0; t < tissues.size(); ++t)
    for (std::size_t s = 0; s < tissues[t].sheets.size(); ++s)
      sheets[py::str(tissues[t].sheets[s].name)] = py::cast(SheetOf{self, t, s});
  return sheets;
}

py::dict probes(Simulation& self) {
  py::dict values;
  const std::vector<double>& row = self.row();
  for (std::size_t c = 0; c < row.size(); ++c) values[py::str(self.columns()[c])] = row[c];
  return values;
}

py::dict energies(const Simulation& self) {
  const sim::StoredEnergy stored = self.course().stepper().stored_energy();
  py::dict energies;
  energies["kinetic"] = stored.kinetic;
  energies["elastic"] = stored.elastic;
  energies["gravity"] = stored.gravity;
  energies["contact"] = stored.contact;
  energies["lines"] = stored.lines;
  return energies;
}

void bind_lines(py::module_& module) {
  const auto length = [](const LineOf& self) { return self.state().length; };
  const auto rate = [](const LineOf& self) { return self.state().rate; };
  const auto force = [](const LineOf& self) { return self.state().tension; };
  py::class_<LineOf>(module, "Ligament", "A ligament at the step where its simulation is.")
      .def_readonly("name", &LineOf::name, "Its name.")
      .def_property_readonly("length", length, "Along its path [m].")
      .def_property_readonly("rate", rate,
                             "Change of its length [m/s], positive where it gets longer.")
      .def_property_readonly("force", force, "Tension [N].");
}

void bind_muscles(py::module_& module) {
  py::class_<MuscleOf, LineOf>(module, "Muscle",
                               R"(A muscle at the step where its simulation is.

`excitation` and `activation` may be set between steps. One made of a tissue's fibres has no length, rate and force.)")
      .def_property_readonly(
          "max_force", [](const MuscleOf& self) { return self.given().given.max_force; },
          "Isometric, at full activation [N].")
      .def_property_readonly(
          "optimal_length", [](const MuscleOf& self) { return self.given().optimal_length; }, "[m]")
      .def_property(
          "activation",
          [](const MuscleOf& self) { return self.simulation->activation(self.muscle); },
          [](MuscleOf& self, double activation) {
            self.simulation->set_activation(self.muscle, activation);
          },
          R"(How active it is, 0 to 1. Set, it counts from now on and then follows the excitation with the
muscle's time constants: set both to hold it. In a static analysis it is the excitation.)")
      .def_property(
          "excitation",
          [](const MuscleOf& self) { return self.simulation->excitation(self.muscle); },
          [](MuscleOf& self, double excitation) {
            self.simulation->set_excitation(self.muscle, excitation);
          },
          "What drives it, 0 to 1. Set, it holds from now on until it is set again.");
}

void bind_sheets(py::module_& module) {
  py::class_<SheetOf>(module, "Sheet",
                      "A sheet of fibres on a tissue, at the step where its simulation is. One row "
                      "or number a face.")
      .def_property_readonly(
          "name", [](const SheetOf& self) { return self.given().name; }, "Its name.")
      .def_property_readonly("body", &SheetOf::body, "Name of the tissue that it lies on.")
      .def_property_readonly(
          "faces",
          [](const py::object& self) {
            return view_of(self.cast<const SheetOf&>().given().fibres.faces(), self);
          },
          "Nodes of the tissue: (K, 3), read-only.")
      .def_property_readonly(
          "areas", [](const SheetOf& self) { return copy_of(self.given().fibres.area()); },
          "At rest [m^2]: (K,).")
      .def_property_readonly(
          "stretches",
          [](const SheetOf& self) { return copy_of(self.given().fibres.stretch(self.x())); },
          "Of its fibres now [-]: (K,).")
      .def_property_readonly(
          "tensions",
          [](const SheetOf& self) { return copy_of(self.given().fibres.tension(self.x())); },
          "Pull of its fibres now, by the width of the sheet [N/m]: (K,).");
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_lines(module);
  bind_muscles(module);
  bind_sheets(module);
  py::class_<ContactState>(module, "Contact",
                           "What two bodies press on each other with, at one step.")
      .def_readonly("a", &ContactState::a, "Name of the one body.")
      .def_readonly("b", &ContactState::b, "Name of the other; the same, where it touches itself.")
      .def_property_readonly(
          "force",
          [](const ContactState& self) {
            return py::array_t<double>(3, self.summary.force.data());
          },
          "On a [N]: (3,).")
      .def_property_readonly(
          "normal_force", [](const ContactState& self) { return self.summary.normal_force; },
          "Pressure times area, summed [N].")
      .def_property_readonly(
          "area", [](const ContactState& self) { return self.summary.area; },
          "That carries, at rest [m^2].")
      .def_property_readonly(
          "max_pressure", [](const ContactState& self) { return self.summary.max_pressure; },
          "Around a node [Pa].")
      .def_property_readonly(
          "max_depth", [](const ContactState& self) { return self.summary.max_depth; },
          "Mean depth at a node [m].");
  py::class_<ContactFaces>(
      module, "ContactPairs",
      "Which triangles of one body lie opposite which faces of the other, at one step.")
      .def_readonly("triangle_body", &ContactFaces::triangle_body,
                    "Name of the body whose triangles look for faces.")
      .def_readonly("face_body", &ContactFaces::face_body, "Name of the other.")
      .def_readonly("pairs", &ContactFaces::pairs,
                    "(P, 2): triangle and face, numbers of faces of the bodies' contact surfaces; "
                    "of a tissue rows of "
                    "Body.triangles. A pair in parts has several rows.");
  py::class_<Simulation, std::shared_ptr<Simulation>>(module, "Simulation",
                                                      R"(A model on its way, between two steps.

Iterate over it: each step gives itself. Arrays of nodes are views: they lie in its memory, are read-only, keep it
alive, and show the numbers of now after each step. `numpy.array(view)` keeps those of one step.

Ctrl-C in a step raises KeyboardInterrupt; the simulation is then where the step began, and can go on.)")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](py::object self) {
             if (!self.cast<Simulation&>().advance()) throw py::stop_iteration();
             return self;
           })
      .def("advance", &Simulation::advance,
           R"(One step: to the next time at which a run of the scenario has one.

Returns False at the end, where there is none. Raises SimulationError when it can't go on.)")
      .def_property_readonly(
          "time", [](const Simulation& self) { return self.course().state().t; }, "[s]")
      .def_property_readonly(
          "duration", [](const Simulation& self) { return self.scenario().duration; },
          "Simulated time in all [s].")
      .def_property_readonly(
          "is_done", [](const Simulation& self) { return self.course().is_done(); },
          "Whether the end is reached.")
      .def("positions", nodes_of_body(Quantity::Position), py::arg("body"),
           "Nodes of a body now [m]: (N, 3), a view.")
      .def("velocities", nodes_of_body(Quantity::Velocity), py::arg("body"),
           "Velocities of its nodes [m/s]: (N, 3), a view.")
      .def("elastic_forces", nodes_of_body(Quantity::ElasticForce), py::arg("body"),
           "Forces that hold a tissue's shape, at its nodes [N]: (N, 3), a view. The tissue pulls "
           "the other way.")
      .def("contact_forces", nodes_of_body(Quantity::ContactForce), py::arg("body"),
           "Contact forces on a tissue's nodes [N]: (N, 3), a view.")
      .def("pose", pose, py::arg("body"),
           "Of a bone: its reference point [m], (3,), and its rotation since the start, (3, 3).")
      .def_property_readonly("contacts", contacts, "A Contact for each two bodies that are near.")
      .def_property_readonly("contact_pairs", contact_pairs,
                             "A ContactPairs for each two bodies that are near; copies.")
      .def_property_readonly("muscles", muscles, "Muscles by their names.")
      .def_property_readonly("ligaments", ligaments, "Ligaments by their names.")
      .def_property_readonly("sheets", sheets, "Sheets of fibres by their names.")
      .def_property_readonly("probes", probes,
                             "What `history.csv` would have in a row now, by its columns.")
      .def_property_readonly("energies", energies,
                             "Stored now [J]: kinetic, elastic, gravity, contact, lines.")
      .def("__repr__", [](const Simulation& self) {
        return fmt::format("<articular.Simulation of {}>", self.scenario().name);
      });
}

}  // namespace articular::python
