#include "sim/output/summary.hpp"

#include <sundials/sundials_version.h>
#include <sys/resource.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "sim/assembly/solver_setup.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/output/results_folder.hpp"
#include "sim/output/run_warnings.hpp"

namespace articular::sim {
namespace {

using Json = nlohmann::ordered_json;

Json sizes(const Model& model) {
  std::int64_t elements = 0, collision_elements = 0;
  std::size_t sheets = 0;
  for (const Tissue& tissue : model.tissues) {
    elements += tissue.elements.num_elements();
    sheets += tissue.sheets.size();
  }
  for (const BodyModel& body : model.bodies)
    if (body.collider) collision_elements += body.collider->tets.cols();
  return {{"bodies", model.bodies.size()},
          {"tetrahedra", elements},
          {"collision_tetrahedra", collision_elements},
          {"free_tissue_nodes", model.layout.num_free_nodes},
          {"rigid_bones", model.layout.num_rigid},
          {"unknown_velocities", 3 * model.layout.num_unknown_blocks()},
          {"muscles", model.muscles.size()},
          {"sheets", sheets},
          {"ligaments", model.ligaments.size()},
          {"boluses", model.boluses.size()},
          {"contact_pairs", model.contacts.size()}};
}

Json chosen_solver(const Model& model, Integrator::Scheme scheme) {
  if (!needs_linear_solver(model, scheme)) return nullptr;
  const fem::SolverChoice& choice = model.linear_solver;
  return {{"name", sim::name_of(choice.kind)}, {"reason", choice.reason}};
}

Json counts(const Counts& c) {
  return {{"sundials_steps", c.steps},
          {"rejected_newton", c.rejected_newton},
          {"rejected_motion", c.rejected_motion},
          {"newton_iterations", c.newton_iterations},
          {"factorizations", c.factorizations},
          {"projected_tangents", c.projected_tangents},
          {"linear_solves", c.linear_solves},
          {"linear_iterations", c.linear_iterations},
          {"force_evaluations", c.force_evaluations},
          {"tree_updates", c.tree_updates},
          {"narrow_tests", c.narrow_tests},
          {"reported_pairs", c.reported_pairs},
          {"deep_pairs", c.deep_pairs}};
}

Json evaluations(const EvaluationCounts& counts) {
  Json json;
  for (std::size_t i = 0; i < kNumTerms; ++i) {
    const auto term = static_cast<Term>(i);
    json[std::string(name_of(term))] = counts[term];
  }
  return json;
}

Json overlap_resolution(const Model& model, const OverlapResolution& resolution) {
  if (resolution.overlaps.empty()) return nullptr;
  Json overlaps = Json::array();
  for (const ResolvedOverlap& overlap : resolution.overlaps) {
    const ContactModel contact = model.contacts[overlap.contact];
    overlaps.push_back({{"bodies",
                         {model.bodies[static_cast<std::size_t>(contact.a)].name,
                          model.bodies[static_cast<std::size_t>(contact.b)].name}},
                        {"before_m", overlap.before},
                        {"after_m", overlap.after}});
  }
  return {{"overlaps", overlaps},
          {"solutions", resolution.solutions},
          {"newton_iterations", resolution.iterations},
          {"largest_motion_m", resolution.largest_motion}};
}

Json input_files(const std::vector<InputFile>& inputs) {
  Json files = Json::array();
  for (const InputFile& file : inputs)
    files.push_back({{"file", file.name}, {"bytes", file.bytes}, {"fnv1a_64", file.hash}});
  return files;
}

Json energy(const State& state, const StoredEnergy& now) {
  const EnergyLedger& l = state.energy;
  return {{"unit", "J"},
          {"start", l.start},
          {"muscle_work", l.muscle_work},
          {"load_work", l.load_work},
          {"motion_work", l.motion_work},
          {"ligament_loss", l.ligament_loss},
          {"bolus_loss", l.bolus_loss},
          {"tissue_loss", l.tissue_loss},
          {"contact_loss", l.contact_loss},
          {"settling_loss", l.settling_loss},
          {"numerical_loss", numerical_loss(state, now)},
          {"end",
           {{"kinetic", now.kinetic},
            {"elastic", now.elastic},
            {"gravity", now.gravity},
            {"contact", now.contact},
            {"lines", now.lines},
            {"total", now.total()}}}};
}

}  // namespace

std::string summary_json(const Scenario& scenario, const Model& model, const State& state,
                         const Stepper& stepper, const PhaseTimes& phases, const WallTimes& wall,
                         const std::vector<InputFile>& inputs,
                         const std::vector<std::string>& warnings, const std::string& outcome) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const Provenance by = provenance();
  std::vector<std::string> all_warnings = model.warnings;
  all_warnings.insert(all_warnings.end(), warnings.begin(), warnings.end());
  Json json = {
      {"outcome", outcome},
      {"scenario", scenario.file.filename().string()},
      {"scenario_folder", folder_of(scenario.file)},
      {"simulated_time_s", state.t},
      {"settings", Json::parse(scenario.settings_json)},
      {"size", sizes(model)},
      {"linear_solver", chosen_solver(model, scenario.integrator.scheme)},
      {"threads", scenario.threads},
      {"counts", counts(state.counts)},
      {"overlap_resolution", overlap_resolution(model, state.overlap_resolution)},
      {"frames", state.frames},
      {"max_penetration_m", state.max_penetration},
      {"energy", energy(state, stepper.stored_energy())},
      {"wall_time_s",
       {{"total", wall.total},
        {"overlap_resolution", wall.overlap_resolution},
        {"collision_update", phases.collision_update},
        {"collision_traversal", phases.collision_traversal},
        {"collision_narrow", phases.collision_narrow},
        {"crossings", phases.crossings},
        {"elastic_force", phases.elastic_force},
        {"contact_force", phases.contact_force},
        {"assembly", phases.assembly},
        {"solve", phases.solve},
        {"output", wall.output}}},
      {"evaluations", evaluations(state.counts.evaluations)},
      {"peak_memory_MB", static_cast<double>(usage.ru_maxrss) / 1024},
      {"warnings", all_warnings},
      {"notes", run_notes(model, state, stepper)},
      {"inputs", fingerprint(scenario, model)},
      {"input_files", input_files(inputs)},
      {"processor",
       {{"instruction_set", by.instruction_set},
        {"blas_kernels", by.blas_kernels},
        {"reproducible", scenario.reproducible}}},
      {"build", {{"compiler", by.compiler}, {"flags", by.flags}}},
      {"versions",
       {{"articular", by.version},
        {"OpenBLAS", by.blas_version},
        {"CHOLMOD", by.cholmod_version},
        {"glibc", by.libc_version},
        {"SUNDIALS", SUNDIALS_VERSION},
        {"Eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                      "." + std::to_string(EIGEN_MINOR_VERSION)}}}};
  return json.dump(2) + "\n";
}

}  // namespace articular::sim
