#include "sim/output/convergence.hpp"

#include <fmt/format.h>

#include <iterator>

namespace articular::sim {
namespace {

/// Names of bodies and lines have neither commas nor semicolons.
std::string words_for(const Model& model, const SupportChange& change) {
  return name_of(model, change.kind, change.index) + (change.kind == SupportChange::Kind::Ligament
                                                          ? (change.holds ? " taut" : " slack")
                                                          : (change.holds ? " closed" : " open"));
}

}  // namespace

std::string convergence_header(const LengthUnit& unit) {
  return fmt::format(
      "time [s],solution [-],damping [1/s^2],iteration [-],residual [-],correction [{}],"
      "fraction [-],began [-],ceased [-],changes\n",
      unit.name);
}

std::string convergence_rows(const Model& model, const std::vector<ConvergenceRow>& rows,
                             const LengthUnit& unit) {
  std::string text;
  for (const ConvergenceRow& row : rows) {
    int began = 0, ceased = 0;
    std::string flips;
    for (const SupportChange& change : row.newton.changes) {
      if (change.kind == SupportChange::Kind::Contact) began += change.began;
      if (change.kind == SupportChange::Kind::Contact) ceased += change.ceased;
      if (change.flips()) flips += (flips.empty() ? "" : "; ") + words_for(model, change);
    }
    fmt::format_to(std::back_inserter(text), "{:.12g},{},{:.6g},{},{:.6g},{:.6g},{:.4g},{},{},{}\n",
                   row.t, row.solution, row.damping, row.iteration, row.newton.residual,
                   row.newton.correction / unit.metres, row.newton.fraction, began, ceased, flips);
  }
  return text;
}

}  // namespace articular::sim
