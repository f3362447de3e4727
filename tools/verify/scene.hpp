#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/model/model.hpp"
#include "sim/model/state.hpp"
#include "tools/verify/problem.hpp"

/// Scenes that this program holds in itself.
namespace articular::tools {

/// The text of scenarios/verification/NAME.toml, which the build puts into the program.
/// @throws std::invalid_argument  where the build took none of that name
const std::string& embedded_scenario(const std::string& name);

/// A scenario with overrides, as of `run --set`.
struct Scene {
  std::string name;  // of the files
  std::string text;
  std::vector<std::string> overrides = {};
  int threads = 1;
};

/// scenarios/verification/NAME.toml
Scene shipped_scene(const std::string& name, std::vector<std::string> overrides);

/// Called after each step; true stops the run, as Ctrl-C would.
using AfterStep = std::function<bool(const sim::Model&, const sim::State&)>;

/// history.csv of a run. Empty cells are NaN.
class Curves {
 public:
  explicit Curves(const std::filesystem::path& results);

  /// A column by its name in the file, such as "end.position.z [mm]".
  /// @throws std::out_of_range  where there is none
  const std::vector<double>& operator()(const std::string& column) const;
  const std::vector<double>& time() const { return columns_.front(); }  // [s]
  double last(const std::string& column) const { return (*this)(column).back(); }
  /// Linear between the rows.
  double at(const std::string& column, double time) const;
  /// Times at which a column passes a level upwards, linear between the rows [s].
  std::vector<double> upward_crossings(const std::string& column, double level) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

/// The model of a scene, which is written into the laboratory. Meshes lie there already.
sim::Model model_of(const Laboratory& laboratory, const Scene& scene);

/// Runs a scene to its end, or until `after_step` stops it.
/// @param results  a folder of the laboratory; one that holds the same run, to go on with it
/// @return whether it came to its end
/// @throws sim::Interruption  when the laboratory asks to stop
bool run_scene(const Laboratory& laboratory, const Scene& scene, const std::string& results,
               bool resume, const AfterStep& after_step);

/// The same, from the start to the end.
Curves run_scene(const Laboratory& laboratory, const Scene& scene,
                 const AfterStep& after_step = {});

}  // namespace articular::tools
