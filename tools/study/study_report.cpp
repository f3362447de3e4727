#include "tools/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/output/history_column.hpp"
#include "tools/study/csv_cell.hpp"
#include "tools/study/front_axes.hpp"

namespace articular::tools {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

const char* time_word(const Assessment& assessment) {
  return assessment.cpu_time ? "CPU time" : "wall time";
}

std::string reference_text(const Study& study, const Assessment& assessment, std::size_t o) {
  const StudyOutput& output = study.outputs[o];
  const ReferenceValue& reference = assessment.references[o];
  const std::string unit = unit_of(output.column);
  std::string text = fmt::format("- {}: ", output.name);
  if (output.value == StudyValue::History)
    text += "the curve of the reference, largest difference over the time";
  else
    text += fmt::format("{:.5g}{}", reference.value.values[0], unit);
  if (output.exact) text += ", exact";
  if (std::isfinite(reference.uncertainty) && !output.exact)
    text += fmt::format(", known to ± {:.2g}{}", reference.uncertainty, unit);
  if (reference.order > 0)
    text += fmt::format(" (Richardson, observed order {:.2f})", reference.order);
  else if (!output.exact && study.references.size() == 3)
    text += " (three reference runs that do not converge evenly: the finest counts)";
  else if (!output.exact)
    text += study.references.size() == 2 ? " (finest of two runs)" : " (one converged run)";
  return text + fmt::format("; an error of 100 % is {:.4g}{}\n", assessment.scales[o], unit);
}

/// By how much the time grows where the error is halved, between two points. Of points whose errors
/// are nearly the same that is no number to tell.
std::string halving(const CaseAssessment& cheap, const CaseAssessment& near) {
  constexpr double kMost = 100;
  if (!(near.error > 0) || !(cheap.error > near.error)) return "";
  const double halvings = std::log2(cheap.error / near.error);
  const double costs = std::pow(near.time / cheap.time, 1 / halvings);
  return costs > kMost ? fmt::format("more than {:g}", kMost) : fmt::format("{:.2g}", costs);
}

std::string front_table(const std::vector<StudyCase>& cases, const Assessment& assessment) {
  std::string text = fmt::format(
      "| On the front | error | {} [s] | a halving of the error costs, times |\n"
      "| --- | --- | --- | --- |\n",
      time_word(assessment));
  const CaseAssessment* before = nullptr;
  for (const std::size_t i : front(assessment)) {
    const CaseAssessment& mine = assessment.cases[i];
    text += fmt::format("| {} | {} | {:.3g} | {} |\n", cases[i].name, percent(mine.error),
                        mine.time, before != nullptr ? halving(*before, mine) : "");
    before = &mine;
  }
  return text;
}

std::string dominated_table(const std::vector<StudyCase>& cases, const Assessment& assessment) {
  std::string rows;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseAssessment& mine = assessment.cases[i];
    if (mine.better < 0) continue;
    const auto better = static_cast<std::size_t>(mine.better);
    rows += fmt::format("| {} | {} | {:.3g} | {}, in {:.2g} of the time |\n", cases[i].name,
                        percent(mine.error), mine.time, cases[better].name,
                        assessment.cases[better].time / mine.time);
  }
  if (rows.empty()) return "";
  return fmt::format("\n| Dominated | error | {} [s] | by |\n| --- | --- | --- | --- |\n",
                     time_word(assessment)) +
         rows;
}

std::string failed_table(const std::vector<StudyCase>& cases,
                         const std::vector<CaseRecord>& records, const Assessment& assessment) {
  std::string rows;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!records[i].succeeded())
      rows += fmt::format("| {} | {} | {} |\n", cases[i].name, records[i].outcome(),
                          records[i].message);
    else if (!std::isfinite(assessment.cases[i].error))
      rows += fmt::format("| {} | done | an output has no value |\n", cases[i].name);
  }
  return rows.empty() ? "" : "\n| Failed | how | message |\n| --- | --- | --- |\n" + rows;
}

std::string below_uncertainty(const std::vector<StudyCase>& cases, const Assessment& assessment) {
  if (!std::isfinite(assessment.uncertainty) || assessment.uncertainty == 0) return "";
  std::string names;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (cases[i].reference < 0 && assessment.cases[i].error < assessment.uncertainty)
      names += (names.empty() ? "" : "; ") + cases[i].name;
  return fmt::format("\nThe reference is known to {}.{}\n", percent(assessment.uncertainty),
                     names.empty() ? "" : " Nearer than that can't be told: " + names + ".");
}

/// For gnuplot's text in double quotes.
std::string plot_label(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// The cases that have a place in the picture, from cheap to expensive.
std::vector<std::size_t> drawn_cases(const std::vector<StudyCase>& cases,
                                     const Assessment& assessment) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (cases[i].reference < 0 && assessment.cases[i].error > 0) drawn.push_back(i);
  std::sort(drawn.begin(), drawn.end(), [&](std::size_t a, std::size_t b) {
    return assessment.cases[a].time < assessment.cases[b].time;
  });
  return drawn;
}

/// Both axes as far as there is something, with room around it.
struct FrontAxes {
  double least_time, most_time, least_error, most_error;  // [s], [%]

  SharePoint shares(const CaseAssessment& c) const {
    return {std::log(c.time / least_time) / std::log(most_time / least_time),
            std::log(100 * c.error / least_error) / std::log(most_error / least_error)};
  }
  std::string text() const {
    return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", least_time,
                       most_time, least_error, most_error) +
           axis_numbers('x', least_time, most_time) + axis_numbers('y', least_error, most_error);
  }
};

FrontAxes front_axes(const std::vector<std::size_t>& drawn, const Assessment& assessment) {
  constexpr double kRoom = 1.5;
  double least = kInfinity, most = 0;
  for (const std::size_t i : drawn) {
    least = std::min(least, assessment.cases[i].error);
    most = std::max(most, assessment.cases[i].error);
  }
  if (assessment.uncertainty > 0) least = std::min(least, assessment.uncertainty);
  return {assessment.cases[drawn.front()].time / kRoom, assessment.cases[drawn.back()].time * kRoom,
          100 * least / kRoom, 100 * most * kRoom};
}

std::string front_line(const Assessment& assessment) {
  std::string text = "$front << END\n";
  for (const std::size_t i : front(assessment))
    text +=
        fmt::format("{:.8g} {:.8g}\n", assessment.cases[i].time, 100 * assessment.cases[i].error);
  return text + "END\n";
}

}  // namespace

std::string unit_of(const std::string& column) {
  const std::string unit = sim::history_column(column).unit;
  return unit.empty() ? "" : " " + unit;
}

std::string repeats_text(int repeats, const std::string& times) {
  return repeats == 1 ? "one run of each case"
                      : fmt::format("{} runs of each case, median {}", repeats, times);
}

std::string study_csv(const Study& study, const std::vector<StudyCase>& cases,
                      const std::vector<CaseRecord>& records, const Assessment& assessment) {
  std::string text = "case,outcome,wall time [s],CPU time [s],memory [MB],error,on front";
  for (const StudyOutput& output : study.outputs)
    text += "," + csv_cell(output.name + " = " + output.column) + "," +
            csv_cell("error of " + output.name);
  text += "\n";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseAssessment& c = assessment.cases[i];
    text += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{},{}", csv_cell(cases[i].name),
                        csv_cell(records[i].outcome()), records[i].wall(), records[i].cpu(),
                        records[i].memory(), csv_cell(c.error), c.on_front ? "yes" : "no");
    for (std::size_t o = 0; o < study.outputs.size(); ++o)
      text += "," + csv_cell(c.values[o]) + "," + csv_cell(c.errors[o]);
    text += "\n";
  }
  return text;
}

std::string study_text(const Study& study, const std::vector<StudyCase>& cases,
                       const std::vector<CaseRecord>& records, const Assessment& assessment) {
  std::string text =
      fmt::format("# {}\n\nScenario {}, {}.\n\n", study.title, study.scenario.filename().string(),
                  repeats_text(study.repeats, std::string(time_word(assessment)) + "s"));
  text += "What is right:\n\n";
  for (std::size_t o = 0; o < study.outputs.size(); ++o)
    text += reference_text(study, assessment, o);
  text += below_uncertainty(cases, assessment) + "\n" + front_table(cases, assessment) +
          dominated_table(cases, assessment) + failed_table(cases, records, assessment);
  return text;
}

std::string study_plot(const std::vector<StudyCase>& cases, const std::string& title,
                       const Assessment& assessment, const std::filesystem::path& picture) {
  const std::vector<std::size_t> drawn = drawn_cases(cases, assessment);
  if (drawn.empty()) return "";
  constexpr std::size_t kLeastHeight = 420, kLine = 17;
  std::string text = fmt::format(
      "set terminal svg size 900,{} font 'sans,12' noenhanced background rgb 'white'\n"
      "set output \"{}\"\n"
      "set title \"{}\"\n"
      "set xlabel '{} [s]'\n"
      "set ylabel 'error [%]'\n"
      "set logscale xy\n"
      "set grid lc rgb '#dddddd'\n"
      "set key outside right top Left reverse samplen 1 font ',10'\n",
      std::max(kLeastHeight, kLine * drawn.size() + 120), plot_label(picture.string()),
      plot_label(title), time_word(assessment));
  const FrontAxes axes = front_axes(drawn, assessment);
  text += axes.text() + front_line(assessment);
  std::vector<SharePoint> points;
  points.reserve(drawn.size());
  for (const std::size_t i : drawn) points.push_back(axes.shares(assessment.cases[i]));
  const std::vector<std::string> places = number_places(points);
  std::string plots = "plot $front with lines lw 2 lc rgb '#d95f02' title 'front'";
  if (assessment.uncertainty > 0)
    plots += fmt::format(", {:.8g} with lines dt 2 lc rgb '#1b9e77' title 'reference known to'",
                         100 * assessment.uncertainty);
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    const CaseAssessment& c = assessment.cases[drawn[n]];
    const char* colour = c.on_front ? "#d95f02" : "#999999";
    text += fmt::format(
        "$case{0} << END\n{1:.8g} {2:.8g}\nEND\n"
        "set label {0} '{0}' at {1:.8g},{2:.8g} {4} textcolor rgb '{3}'\n",
        n + 1, c.time, 100 * c.error, c.on_front ? "black" : "#777777", places[n]);
    plots += fmt::format(", $case{0} with points pt 7 ps 0.7 lc rgb '{1}' title \"{0}  {2}\"",
                         n + 1, colour, plot_label(cases[drawn[n]].name));
  }
  return text + plots + "\n";
}

}  // namespace articular::tools
