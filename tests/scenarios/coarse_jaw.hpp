#pragma once

#include <string>
#include <variant>
#include <vector>

#include "tests/scenarios/scenario_results.hpp"
#include "tools/anatomy/anatomy.hpp"
#include "tools/anatomy/anatomy_joint.hpp"

namespace articular {

/// Runs a scenario of scenarios/mandible/ with discs of 1.8 mm in place of 1.2 mm: where a jaw goes
/// hardly depends on them, and they take a third of the time.
inline ScenarioResults coarse_jaw(const std::string& file,
                                  const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  const anatomy::Mesh left = anatomy::disc(1.8, anatomy::usual_fossa());
  anatomy::Anatomy discs;
  discs.meshes = {{"disc_left.vtu", left}, {"disc_right.vtu", anatomy::mirrored(left)}};
  anatomy::write_anatomy(discs, folder.path() / "anatomy");
  sim::Scenario scenario = shipped_scenario("mandible/" + file, overrides);
  for (sim::Body& body : scenario.bodies)
    if (auto* mesh = std::get_if<sim::MeshFile>(&body.geometry);
        mesh != nullptr && body.name.starts_with("disc_"))
      mesh->path = folder.path() / "anatomy" / mesh->path.filename();
  return run_scenario(scenario);
}

}  // namespace articular
