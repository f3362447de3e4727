// What a heap of many bodies takes: `articular check`, and the first steps of `articular run`.
//
//   build/release/bin/many_bodies [BODIES]...          (default: 1250 2500 5000 10000)
//   build/release/bin/many_bodies --scene BODIES       prints the scene, for runs of your own
//
// The scene is a heap of rigid cubes of one cell, a little out of line, that fall onto a floor and
// onto each other. Processor time and peak of memory are those of whole processes on one thread;
// "by half" is the ratio to the row above: 2 where twice the bodies take twice as much.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/benchmarks/support/measured_child.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace {

using namespace articular::benchmarks;

constexpr double kSide = 5, kGap = 0.1;  // [mm]
constexpr int kSteps = 2;                // of a millisecond

/// A cube's edge of cubes; the uppermost layer may be incomplete.
std::string scene(int bodies) {
  const int n = static_cast<int>(std::ceil(std::cbrt(bodies) - 1e-9));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-kGap / 2, kGap / 2);
  std::string text = fmt::format(R"(duration = "{0} ms"
[integrator]
step = "1 ms"
[output]
interval = "{0} ms"
[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"
[[probe]]
name = "energy"
kind = "energy"
[[body]]
name = "floor"
kind = "fixed"
geometry = {{ box = {{ size = "{1} {1} 10 mm", cells = [10, 10, 1], center = "0 0 -5 mm" }} }}
)",
                                 kSteps, 2 * n * (kSide + kGap));
  for (int i = 0; i < bodies; ++i) {
    const auto at = [&](int k) { return (kSide + kGap) * (k - 0.5 * (n - 1)) + jitter(random); };
    const double x = at(i % n), y = at(i / n % n);
    const int layer = i / n / n;
    const double z = kSide / 2 + kGap + (kSide + kGap) * layer;
    text += fmt::format(
        "[[body]]\nname = \"cube {}\"\nkind = \"rigid\"\ndensity = \"1 g/cm^3\"\n"
        "geometry = {{ box = {{ size = \"{} {} {} mm\", cells = [1, 1, 1], center = \"{:.6f} "
        "{:.6f} {:.6f} mm\" }} }}\n",
        i, kSide, kSide, kSide, x, y, z);
  }
  return text;
}

struct Row {
  int bodies = 0;
  ChildUse check, run;
};

Row measured(int bodies, const std::filesystem::path& folder) {
  std::ofstream(folder / "heap.toml") << scene(bodies);
  Row row;
  row.bodies = bodies;
  row.check = measure_program(ARTICULAR_PROGRAM, {"check", "heap.toml"}, folder.string());
  row.run = measure_program(
      ARTICULAR_PROGRAM, {"run", "heap.toml", "--out", "results", "--overwrite"}, folder.string());
  return row;
}

void print(const ChildUse& use, const ChildUse* before) {
  std::printf("  %8.2f", use.cpu_seconds);
  if (before != nullptr) std::printf(" %7.2f", use.cpu_seconds / before->cpu_seconds);
  if (before == nullptr) std::printf(" %7s", "");
  std::printf(" %8.0f", use.peak_megabytes);
  if (before != nullptr) std::printf(" %7.2f", use.peak_megabytes / before->peak_megabytes);
  if (before == nullptr) std::printf(" %7s", "");
}

int measure(const std::vector<int>& sizes) {
  const articular::TemporaryFolder folder;
  std::printf("%8s  %s   %s\n", "", "check: s  by half       MB by half",
              fmt::format("run, {} steps: s  by half  MB by half", kSteps).c_str());
  std::vector<Row> rows;
  bool all_succeeded = true;
  for (const int bodies : sizes) {
    rows.push_back(measured(bodies, folder.path()));
    const Row &row = rows.back(), *before = rows.size() > 1 ? &rows[rows.size() - 2] : nullptr;
    std::printf("%8d", row.bodies);
    print(row.check, before != nullptr ? &before->check : nullptr);
    print(row.run, before != nullptr ? &before->run : nullptr);
    const bool succeeded = row.check.succeeded && row.run.succeeded;
    std::printf("%s\n", succeeded ? "" : "  failed");
    std::fflush(stdout);
    all_succeeded = all_succeeded && succeeded;
  }
  return all_succeeded ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool only_scene = !arguments.empty() && arguments.front() == "--scene";
  if (only_scene) arguments.erase(arguments.begin());
  std::vector<int> sizes(arguments.size());
  std::transform(arguments.begin(), arguments.end(), sizes.begin(),
                 [](const std::string& argument) { return std::atoi(argument.c_str()); });
  const bool valid = std::all_of(sizes.begin(), sizes.end(), [](int n) { return n > 0; });
  if (!valid || (only_scene && sizes.size() != 1)) {
    std::fprintf(stderr, "usage: many_bodies [BODIES]..., many_bodies --scene BODIES\n");
    return 2;
  }
  try {
    if (only_scene) {
      std::printf("%s", scene(sizes.front()).c_str());
      return EXIT_SUCCESS;
    }
    return measure(sizes.empty() ? std::vector<int>{1250, 2500, 5000, 10000} : sizes);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "many_bodies: %s\n", error.what());
    return 2;
  }
}
