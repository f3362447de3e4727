#include "tests/benchmarks/extremes/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace articular::benchmarks {
namespace {

std::string quoted(std::string text) {
  for (std::size_t i = 0; (i = text.find('"', i)) != std::string::npos; i += 2)
    text.insert(i, "\"");
  return '"' + text + '"';
}

std::string cell(std::string text) {
  for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
    text.insert(i, "\\");
  return text;
}

}  // namespace

std::string name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::Right:
      return "right";
    case Outcome::Degraded:
      return "degraded";
    case Outcome::Refused:
      return "refused";
    case Outcome::Failed:
      return "failed";
  }
  return {};
}

std::string markdown(const std::vector<Row>& rows) {
  std::string text = "| Extreme | Tried | Outcome | Measured |\n| --- | --- | --- | --- |\n";
  std::string last;
  for (const Row& row : rows) {
    text += fmt::format("| {} | {} | {} | {} |\n", row.name == last ? "" : row.name, row.range,
                        name_of(row.finding.outcome), cell(row.finding.measured));
    last = row.name;
  }
  return text;
}

std::string csv(const std::vector<Row>& rows) {
  std::string text = "extreme,tried,outcome,expected,seconds,measured\n";
  for (const Row& row : rows)
    text += fmt::format("{},{},{},{},{:.2f},{}\n", quoted(row.name), quoted(row.range),
                        name_of(row.finding.outcome), name_of(row.expected), row.seconds,
                        quoted(row.finding.measured));
  return text;
}

}  // namespace articular::benchmarks
