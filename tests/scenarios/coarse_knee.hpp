#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/scenarios/scenario_results.hpp"
#include "tools/anatomy/anatomy.hpp"
#include "tools/anatomy/anatomy_knee.hpp"
#include "tools/anatomy/anatomy_ligaments.hpp"
#include "tools/anatomy/anatomy_meniscus.hpp"

namespace articular::knee_test {

/// The files of meshes that a scenario reads.
inline std::vector<std::filesystem::path*> mesh_files(sim::Scenario& scenario) {
  std::vector<std::filesystem::path*> files;
  for (sim::Body& body : scenario.bodies) {
    if (auto* mesh = std::get_if<sim::MeshFile>(&body.geometry)) files.push_back(&mesh->path);
    for (sim::MeshFile& file : body.contact_meshes) files.push_back(&file.path);
  }
  return files;
}

/// Runs a scenario with the meshes of an anatomy in place of the shipped ones of the same names.
inline ScenarioResults run_with(const anatomy::Anatomy& anatomy, sim::Scenario scenario) {
  const TemporaryFolder folder;
  anatomy::write_anatomy(anatomy, folder.path() / "anatomy");
  for (std::filesystem::path* file : mesh_files(scenario))
    if (anatomy.meshes.contains(file->filename()))
      *file = folder.path() / "anatomy" / file->filename();
  return run_scenario(scenario);
}

/// With elements of 4 mm; none of bones, whose files do not depend on that.
inline std::optional<anatomy::Mesh> coarse_tissue(const std::string& file) {
  constexpr anatomy::KneeResolution kCoarse{4, 2};
  const anatomy::Compartment &medial = anatomy::medial_compartment(),
                             &lateral = anatomy::lateral_compartment();
  for (const anatomy::Compartment* c : {&medial, &lateral}) {
    const std::string ending = c == &medial ? "_medial.vtu" : "_lateral.vtu";
    if (file == "femoral_cartilage" + ending) return femoral_cartilage(*c, kCoarse);
    if (file == "femoral_cartilage_back" + ending) return femoral_cartilage_back(*c, kCoarse);
    if (file == "tibial_cartilage" + ending) return tibial_cartilage(*c, kCoarse);
    if (file == "meniscus" + ending) return meniscus(*c, kCoarse);
  }
  for (const anatomy::FibreBody& ligament :
       {anatomy::medial_collateral(), anatomy::anterior_cruciate()})
    if (file == ligament.name + ".vtu")
      return ligament_mesh(ligament, medial, lateral, kCoarse.size_mm);
  return {};
}

/// A scenario of scenarios/knee/ with coarse tissue.
inline ScenarioResults coarse_knee(const std::string& file,
                                   const std::vector<std::string>& overrides) {
  sim::Scenario scenario = shipped_scenario("knee/" + file, overrides);
  anatomy::Anatomy coarse;
  for (const std::filesystem::path* mesh : mesh_files(scenario))
    if (const auto made = coarse_tissue(mesh->filename())) coarse.meshes[mesh->filename()] = *made;
  return run_with(coarse, scenario);
}

}  // namespace articular::knee_test
