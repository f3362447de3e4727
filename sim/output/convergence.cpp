#include "sim/output/convergence.hpp"

#include <fmt/format.h>

#include <iterator>

namespace articular::sim {
namespace {

/// Times are printed with twelve digits: a row's time may be this much off, relatively.
constexpr double kTimeRounding = 1e-11;

}  // namespace

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

std::string rows_until(const std::string& table, double time) {
  std::string rows;
  std::size_t begin = table.find('\n');
  while (begin != std::string::npos && begin + 1 < table.size()) {
    const std::size_t end = table.find('\n', begin + 1);
    const std::string row = table.substr(begin + 1, end - begin);
    if (std::stod(row) > time * (1 + kTimeRounding)) break;
    rows += row;
    begin = end;
  }
  return rows;
}

}  // namespace articular::sim
