#pragma once

#include <string>
#include <vector>

#include "tools/study/population_result.hpp"

/// What a population study says, as text and as a table.
namespace articular::tools {

/// A population with all that its runs gave.
struct PopulationStudy {
  const Study& study;
  const PopulationCases& population;
  const std::vector<CaseRecord>& records;
  const PopulationResult& result;
};

/// One row a case: outcome, times, memory, parameters, outputs.
std::string population_csv(const PopulationStudy& all);

/// In Markdown: how many succeeded and why others did not, spread of parameters and outputs, what
/// each parameter does.
std::string population_text(const PopulationStudy& all);

/// "normal, 12 ± 3 MPa, from 5 MPa".
std::string distribution_words(const PopulationParameter& parameter);

/// "100 samples (Latin hypercube, seed 1)", and so on.
std::string population_words(const PopulationStudy& all);

/// "1.2 s", "3 min 20 s".
std::string duration_words(double seconds);

}  // namespace articular::tools
