#pragma once

#include <string>
#include <vector>

#include "tests/scenarios/scenario_results.hpp"
#include "tools/anatomy/anatomy.hpp"
#include "tools/anatomy/anatomy_knee.hpp"

namespace articular::knee_test {

/// Runs a scenario with the meshes of an anatomy in place of the shipped ones.
inline ScenarioResults run_with(const anatomy::Anatomy& anatomy, sim::Scenario scenario) {
  const TemporaryFolder folder;
  anatomy::write_anatomy(anatomy, folder.path() / "anatomy");
  for (sim::Body& body : scenario.bodies) {
    if (auto* mesh = std::get_if<sim::MeshFile>(&body.geometry))
      mesh->path = folder.path() / "anatomy" / mesh->path.filename();
    for (sim::MeshFile& file : body.contact_meshes)
      file.path = folder.path() / "anatomy" / file.path.filename();
  }
  return run_scenario(scenario);
}

/// A scenario of scenarios/knee/ with elements of 4 mm.
inline ScenarioResults coarse_knee(const std::string& file,
                                   const std::vector<std::string>& overrides) {
  return run_with(anatomy::knee_anatomy({4, 2}, {.ligaments = true}),
                  shipped_scenario("knee/" + file, overrides));
}

}  // namespace articular::knee_test
