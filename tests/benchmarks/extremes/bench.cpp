#include "tests/benchmarks/extremes/bench.hpp"

#include <fstream>
#include <sstream>

#include "sim/build/build_model.hpp"
#include "sim/output/checkpoint.hpp"
#include "sim/output/fingerprint.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/step/run_extrema.hpp"
#include "sim/step/stepper.hpp"
#include "tools/process/measured_program.hpp"

namespace articular::benchmarks {
namespace {

namespace fs = std::filesystem;

/// The line that says why a run could not go on, which details may follow, or else the last one.
std::string told(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line)) {
    if (!line.empty()) last = line;
    if (line.find("the simulation cannot go on") != std::string::npos) break;
  }
  return last;
}

}  // namespace

Bench::Bench(fs::path program, fs::path folder)
    : program_(std::move(program)), folder_(std::move(folder)) {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
}

ProgramRun Bench::start(const std::vector<std::string>& arguments, const std::string& name,
                        double limit) const {
  std::vector<std::string> command = {
      program_.string(), "run",          (folder_ / (name + ".toml")).string(),
      "--out",           folder_ / name, "--quiet"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const fs::path log = folder_ / (name + ".log");
  const tools::ProgramUse use = tools::run_measured(command, {}, log, limit, [] { return false; });
  return {.exit_code = use.end == tools::ProgramUse::End::Exited ? use.code : -1,
          .timed_out = use.end == tools::ProgramUse::End::TimeLimit,
          .seconds = use.wall_seconds,
          .message = told(log),
          .results = folder_ / name};
}

ProgramRun Bench::run(const std::string& name, const std::string& scenario, double limit) const {
  std::ofstream(folder_ / (name + ".toml")) << scenario;
  return start({}, name, limit);
}

ProgramRun Bench::run_from(
    const std::string& name, const std::string& scenario, double limit,
    const std::function<void(const sim::Model&, sim::State&)>& change) const {
  const fs::path file = folder_ / (name + ".toml");
  std::ofstream(file) << scenario;
  const sim::Scenario given = sim::read_scenario(file);
  const sim::Model model = sim::build_model(given);
  sim::Stepper stepper(model, sim::step_settings(given));
  sim::State state = stepper.initial();
  change(model, state);
  stepper.restart(state);
  state.energy.start = stepper.stored_energy().total();
  sim::note_extrema(stepper.now(), state);
  fs::create_directories(folder_ / name);
  sim::write_checkpoint(folder_ / name / "checkpoint", {state, {}, {}, {}},
                        sim::fingerprint(given, model));
  return start({"--resume"}, name, limit);
}

}  // namespace articular::benchmarks
