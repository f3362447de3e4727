#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tools/study/study_cases.hpp"

namespace articular::tools {

/// The environment variable that names the folder of a case's anatomy.
inline constexpr const char* kAnatomy = "ARTICULAR_ANATOMY";

/// Shares of a parameter's values below the ends of its bar in a tornado.
inline constexpr double kTornadoLow = 0.05, kTornadoHigh = 0.95;

/// The cases of a population: those drawn at random, then those of the tornado (all medians, then
/// low and high of each parameter), then rows of Sobol indices, see saltelli_points().
struct PopulationCases {
  std::vector<StudyCase> cases;
  Eigen::MatrixXd values;  // a parameter a row, a case a column
  std::size_t num_samples = 0, num_tornado = 0;
};

/// @param study  one with a population
PopulationCases population_cases(const Study& study);

/// A number with its unit.
std::string with_unit(double value, const std::string& unit);

}  // namespace articular::tools
