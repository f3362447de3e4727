#include "tests/benchmarks/extremes/energy_error.hpp"

#include <algorithm>

namespace articular::benchmarks {

double energy_created(const ScenarioResults& results) {
  const auto column = [&](const std::string& name) -> const std::vector<double>& {
    return results.column("energy." + name + " [J]");
  };
  double created = 0, most = 0;
  for (std::size_t i = 0; i < column("kinetic").size(); ++i) {
    created = std::max(created, -column("numerical_loss")[i]);
    most = std::max(most, column("kinetic")[i] + column("elastic")[i] + column("contact")[i]);
  }
  return created == 0 ? 0 : created / most;
}

}  // namespace articular::benchmarks
