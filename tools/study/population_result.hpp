#pragma once

#include <optional>
#include <vector>

#include "tools/sampling/sobol_indices.hpp"
#include "tools/study/population_cases.hpp"
#include "tools/study/study_assessment.hpp"

namespace articular::tools {

/// What an output is where one parameter is at its low or high end and all others at their medians;
/// NaN: that case did not finish.
struct TornadoBar {
  double low, high;
};

/// One output over the population.
struct PopulationOutput {
  std::vector<double> drawn;  // values of the cases that are drawn and have one
  double at_medians = kNoValue;
  std::vector<TornadoBar> bars;               // one a parameter, or none
  std::vector<SobolIndex> indices;            // one a parameter, or none
  int whole_rows = 0;                         // those of the indices in which no case failed
  std::vector<double> ranks;                  // Spearman's correlation with each parameter
  std::optional<std::size_t> least, largest;  // the cases with these values, among those drawn
};

struct PopulationResult {
  std::vector<std::size_t>
      drawn;  // cases that stand for the population: samples, or A and B of rows
  std::vector<std::vector<double>> values;  // of each case each output, NaN where it has none
  std::vector<PopulationOutput> outputs;
  std::size_t succeeded = 0;
};

/// @param values  see values_of_cases()
PopulationResult population_result(const Study& study, const PopulationCases& population,
                                   const std::vector<CaseRecord>& records,
                                   const std::vector<std::vector<OutputValue>>& values);

}  // namespace articular::tools
