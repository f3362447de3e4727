#include "sim/output/convergence.hpp"

#include <fmt/format.h>

#include <iterator>

namespace articular::sim {
std::string convergence_header(const LengthUnit& unit) {
  return fmt::format(
      "time [s],solution [-],damping [1/s^2],iteration [-],residual [-],correction [{}],"
      "fraction [-]\n",
      unit.name);
}

std::string convergence_rows(const std::vector<ConvergenceRow>& rows, const LengthUnit& unit) {
  std::string text;
  for (const ConvergenceRow& row : rows)
    fmt::format_to(std::back_inserter(text), "{:.12g},{},{:.6g},{},{:.6g},{:.6g},{:.4g}\n", row.t,
                   row.solution, row.damping, row.iteration, row.newton.residual,
                   row.newton.correction / unit.metres, row.newton.fraction);
  return text;
}

}  // namespace articular::sim
