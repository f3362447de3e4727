#include "tools/study/study_sweep.hpp"

#include <fmt/format.h>

#include "tools/study/csv_cell.hpp"
#include "tools/study/study_report.hpp"

namespace articular::tools {
namespace {

/// The value of an output; NaN of a case that did not finish.
double value_of(const std::vector<OutputValue>& values, std::size_t output) {
  return values.empty() ? kNoValue : values[output].values.back();
}

}  // namespace

std::string sweep_csv(const Study& study, const std::vector<StudyCase>& cases,
                      const std::vector<CaseRecord>& records,
                      const std::vector<std::vector<OutputValue>>& values) {
  std::string text = "case,outcome,wall time [s],CPU time [s],memory [MB]";
  for (const StudyOutput& output : study.outputs)
    text += "," + csv_cell(output.name == output.column ? output.column
                                                        : output.name + " = " + output.column);
  text += "\n";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    text += fmt::format("{},{},{:.6g},{:.6g},{:.6g}", csv_cell(cases[i].name),
                        csv_cell(records[i].outcome()), records[i].wall(), records[i].cpu(),
                        records[i].memory());
    for (std::size_t o = 0; o < study.outputs.size(); ++o)
      text += "," + csv_cell(value_of(values[i], o));
    text += "\n";
  }
  return text;
}

std::string sweep_text(const Study& study, const std::vector<StudyCase>& cases,
                       const std::vector<CaseRecord>& records,
                       const std::vector<std::vector<OutputValue>>& values) {
  std::string text = fmt::format(
      "# {}\n\nScenario {}, {}. Nothing says what is right: values side by side.\n\n"
      "| Case |",
      study.title, study.scenario.filename().string(), repeats_text(study.repeats, "times"));
  std::string line = "| --- |";
  for (const StudyOutput& output : study.outputs) {
    const std::string unit = unit_of(output.column);
    text += fmt::format(
        " {}{} |", output.name,
        output.name == output.column || unit.empty() ? "" : " [" + unit.substr(1) + "]");
    line += " --- |";
  }
  text += " wall time [s] |\n" + line + " --- |\n";
  std::string failed;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!records[i].succeeded()) {
      failed += fmt::format("| {} | {} | {} |\n", cases[i].name, records[i].outcome(),
                            records[i].message);
      continue;
    }
    text += fmt::format("| {} |", cases[i].name);
    for (std::size_t o = 0; o < study.outputs.size(); ++o)
      text += fmt::format(" {} |", csv_cell(value_of(values[i], o)));
    text += fmt::format(" {:.3g} |\n", records[i].wall());
  }
  if (!failed.empty()) text += "\n| Failed | how | message |\n| --- | --- | --- |\n" + failed;
  return text;
}

}  // namespace articular::tools
