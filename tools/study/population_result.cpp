#include "tools/study/population_result.hpp"

#include <algorithm>
#include <cmath>

#include "tools/sampling/spread.hpp"

namespace articular::tools {
namespace {

/// Samples; where there are none, A and B of the rows, which are drawn in the same way.
std::vector<std::size_t> drawn_cases(const PopulationCases& population, std::size_t width) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < population.num_samples; ++i) drawn.push_back(i);
  if (!drawn.empty()) return drawn;
  for (std::size_t i = population.num_tornado; i < population.cases.size(); i += width) {
    drawn.push_back(i);
    drawn.push_back(i + 1);
  }
  return drawn;
}

/// One output in each case.
using Column = std::vector<double>;

void add_tornado(const PopulationCases& population, const Column& column,
                 PopulationOutput& output) {
  if (population.num_tornado == 0) return;
  const std::size_t first = population.num_samples;
  output.at_medians = column[first];
  for (std::size_t i = 1; i < population.num_tornado; i += 2)
    output.bars.push_back({column[first + i], column[first + i + 1]});
}

void add_indices(const Population& asked, const PopulationCases& population, const Column& column,
                 PopulationOutput& output) {
  if (asked.index_rows == 0) return;
  const auto width = static_cast<Eigen::Index>(asked.parameters.size() + 2);
  Eigen::MatrixXd table(asked.index_rows, width);
  std::size_t next = population.num_samples + population.num_tornado;
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (Eigen::Index i = 0; i < width; ++i) table(row, i) = column[next++];
    output.whole_rows += table.row(row).allFinite() ? 1 : 0;
  }
  output.indices = sobol_indices(table, asked.seed);
}

void add_spread(const PopulationResult& result, const PopulationCases& population,
                const Column& column, PopulationOutput& output) {
  std::vector<double> values;
  for (const std::size_t i : result.drawn) {
    values.push_back(column[i]);
    if (!std::isfinite(column[i])) continue;
    if (!output.least || column[i] < column[*output.least]) output.least = i;
    if (!output.largest || column[i] > column[*output.largest]) output.largest = i;
  }
  output.drawn = known(values);
  for (Eigen::Index p = 0; p < population.values.rows(); ++p) {
    std::vector<double> parameter;
    for (const std::size_t i : result.drawn)
      parameter.push_back(population.values(p, static_cast<Eigen::Index>(i)));
    output.ranks.push_back(rank_correlation(parameter, values));
  }
}

}  // namespace

PopulationResult population_result(const Study& study, const PopulationCases& population,
                                   const std::vector<CaseRecord>& records,
                                   const std::vector<std::vector<OutputValue>>& values) {
  PopulationResult result;
  result.drawn = drawn_cases(population, study.population->parameters.size() + 2);
  for (std::size_t i = 0; i < population.cases.size(); ++i) {
    result.succeeded += records[i].succeeded() ? 1 : 0;
    Column row(study.outputs.size(), kNoValue);
    for (std::size_t o = 0; o < row.size() && !values[i].empty(); ++o)
      row[o] = values[i][o].values.back();
    result.values.push_back(std::move(row));
  }
  for (std::size_t o = 0; o < study.outputs.size(); ++o) {
    Column column;
    for (const Column& row : result.values) column.push_back(row[o]);
    PopulationOutput output;
    add_spread(result, population, column, output);
    add_tornado(population, column, output);
    add_indices(*study.population, population, column, output);
    result.outputs.push_back(std::move(output));
  }
  return result;
}

}  // namespace articular::tools
