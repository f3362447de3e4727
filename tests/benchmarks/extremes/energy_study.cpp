#include "tests/benchmarks/extremes/energy_study.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "tests/benchmarks/extremes/bench.hpp"
#include "tests/benchmarks/extremes/scene_text.hpp"
#include "tests/benchmarks/extremes/spin.hpp"
#include "tests/benchmarks/extremes/stability_limit.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::benchmarks {
namespace {

namespace fs = std::filesystem;

/// A scheme at one accuracy: a step, or, where it chooses its steps, a tolerance.
struct Setting {
  std::string scheme;
  double step = 0;       // [s]
  double tolerance = 0;  // [m]
  bool chooses() const { return scheme == "bdf" || scheme == "explicit"; }
  std::string words() const {
    return chooses() ? fmt::format("tolerance {:g} m", tolerance) : fmt::format("{:g} s", step);
  }
  std::string integrator() const {
    return fmt::format("scheme = \"{}\"\nposition_tolerance = \"{} m\"\n", scheme,
                       digits(tolerance));
  }
};

/// From coarse to fine, each by a factor of two (steps) or ten (tolerances).
std::vector<Setting> settings(const std::string& scheme, double coarsest) {
  std::vector<Setting> all;
  for (int k = 0; k < 4; ++k) {
    Setting setting{scheme, coarsest * std::pow(0.5, k), 1e-9};
    if (setting.chooses()) setting = {scheme, coarsest, 1e-5 * std::pow(0.1, k)};
    all.push_back(setting);
  }
  return all;
}

constexpr double kBeamTime = 1;  // [s]

/// A beam of soft tissue, clamped, that starts with a velocity across; it swings at some 5 Hz.
std::string beam_body(const std::string& velocity) {
  return carrier("wall") +
         box("beam", "tissue",
             {.size = {0.05, 0.005, 0.005}, .cells = {10, 1, 1}, .center = {0.025, 0, 0}},
             solid(1000, "neo-hookean", 1e5, 0.3) + velocity) +
         attach("beam", "wall", {-1, -1, -1}, {1e-6, 1, 1});
}

std::string beam(const Setting& setting) {
  return general(kBeamTime, setting.step, "", setting.integrator()) +
         beam_body("velocity = \"0 0 0.05 m/s\"\n") +
         point_probe("tip", "beam", {0.05, 0.0025, 0.0025}) + energy_probe();
}

ScenarioResults finished(const ProgramRun& run) {
  if (run.exit_code != 0) throw std::runtime_error("the study's own run failed: " + run.message);
  return ScenarioResults(run.results);
}

std::vector<double> energy_of(const ScenarioResults& results) {
  std::vector<double> sum = results.column("energy.kinetic [J]");
  const auto& elastic = results.column("energy.elastic [J]");
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += elastic[i];
  return sum;
}

void write_curve(std::ofstream& csv, const std::string& scene, const Setting& setting,
                 const std::vector<double>& t, const std::vector<double>& value) {
  constexpr double kInterval = 0.01;  // [s]
  double next = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < next - 1e-9) continue;
    next = t[i] + kInterval;
    csv << fmt::format("{},{},{:g},{:.6g},{:.6g}\n", scene, setting.scheme,
                       setting.chooses() ? setting.tolerance : setting.step, t[i], value[i]);
  }
}

/// log2 of how an error falls from one step to its half.
std::string order_of(const Setting& setting, double coarse, double fine) {
  return setting.chooses() ? "" : fmt::format("{:.2f}", std::log2(coarse / fine));
}

constexpr std::array kSchemes = {"implicit-euler", "tr-bdf2", "dirk-3", "bdf", "explicit"};

void study_beam(const Bench& bench, std::ofstream& csv) {
  constexpr double kLook = 0.1;  // [s] when the tip is compared
  const auto tip_at = [](const ScenarioResults& results) {
    return results.at("tip.position.z [m]", kLook);
  };
  const double exact = tip_at(finished(bench.run("exact", beam({"dirk-3", 2.5e-5, 1e-10}), 600)));
  fmt::print(
      "| beam, scheme | step | energy left after 1 s | largest energy | tip at 0.1 s [mm] | "
      "order |\n| --- | --- | --- | --- | --- | --- |\n");
  for (const std::string scheme : kSchemes) {
    double before = 0;
    for (const Setting& setting : settings(scheme, 2e-3)) {
      const ScenarioResults results = finished(bench.run("beam", beam(setting), 600));
      std::vector<double> energy = energy_of(results);
      const double start = energy.front();
      for (double& e : energy) e /= start;
      write_curve(csv, "beam", setting, results.column("time [s]"), energy);
      const double error = std::abs(tip_at(results) - exact);
      fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.2g} | {} |\n", scheme, setting.words(),
                 energy.back(), *std::max_element(energy.begin(), energy.end()), 1e3 * error,
                 before > 0 ? order_of(setting, before, error) : "");
      before = error;
    }
  }
}

void study_spin(const Bench& bench) {
  fmt::print(
      "\n| tumbling body, scheme | step | energy | angular momentum | order of the latter "
      "|\n| --- | --- | --- | --- | --- |\n");
  for (const std::string scheme : kSchemes) {
    double before = 0;
    for (const Setting& setting : settings(scheme, 2e-3)) {
      const SpinDrift drift = spin_drift(bench, "spin", setting.step, 1, setting.integrator());
      if (drift.run.exit_code != 0) throw std::runtime_error(drift.run.message);
      fmt::print("| {} | {} | {:+.2e} | {:.2e} | {} |\n", scheme, setting.words(), drift.energy,
                 drift.momentum, before > 0 ? order_of(setting, before, drift.momentum) : "");
      before = drift.momentum;
    }
  }
}

}  // namespace

void study_energy(const fs::path& program, const fs::path& out) {
  const Bench bench(program, out / "energy");
  std::ofstream csv(out / "energy.csv");
  csv << "scene,scheme,setting,time_s,energy_by_start\n";
  study_beam(bench, csv);
  study_spin(bench);
  // Loose tolerances: what bounds the explicit scheme's steps then is stability.
  const std::string scene = general(0.2, 1, "", Setting{"explicit", 1, 1e-2}.integrator()) +
                            beam_body("velocity = \"0 0 0.01 m/s\"\n");
  const StabilityLimit limit = find_stability_limit(bench, scene);
  fmt::print(
      "\nexplicit: mean step {:.3g} s; ω_max {:.4g} 1/s; product {:.2f} (theory: √3 = 1.73 "
      "without, up to 2.51 with damping)\n",
      limit.mean_step, limit.largest_frequency, limit.mean_step * limit.largest_frequency);
}

}  // namespace articular::benchmarks
