#include "tools/study/population_cases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/sampling/design.hpp"
#include "tools/study/braces.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

class Collector {
 public:
  explicit Collector(const Study& study) : study_(study), population_(*study.population) {
    for (const PopulationParameter& parameter : population_.parameters) {
      names_.push_back(parameter.name);
      distributions_.push_back(parameter.distribution);
    }
  }

  /// Values of the parameters at points of the unit cube.
  Eigen::MatrixXd values_of(const Eigen::MatrixXd& points, bool correlated) const {
    const auto count = static_cast<Eigen::Index>(names_.size());
    return values_at(
        points, distributions_,
        correlated ? population_.correlation : Eigen::MatrixXd::Identity(count, count));
  }

  void add(const std::string& name, const Eigen::VectorXd& values, const fs::path& anatomy = {}) {
    StudyCase c{name, "", study_.settings};
    for (std::string& text : c.settings.overrides) text = with_numbers(text, names_, values);
    for (std::string& text : c.settings.prepare) text = with_numbers(text, names_, values);
    c.command = study_.command;
    for (std::string& text : c.command) text = with_numbers(text, names_, values);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const PopulationParameter& parameter = population_.parameters[i];
      const double value = values[static_cast<Eigen::Index>(i)];
      if (parameter.path.empty()) continue;
      c.settings.overrides.push_back(
          parameter.unit.empty()
              ? fmt::format("{}={}", parameter.path, value)
              : fmt::format("{}=\"{} {}\"", parameter.path, value, parameter.unit));
    }
    if (!anatomy.empty())
      c.environment.push_back(std::string(kAnatomy) + "=" + fs::absolute(anatomy).string());
    c.prepares_alone = true;
    cases_.push_back(std::move(c));
    columns_.push_back(values);
  }

  std::size_t size() const { return cases_.size(); }
  const std::vector<std::string>& names() const { return names_; }

  void move_into(PopulationCases& result) {
    name_folders(cases_);
    result.cases = std::move(cases_);
    result.values.resize(static_cast<Eigen::Index>(names_.size()),
                         static_cast<Eigen::Index>(columns_.size()));
    for (std::size_t i = 0; i < columns_.size(); ++i)
      result.values.col(static_cast<Eigen::Index>(i)) = columns_[i];
  }

 private:
  const Study& study_;
  const Population& population_;
  std::vector<std::string> names_;
  std::vector<Distribution> distributions_;
  std::vector<StudyCase> cases_;
  std::vector<Eigen::VectorXd> columns_;
};

/// Enough digits for all of them, so that names sort as numbers do.
std::string numbered(int number, int count) {
  return fmt::format("{:0{}}", number, std::max<std::size_t>(3, std::to_string(count).size()));
}

void add_samples(const Population& population, Collector& collector) {
  const std::vector<fs::path>& anatomies = population.anatomies;
  if (population.parameters.empty()) {
    for (const fs::path& anatomy : anatomies)
      collector.add("anatomy " + anatomy.filename().string(), Eigen::VectorXd(0), anatomy);
    return;
  }
  const Eigen::MatrixXd values = collector.values_of(
      unit_points(population.design, static_cast<int>(population.parameters.size()),
                  population.samples, population.seed),
      true);
  for (int i = 0; i < population.samples; ++i) {
    std::string name = "sample " + numbered(i + 1, population.samples);
    // In turn: each anatomy has as many samples as any other, but for one.
    const fs::path anatomy =
        anatomies.empty() ? fs::path() : anatomies[static_cast<std::size_t>(i) % anatomies.size()];
    if (!anatomy.empty()) name += ", " + anatomy.filename().string();
    collector.add(name, values.col(i), anatomy);
  }
}

/// Where the others stay, no correlation draws them along.
void add_tornado(Collector& collector) {
  const auto count = static_cast<Eigen::Index>(collector.names().size());
  Eigen::MatrixXd points = Eigen::MatrixXd::Constant(count, 1 + 2 * count, 0.5);
  for (Eigen::Index d = 0; d < count; ++d) {
    points(d, 1 + 2 * d) = kTornadoLow;
    points(d, 2 + 2 * d) = kTornadoHigh;
  }
  const Eigen::MatrixXd values = collector.values_of(points, false);
  collector.add("all medians", values.col(0));
  for (Eigen::Index d = 0; d < count; ++d) {
    const std::string& name = collector.names()[static_cast<std::size_t>(d)];
    collector.add(name + " low", values.col(1 + 2 * d));
    collector.add(name + " high", values.col(2 + 2 * d));
  }
}

void add_rows(const Population& population, Collector& collector) {
  const int count = static_cast<int>(collector.names().size()), width = count + 2;
  const Eigen::MatrixXd values =
      collector.values_of(saltelli_points(count, population.index_rows, population.seed), false);
  for (int row = 0; row < population.index_rows; ++row)
    for (int i = 0; i < width; ++i) {
      const std::string what = i == 0   ? "A"
                               : i == 1 ? "B"
                                        : collector.names()[static_cast<std::size_t>(i - 2)];
      collector.add("row " + numbered(row + 1, population.index_rows) + " " + what,
                    values.col(row * width + i));
    }
}

}  // namespace

PopulationCases population_cases(const Study& study) {
  const Population& population = *study.population;
  Collector collector(study);
  PopulationCases result;
  if (population.samples > 0 || !population.anatomies.empty()) add_samples(population, collector);
  result.num_samples = collector.size();
  if (population.tornado) add_tornado(collector);
  result.num_tornado = collector.size() - result.num_samples;
  if (population.index_rows > 0) add_rows(population, collector);
  collector.move_into(result);
  return result;
}

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

}  // namespace articular::tools
