#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/sampling/design.hpp"

/// What a study says of a population: parameters that are spread, anatomies, and what is asked.
namespace articular::tools {

struct PopulationParameter {
  std::string name, path;  // path of a scenario's value, or "": it stands in braces
  std::string unit;
  Distribution distribution;  // in that unit
};

struct Population {
  int samples = 0;
  Design design = Design::LatinHypercube;
  std::uint64_t seed = 1;
  bool tornado = false;
  int index_rows = 0;  // of Sobol indices; 0: none are asked for
  std::vector<std::filesystem::path> anatomies;
  std::vector<std::string> picture;  // arguments of `articular render`; none: no pictures
  std::vector<PopulationParameter> parameters;
  Eigen::MatrixXd correlation;  // of the parameters
};

}  // namespace articular::tools
