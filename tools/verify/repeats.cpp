#include "tools/verify/repeats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/base/file_bytes.hpp"
#include "tools/verify/scene.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

/// How many result files two runs have in common, bit for bit. Of all: history and frames.
Finding same_files(const std::string& quantity, const fs::path& one, const fs::path& other) {
  int files = 0, same = 0;
  const auto compare = [&](const fs::path& file) {
    const std::string bytes = sim::file_bytes(file);
    ++files;
    if (!bytes.empty() && bytes == sim::file_bytes(other / fs::relative(file, one))) ++same;
  };
  compare(one / "history.csv");
  for (const fs::directory_entry& frame : fs::directory_iterator(one / "frames"))
    compare(frame.path());
  return {quantity,
          "files",
          static_cast<double>(files),
          static_cast<double>(same),
          static_cast<double>(files),
          0};
}

/// scenarios/verification/many_parts.toml, stopped between two checkpoints (at 20 and 40 ms) as by
/// Ctrl-C, and resumed.
std::vector<Finding> resume(const Laboratory& laboratory) {
  const Scene scene = shipped_scene("many_parts", {});
  run_scene(laboratory, scene, "whole", false, {});
  const bool finished =
      run_scene(laboratory, scene, "parts", false,
                [](const sim::Model&, const sim::State& state) { return state.t > 0.0275; });
  if (finished) throw std::logic_error("the run was not interrupted");
  const double time = 1e3 * Curves(laboratory.folder / "parts").time().back();
  run_scene(laboratory, scene, "parts", true, {});
  return {same_files("the same as an uninterrupted run", laboratory.folder / "whole",
                     laboratory.folder / "parts"),
          relative("time when it was interrupted", "ms", 28, time, 0.05)};  // steps of 0.5 ms
}

/// On 2 and 5 threads as on one.
std::vector<Finding> on_threads(const Laboratory& laboratory, Scene scene) {
  const auto results = [](int threads) { return fmt::format("on-{}", threads); };
  for (const int threads : {1, 2, 5}) {
    scene.threads = threads;
    run_scene(laboratory, scene, results(threads), false, {});
  }
  std::vector<Finding> findings;
  for (const int threads : {2, 5})
    findings.push_back(same_files(fmt::format("the same on {} threads as on one", threads),
                                  laboratory.folder / results(1),
                                  laboratory.folder / results(threads)));
  return findings;
}

/// With a block of 8640 elements: from 8192 on the loops of a tissue are shared out.
std::vector<Finding> many_parts_on_threads(const Laboratory& laboratory) {
  return on_threads(laboratory,
                    shipped_scene("many_parts", {"body.block.geometry.box.cells=[12, 12, 10]",
                                                 "duration=6 ms", "output.interval=3 ms"}));
}

/// 12288 elements, and multigrid, whose sums are shared out too.
std::vector<Finding> multigrid_on_threads(const Laboratory& laboratory) {
  return on_threads(laboratory,
                    shipped_scene("tool_on_tissue",
                                  {"integrator.solver=multigrid", "duration=0.1 s",
                                   "integrator.step=10 ms", "body.layer.material.element=plain"}));
}

}  // namespace

std::vector<Problem> repeat_problems() {
  return {{"resume/many-parts", true, resume},
          {"threads/many-parts", false, many_parts_on_threads},
          {"threads/multigrid", false, multigrid_on_threads}};
}

}  // namespace articular::tools
