#include "tools/study/population_file.hpp"

#include <algorithm>

#include "sim/base/error.hpp"
#include "tools/study/braces.hpp"
#include "tools/study/number_with_unit.hpp"
#include "tools/study/parameter_path.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;
namespace form = sim::form;
using sim::KeyTable;
using sim::Node;
using sim::TableReader;
using Kind = Distribution::Kind;

constexpr int kMostSamples = 10000, kMostSeed = 1000000000;
constexpr sim::Range kCorrelation{-1, 1, true, "must lie between -1 and 1, without these"};
// Less of a distribution than this lies in the tails, where its shape is a guess.
constexpr double kLeastKept = 1e-6;

std::vector<fs::path> folders_in(const Node& node, const fs::path& folder) {
  const fs::path all = folder / sim::read_text(node);
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(all, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_directory(error)) found.push_back(entry->path());
  if (error) sim::fail(node, fmt::format("{} can't be read: {}", all.string(), error.message()));
  if (found.empty())
    sim::fail(node, fmt::format("{} has no folders; expected one for each anatomy", all.string()));
  std::sort(found.begin(), found.end());
  return found;
}

/// Of a uniform distribution its ends, of others mean and spread.
const char* unit_key(Kind kind) { return kind == Kind::Uniform ? "lowest" : "mean"; }

Distribution read_distribution(const TableReader& table, const std::string& unit) {
  Distribution d;
  table.read("distribution", d.kind);
  const auto read = [&](const Node& n) { return in_unit(n, unit, unit_key(d.kind)); };
  table.read("lowest", d.lowest, read);
  table.read("highest", d.highest, read);
  if (d.kind == Kind::Uniform) {
    table.refuse({"mean", "sd"}, "a uniform distribution has `lowest` and `highest`");
    table.at("highest");
  } else {
    d.mean = read(table.at("mean"));
    d.sd = read(table.at("sd"));
    if (!(d.sd > 0))
      sim::fail(table.at("sd"), "must be positive, found " + sim::found(table.at("sd")));
    if (d.kind == Kind::Lognormal && !(d.mean > 0))
      sim::fail(table.at("mean"), "the mean of a lognormal distribution is positive, found " +
                                      sim::found(table.at("mean")));
  }
  if (!(d.lowest < d.highest)) sim::fail(table.at("highest"), "must be larger than `lowest`");
  if (!(kept_share(d) > kLeastKept))
    sim::fail(table.node(),
              "nearly nothing of the distribution lies between `lowest` and "
              "`highest`; expected them about the mean");
  return d;
}

PopulationParameter read_parameter(const Node& node) {
  const TableReader table(node, population_parameter_keys(), "[[parameter]]");
  PopulationParameter parameter;
  parameter.name = sim::read_text(table.at("name"));
  if (!is_parameter_name(parameter.name))
    sim::fail(table.at("name"), "expected a name of letters, digits and _, such as `thickness`");
  table.read("path", parameter.path);
  const auto kind = table.get<Kind>("distribution");
  parameter.unit = read_with_unit(table.at(unit_key(kind))).unit;
  parameter.distribution = read_distribution(table, parameter.unit);
  return parameter;
}

Eigen::Index number_of(const Node& node, const Population& population) {
  const std::string name = sim::read_text(node);
  std::vector<std::string> names;
  for (const PopulationParameter& parameter : population.parameters)
    names.push_back(parameter.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    sim::fail(node, fmt::format("no [[parameter]] `{}`{}", name, sim::suggestion(name, names)));
  return found - names.begin();
}

void read_correlation(const Node& node, Population& population) {
  const TableReader table(node, population_correlation_keys(), "[[correlation]]");
  const Node::List& of = sim::read_list(table.at("of"), "a list of two parameters", 2);
  const Eigen::Index a = number_of(of[0], population), b = number_of(of[1], population);
  if (a == b) sim::fail(table.at("of"), "expected two different parameters");
  if (population.correlation(a, b) != 0)
    sim::fail(node, "a second correlation of these two parameters");
  const double value =
      sim::read_real(table.at("value"), population_correlation_keys().find("value")->type);
  population.correlation(a, b) = population.correlation(b, a) = value;
}

void check_what_is_asked(const Node& node, const Population& p) {
  const bool correlated = !p.correlation.isIdentity(0);
  if (p.parameters.empty() && p.anatomies.empty())
    sim::fail(node, "nothing varies; expected [[parameter]] tables or `anatomies`");
  if (p.samples == 0 && p.index_rows == 0 && !p.tornado && p.anatomies.empty())
    sim::fail(node, "nothing is asked; expected `samples`, `tornado` or `index_rows`");
  if (p.parameters.empty() && (p.tornado || p.index_rows > 0 || p.samples > 0))
    sim::fail(node,
              "`samples`, `tornado` and `index_rows` are about parameters; expected "
              "[[parameter]] tables");
  if (!p.anatomies.empty() && (p.tornado || p.index_rows > 0))
    sim::fail(node,
              "`tornado` and `index_rows` change one number at a time; expected no "
              "`anatomies` beside them");
  if (!p.anatomies.empty() && !p.parameters.empty() && p.samples == 0)
    sim::fail(node, "parameters are drawn for `samples`, and there are none");
  if (correlated && p.index_rows > 0)
    sim::fail(node,
              "Sobol indices share out the variance among independent parameters; expected "
              "no [[correlation]] beside `index_rows`");
}

}  // namespace

const KeyTable& population_keys() {
  static const KeyTable kTable{
      "[population] of a study",
      {{"samples", {form::Integer{1, kMostSamples}}, sim::kNone, "cases drawn at random"},
       {"design",
        {form::Choice{{{"latin-hypercube", Design::LatinHypercube},
                       {"sobol", Design::Sobol},
                       {"random", Design::Random}}}},
        sim::standard("latin-hypercube"),
        "how they are drawn"},
       {"seed", {form::Integer{0, kMostSeed}}, sim::standard(1.0), "another one draws others"},
       {"tornado",
        {form::Boolean{}},
        sim::standard(false),
        "each parameter alone at its 5 % and 95 % quantile, the others at their medians"},
       {"index_rows",
        {form::Integer{2, kMostSamples}},
        sim::kNone,
        "rows of Sobol indices, of (parameters + 2) cases each"},
       {"anatomies",
        {form::Text{"path"}},
        sim::kNone,
        "a folder of folders, from that of the study; `${ARTICULAR_ANATOMY}` is each of them"},
       {"picture",
        {sim::list_of({form::Text{"text"}})},
        sim::otherwise("no pictures"),
        "arguments of `articular render` for the cases with the least and the largest value"}}};
  return kTable;
}

const KeyTable& population_parameter_keys() {
  static const KeyTable kTable{
      "[[parameter]] of a study",
      {{"name", {form::Text{"name"}}, sim::kRequired, "letters, digits and `_`"},
       {"path",
        {form::Text{"path of a value"}},
        sim::otherwise("or `{name}` in `set`, `prepare` or `command`"),
        "the value that it is"},
       {"distribution",
        {form::Choice{{{"uniform", Kind::Uniform},
                       {"normal", Kind::Normal},
                       {"lognormal", Kind::Lognormal}}}},
        sim::kRequired,
        "how it is spread"},
       {"mean", number_with_unit(), sim::otherwise("required, but of `uniform`"), "of the values"},
       {"sd", number_with_unit(), sim::otherwise("required, but of `uniform`"),
        "standard deviation of the values"},
       {"lowest", number_with_unit(), sim::otherwise("required of `uniform`"),
        "nothing below is drawn"},
       {"highest", number_with_unit(), sim::otherwise("required of `uniform`"),
        "nothing above is drawn"}}};
  return kTable;
}

const KeyTable& population_correlation_keys() {
  static const KeyTable kTable{
      "[[correlation]] of a study",
      {{"of",
        {sim::list_of({form::Text{"name of a parameter"}})},
        sim::kRequired,
        "two parameters"},
       {"value",
        {form::Number{kCorrelation}},
        sim::kRequired,
        "of the normal numbers that stand behind them (Gaussian copula)"}}};
  return kTable;
}

Population read_population(const TableReader& document, const fs::path& folder) {
  const TableReader table(document.at("population"), population_keys(), "[population]");
  Population population;
  table.read("samples", population.samples);
  table.read("design", population.design);
  population.seed = static_cast<std::uint64_t>(table.get<int>("seed"));
  table.read("tornado", population.tornado);
  table.read("index_rows", population.index_rows);
  if (const Node* node = table.find("anatomies")) population.anatomies = folders_in(*node, folder);
  if (const Node* node = table.find("picture"))
    for (const Node& word : sim::read_list(*node, "a list of texts"))
      population.picture.push_back(sim::read_text(word));
  for (const Node& node : sim::entries(document, "parameter")) {
    PopulationParameter parameter = read_parameter(node);
    for (const PopulationParameter& other : population.parameters)
      if (other.name == parameter.name)
        sim::fail(node, fmt::format("a second parameter is called `{}`", parameter.name));
    check_new_path(node.where, parameter.path, population.parameters);
    population.parameters.push_back(std::move(parameter));
  }
  const auto count = static_cast<Eigen::Index>(population.parameters.size());
  population.correlation = Eigen::MatrixXd::Identity(count, count);
  for (const Node& node : sim::entries(document, "correlation")) read_correlation(node, population);
  if (!is_positive_definite(population.correlation))
    sim::fail(document.at("correlation"),
              "no numbers have all these correlations; expected smaller ones");
  check_what_is_asked(document.at("population"), population);
  return population;
}

}  // namespace articular::tools
