#include "tools/verify/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/run/run.hpp"
#include "tools/study/study_values.hpp"

namespace articular::tools {
namespace {

sim::Scenario written_and_read(const Laboratory& laboratory, const Scene& scene) {
  const std::filesystem::path file = laboratory.folder / (scene.name + ".toml");
  sim::write_text_file(file, scene.text, sim::Durable::Later);
  sim::Scenario scenario = sim::read_scenario(file, scene.overrides);
  scenario.threads = scene.threads;
  return scenario;
}

}  // namespace

Scene shipped_scene(const std::string& name, std::vector<std::string> overrides) {
  return {name, embedded_scenario(name), std::move(overrides)};
}

Curves::Curves(const std::filesystem::path& results) {
  RunHistory history = read_history(results / "history.csv");
  names_ = std::move(history.names);
  columns_ = std::move(history.columns);
}

const std::vector<double>& Curves::operator()(const std::string& column) const {
  const auto name = std::find(names_.begin(), names_.end(), column);
  if (name == names_.end()) throw std::out_of_range("history.csv has no column " + column);
  return columns_[static_cast<std::size_t>(name - names_.begin())];
}

double Curves::at(const std::string& column, double t) const {
  const std::vector<double>&times = time(), &values = (*this)(column);
  const auto i =
      static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t) - times.begin());
  if (i == 0) return values.front();
  if (i == times.size()) return values.back();
  const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - share) * values[i - 1] + share * values[i];
}

std::vector<double> Curves::upward_crossings(const std::string& column, double level) const {
  const std::vector<double>&times = time(), &values = (*this)(column);
  std::vector<double> crossings;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i - 1] < level && values[i] >= level)
      crossings.push_back(times[i - 1] + (times[i] - times[i - 1]) * (level - values[i - 1]) /
                                             (values[i] - values[i - 1]));
  return crossings;
}

sim::Model model_of(const Laboratory& laboratory, const Scene& scene) {
  return sim::build_model(written_and_read(laboratory, scene));
}

bool run_scene(const Laboratory& laboratory, const Scene& scene, const std::string& results,
               bool resume, const AfterStep& after_step) {
  const sim::Scenario scenario = written_and_read(laboratory, scene);
  const sim::Model model = sim::build_model(scenario);
  sim::RunOptions options;
  options.directory = laboratory.folder / results;
  options.resume = resume;
  options.is_to_stop = laboratory.is_to_stop;
  options.after_iteration = [&](double, const sim::NewtonIteration&) {
    return laboratory.is_to_stop();
  };
  options.after_step = [&](const sim::State& state, double) {
    return laboratory.is_to_stop() || (after_step && after_step(model, state));
  };
  const sim::RunOutcome outcome = sim::run(scenario, model, options);
  if (laboratory.is_to_stop()) throw sim::Interruption();
  return outcome == sim::RunOutcome::Finished;
}

Curves run_scene(const Laboratory& laboratory, const Scene& scene, const AfterStep& after_step) {
  const std::string results = scene.name + "-results";
  if (!run_scene(laboratory, scene, results, false, after_step))
    throw std::logic_error(scene.name + " did not come to its end");
  Curves curves(laboratory.folder / results);
  std::filesystem::remove_all(laboratory.folder / results);  // others may follow with its name
  return curves;
}

}  // namespace articular::tools
