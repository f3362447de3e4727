#pragma once

#include <string>
#include <variant>
#include <vector>

#include "tests/scenarios/scenario_results.hpp"
#include "tools/anatomy/anatomy.hpp"
#include "tools/anatomy/anatomy_joint.hpp"

namespace articular {

/// Discs without fibres must not lock: of a compressible law.
inline std::string plain_disc(const std::string& side) {
  return "body.disc_" + side +
         R"(.material={ law = "neo-hookean", young_modulus = "5.4 MPa", poisson_ratio = 0.4, )"
         R"(element = "plain", stiffness_damping = "5 ms" })";
}

/// Runs a scenario of scenarios/mandible/ with discs of 1.8 mm in place of 1.2 mm, of plain
/// elements and without fibres: where a jaw goes hardly depends on them. Without the latter two a
/// chew takes three times as long.
inline ScenarioResults coarse_jaw(const std::string& file,
                                  const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  const anatomy::Mesh left = anatomy::disc(1.8, anatomy::usual_fossa());
  anatomy::Anatomy discs;
  discs.meshes = {{"disc_left.vtu", left}, {"disc_right.vtu", anatomy::mirrored(left)}};
  anatomy::write_anatomy(discs, folder.path() / "anatomy");
  std::vector<std::string> settings = {plain_disc("left"), plain_disc("right")};
  settings.insert(settings.end(), overrides.begin(), overrides.end());
  sim::Scenario scenario = shipped_scenario("mandible/" + file, settings);
  for (sim::Body& body : scenario.bodies)
    if (auto* mesh = std::get_if<sim::MeshFile>(&body.geometry);
        mesh != nullptr && body.name.starts_with("disc_"))
      mesh->path = folder.path() / "anatomy" / mesh->path.filename();
  return run_scenario(scenario);
}

}  // namespace articular
