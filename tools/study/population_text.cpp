#include "tools/study/population_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/sampling/spread.hpp"
#include "tools/study/csv_cell.hpp"
#include "tools/study/study_report.hpp"

namespace articular::tools {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
}

std::string interval(const Estimate& e) {
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", e.value, e.low, e.high);
}

std::string unit_in_brackets(const std::string& column) {
  const std::string unit = unit_of(column);
  return unit.empty() ? "" : " [" + unit.substr(1) + "]";
}

std::string name_of(const StudyOutput& output) {
  return output.name == output.column ? output.name : output.name + unit_in_brackets(output.column);
}

const char* design_words(Design design) {
  switch (design) {
    case Design::LatinHypercube:
      return "Latin hypercube";
    case Design::Sobol:
      return "Sobol sequence";
    default:
      return "at random";
  }
}

/// "thickness = 2.3 mm, modulus = 12 MPa" of a case.
std::string values_words(const PopulationStudy& all, std::size_t i) {
  std::string text;
  const auto& parameters = all.study.population->parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    text += fmt::format(
        "{}{} = {}", p == 0 ? "" : ", ", parameters[p].name,
        with_unit(all.population.values(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(i)),
                  parameters[p].unit));
  return text.empty() ? "-" : text;
}

std::string success_text(const PopulationStudy& all) {
  const std::size_t count = all.records.size();
  std::string text =
      fmt::format("{} of {} cases succeeded ({:.4g} %).\n", all.result.succeeded, count,
                  100.0 * static_cast<double>(all.result.succeeded) / static_cast<double>(count));
  if (all.result.succeeded == count) return text;
  text += "\n| Failed | How | Message | Parameters |\n| --- | --- | --- | --- |\n";
  for (std::size_t i = 0; i < count; ++i)
    if (!all.records[i].succeeded())
      text += fmt::format("| {} | {} | {} | {} |\n", all.population.cases[i].name,
                          all.records[i].outcome(), all.records[i].message, values_words(all, i));
  return text;
}

std::string parameters_text(const PopulationStudy& all) {
  const auto& parameters = all.study.population->parameters;
  if (parameters.empty()) return "";
  std::string text =
      "\n## Parameters\n\n| Parameter | Distribution | Drawn: mean ± sd |\n| --- | --- | --- |\n";
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    std::vector<double> values;
    for (const std::size_t i : all.result.drawn)
      values.push_back(
          all.population.values(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(i)));
    text += fmt::format("| {} | {} | {} |\n", parameters[p].name, distribution_words(parameters[p]),
                        values.empty() ? "-"
                                       : number(mean_of(values)) + " ± " +
                                             with_unit(sd_of(values), parameters[p].unit));
  }
  return text;
}

std::string spread_text(const PopulationStudy& all) {
  if (all.result.drawn.empty()) return "";
  std::string text =
      "\n## Outputs\n\n| Output | Cases | Mean | Sd | 5 % | Median | 95 % | Least | Largest |\n| "
      "--- "
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (std::size_t o = 0; o < all.study.outputs.size(); ++o) {
    const PopulationOutput& output = all.result.outputs[o];
    text += fmt::format("| {} | {} |", name_of(all.study.outputs[o]), output.drawn.size());
    if (output.drawn.empty()) {
      text += " - | - | - | - | - | - | - |\n";
      continue;
    }
    text += fmt::format(" {} | {} |", number(mean_of(output.drawn)), number(sd_of(output.drawn)));
    for (const double p : {0.05, 0.5, 0.95})
      text += fmt::format(" {} |", number(quantile_of(output.drawn, p)));
    for (const auto& [i, value] : {std::pair(*output.least, quantile_of(output.drawn, 0)),
                                   std::pair(*output.largest, quantile_of(output.drawn, 1))})
      text += fmt::format(" {} ({}) |", number(value), all.population.cases[i].name);
    text += "\n";
  }
  return text;
}

/// Parameters by what they do, the one that does most first.
std::vector<std::size_t> ordered(std::size_t count,
                                 const std::function<double(std::size_t)>& size) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return size(a) > size(b);  // what has none comes where it stands
  });
  return order;
}

std::string tornado_text(const PopulationStudy& all, std::size_t o) {
  const PopulationOutput& output = all.result.outputs[o];
  if (output.bars.empty()) return "";
  const auto& parameters = all.study.population->parameters;
  std::string text = fmt::format(
      "\nWith all parameters at their medians it is {}. One alone at its 5 % and 95 % "
      "quantile:\n\n| "
      "Parameter | 5 % | Output | 95 % | Output |\n| --- | --- | --- | --- | --- |\n",
      number(output.at_medians));
  const auto swing = [&](std::size_t p) {
    const double size = std::abs(output.bars[p].high - output.bars[p].low);
    return std::isfinite(size) ? size : -1.0;
  };
  for (const std::size_t p : ordered(parameters.size(), swing))
    text += fmt::format(
        "| {} | {} | {} | {} | {} |\n", parameters[p].name,
        with_unit(quantile(parameters[p].distribution, kTornadoLow), parameters[p].unit),
        number(output.bars[p].low),
        with_unit(quantile(parameters[p].distribution, kTornadoHigh), parameters[p].unit),
        number(output.bars[p].high));
  return text;
}

std::string indices_text(const PopulationStudy& all, std::size_t o) {
  const int rows = all.study.population->index_rows;
  if (rows == 0) return "";
  const PopulationOutput& output = all.result.outputs[o];
  const auto& parameters = all.study.population->parameters;
  if (output.indices.empty())
    return fmt::format("\nNo Sobol indices: it does not vary, or failures left {} whole rows.\n",
                       output.whole_rows);
  std::string text = fmt::format(
      "\nSobol indices of {} rows of {}, with 95 % intervals: the share of the variance that comes "
      "from a parameter alone, and with all that it does together with others.\n\n| Parameter | "
      "First order | Total |\n| --- | --- | --- |\n",
      output.whole_rows, rows);
  for (const std::size_t p :
       ordered(parameters.size(), [&](std::size_t i) { return output.indices[i].total.value; }))
    text += fmt::format("| {} | {} | {} |\n", parameters[p].name, interval(output.indices[p].first),
                        interval(output.indices[p].total));
  return text;
}

std::string ranks_text(const PopulationStudy& all, std::size_t o) {
  const PopulationOutput& output = all.result.outputs[o];
  if (output.ranks.empty() || output.drawn.size() < 3) return "";
  std::string text = "\nRank correlation with ";
  for (std::size_t p = 0; p < output.ranks.size(); ++p)
    text += fmt::format(
        "{}{} {}", p == 0 ? "" : ", ", all.study.population->parameters[p].name,
        std::isfinite(output.ranks[p]) ? fmt::format("{:.2f}", output.ranks[p]) : std::string("-"));
  return text + ".\n";
}

}  // namespace

std::string duration_words(double seconds) {
  if (seconds < 60) return fmt::format("{:.3g} s", seconds);
  const int whole = static_cast<int>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string distribution_words(const PopulationParameter& parameter) {
  const Distribution& d = parameter.distribution;
  if (d.kind == Distribution::Kind::Uniform)
    return fmt::format("uniform, {:.4g} to {}", d.lowest, with_unit(d.highest, parameter.unit));
  std::string text =
      fmt::format("{}, {:.4g} ± {}", d.kind == Distribution::Kind::Normal ? "normal" : "lognormal",
                  d.mean, with_unit(d.sd, parameter.unit));
  if (std::isfinite(d.lowest)) text += ", from " + with_unit(d.lowest, parameter.unit);
  if (std::isfinite(d.highest)) text += ", up to " + with_unit(d.highest, parameter.unit);
  return text;
}

std::string population_words(const PopulationStudy& all) {
  const Population& population = *all.study.population;
  std::vector<std::string> parts;
  if (!population.anatomies.empty())
    parts.push_back(fmt::format("{} anatomies", population.anatomies.size()));
  if (population.samples > 0)
    parts.push_back(fmt::format("{} samples ({}, seed {})", population.samples,
                                design_words(population.design), population.seed));
  if (population.tornado)
    parts.push_back(fmt::format("{} of a tornado", all.population.num_tornado));
  if (population.index_rows > 0)
    parts.push_back(fmt::format("{} rows of Sobol indices with {} each", population.index_rows,
                                population.parameters.size() + 2));
  double cpu = 0;
  for (const CaseRecord& record : all.records) cpu += record.cpu();
  return fmt::format("{} cases: {}. They took {} of processor time together.", all.records.size(),
                     fmt::join(parts, ", "), duration_words(cpu));
}

std::string population_csv(const PopulationStudy& all) {
  std::string text = "case,outcome,message,wall time [s],CPU time [s],memory [MB]";
  const auto& parameters = all.study.population->parameters;
  for (const PopulationParameter& parameter : parameters)
    text += "," +
            csv_cell(parameter.name + (parameter.unit.empty() ? "" : " [" + parameter.unit + "]"));
  for (const StudyOutput& output : all.study.outputs)
    text += "," + csv_cell(output.name == output.column ? output.column
                                                        : output.name + " = " + output.column);
  text += "\n";
  for (std::size_t i = 0; i < all.records.size(); ++i) {
    const CaseRecord& record = all.records[i];
    text += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g}", csv_cell(all.population.cases[i].name),
                        csv_cell(record.outcome()), csv_cell(record.message), record.wall(),
                        record.cpu(), record.memory());
    for (std::size_t p = 0; p < parameters.size(); ++p)
      text += "," + csv_cell(all.population.values(static_cast<Eigen::Index>(p),
                                                   static_cast<Eigen::Index>(i)));
    for (const double value : all.result.values[i]) text += "," + csv_cell(value);
    text += "\n";
  }
  return text;
}

std::string population_text(const PopulationStudy& all) {
  const std::string what =
      all.study.command.empty() ? all.study.scenario.filename().string() : all.study.command[0];
  std::string text =
      fmt::format("# {}\n\n{}. {}\n\n", all.study.title, what, population_words(all));
  text += success_text(all) + parameters_text(all) + spread_text(all);
  for (std::size_t o = 0; o < all.study.outputs.size(); ++o) {
    const std::string part = tornado_text(all, o) + indices_text(all, o) + ranks_text(all, o);
    if (!part.empty()) text += fmt::format("\n## {}\n", name_of(all.study.outputs[o])) + part;
  }
  return text;
}

}  // namespace articular::tools
