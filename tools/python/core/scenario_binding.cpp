#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <stdexcept>
#include <utility>

#include "tools/python/core/bindings.hpp"
#include "tools/python/core/scene.hpp"
#include "tools/python/core/toml_text.hpp"
#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::python {
namespace {

constexpr int kMostThreads = 256;

/// As --set takes it: there, text needs no quotes.
std::string override_text(const std::string& key, py::handle value) {
  return key + "=" +
         (py::isinstance<py::str>(value) ? py::cast<std::string>(value) : toml_text(value));
}

/// Of a dict of keys and values, or of a list of "KEY=VALUE".
std::vector<std::string> overrides_from(const py::object& given) {
  std::vector<std::string> overrides;
  if (given.is_none()) return overrides;
  if (py::isinstance<py::str>(given))
    throw py::type_error("set: expected a dict of keys and values, or a list of \"KEY=VALUE\"");
  if (!py::isinstance<py::dict>(given)) return py::cast<std::vector<std::string>>(given);
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(given))
    overrides.push_back(override_text(py::cast<std::string>(key), value));
  return overrides;
}

void set_threads(ScenarioFile& scenario, int threads) {
  if (threads < 1 || threads > kMostThreads)
    throw std::invalid_argument(
        fmt::format("threads: expected 1 to {}, found {}", kMostThreads, threads));
  scenario.read.threads = threads;
}

/// With more overrides; where these are wrong, it stays as it is.
void set(ScenarioFile& scenario, const std::vector<std::string>& more) {
  std::vector<std::string> overrides = scenario.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  sim::Scenario read = sim::read_scenario(scenario.file, overrides);
  read.threads = scenario.read.threads;
  scenario.read = std::move(read);
  scenario.overrides = std::move(overrides);
}

ScenarioFile read(const std::filesystem::path& source, const std::vector<std::string>& overrides,
                  int threads) {
  ScenarioFile scenario{.file = tools::find_file_for("run", source), .overrides = {}, .read = {}};
  set_threads(scenario, threads);
  set(scenario, overrides);
  return scenario;
}

py::list shipped() {
  py::list list;
  for (const tools::ShippedScenario& scenario : tools::shipped_scenarios())
    list.append(py::make_tuple(scenario.name, scenario.kind, scenario.title));
  return list;
}

}  // namespace

void bind_scenario(py::module_& module) {
  py::class_<ScenarioFile>(module, "Scenario", R"(A scenario file, read and checked.

>>> scenario = Scenario("mandible/opening", set={"duration": "0.1 s"})
>>> scenario.title, scenario.duration
('Jaw opening', 0.1)
>>> scenario.set("body.disc_left.material.c10", "1 MPa")
>>> scenario.set("duratoin", "1 s")
Traceback (most recent call last):
    ...
articular.InputError: --set duratoin=1 s: scenario: unknown key `duratoin`; did you mean `duration`?)")
      .def(py::init([](const std::filesystem::path& source, const py::object& set, int threads) {
             return read(source, overrides_from(set), threads);
           }),
           py::arg("source"), py::kw_only(), py::arg("set") = py::none(), py::arg("threads") = 1,
           R"(source: path of a file, or name of a shipped scenario.
set: what `--set` of the program takes: a dict of paths and values, or a list of "PATH=VALUE".
    A value is a text with its unit ("15 kPa"), a number, a bool, a list, a dict or a numpy array.
threads: of element loops, linear solvers and contact search. Results do not depend on it.

Raises InputError with a line for each mistake, as the program prints it.)")
      .def(
          "set",
          [](ScenarioFile& self, const std::string& key, const py::object& value) {
            set(self, {override_text(key, value)});
          },
          py::arg("key"), py::arg("value"),
          R"(Overrides a value by its path, as `--set` does. It is checked at once: where it is wrong,
InputError says why, and the scenario stays as it was.)")
      .def_readonly("file", &ScenarioFile::file, "The scenario's file.")
      .def_property_readonly(
          "name", [](const ScenarioFile& self) { return self.read.name; },
          "Name of the file without ending: names the results.")
      .def_property_readonly(
          "title", [](const ScenarioFile& self) { return self.read.title; }, "Its title.")
      .def_property_readonly(
          "duration", [](const ScenarioFile& self) { return self.read.duration; },
          "Simulated time [s].")
      .def_property_readonly(
          "is_static",
          [](const ScenarioFile& self) {
            return self.read.analysis == sim::Scenario::Analysis::Static;
          },
          "Equilibrium under loads over time, not motion in time.")
      .def_property_readonly(
          "settings",
          [](const ScenarioFile& self) {
            return py::module_::import("json").attr("loads")(self.read.settings_json);
          },
          "Settings after presets and overrides, as `summary.json` has them.")
      .def_property_readonly(
          "overrides", [](const ScenarioFile& self) { return self.overrides; },
          "What was set, as \"PATH=VALUE\".")
      .def_property(
          "threads", [](const ScenarioFile& self) { return self.read.threads; }, set_threads,
          "Threads that a run or a model of it uses.")
      .def("__repr__",
           [](const ScenarioFile& self) {
             return fmt::format("<articular.Scenario {}>", self.file.string());
           })
      .def(py::pickle(
          [](const ScenarioFile& self) {
            return py::make_tuple(self.file, self.overrides, self.read.threads);
          },
          [](const py::tuple& kept) {
            return read(kept[0].cast<std::filesystem::path>(),
                        kept[1].cast<std::vector<std::string>>(), kept[2].cast<int>());
          }));
  module.def("scenarios", shipped,
             R"(The shipped scenarios, studies and fits: a list of (name, kind, title).

>>> [name for name, kind, title in scenarios() if kind == "static"][:1]
['knee/axial-load'])");
}

}  // namespace articular::python
