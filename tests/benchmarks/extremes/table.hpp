#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/extremes/extreme.hpp"

namespace articular::benchmarks {

struct Row {
  std::string name, range;
  Finding finding;
  Outcome expected = Outcome::Right;
  double seconds = 0;  // wall time of all its runs
};

std::string markdown(const std::vector<Row>& rows);
std::string csv(const std::vector<Row>& rows);

}  // namespace articular::benchmarks
