#include "tools/study/study_assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

using CaseValues = std::vector<OutputValue>;  // one an output; empty: the case did not finish

CaseValues values_of(const Study& study, const std::filesystem::path& results) {
  const RunHistory history = read_history(results / "history.csv");
  CaseValues values;
  for (const StudyOutput& output : study.outputs)
    values.push_back(output_value(output, history, study.file.string()));
  return values;
}

/// The values of the reference runs, finest first.
std::vector<CaseValues> reference_runs(const Study& study, const std::vector<StudyCase>& cases,
                                       const std::vector<CaseRecord>& records,
                                       const std::vector<CaseValues>& values) {
  std::vector<CaseValues> runs(study.references.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].reference < 0) continue;
    if (values[i].empty())
      throw sim::SimulationError(
          fmt::format("{}: `{}` did not finish ({}{}{}); without it no error can be told",
                      study.file.string(), cases[i].name, records[i].outcome(),
                      records[i].message.empty() ? "" : ": ", records[i].message));
    runs[static_cast<std::size_t>(cases[i].reference)] = values[i];
  }
  return runs;
}

ReferenceValue reference_of(const Study& study, std::size_t output,
                            const std::vector<CaseValues>& runs) {
  if (const auto exact = study.outputs[output].exact) return {{{0}, {*exact}}};
  std::vector<OutputValue> values;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    values.push_back(runs[i][output]);
    sizes.push_back(study.references[i].size);
    if (!std::isfinite(values.back().values.back()))
      throw sim::InputError(
          {study.file.string()},
          fmt::format("output `{}` has no value in a reference run", study.outputs[output].name));
  }
  return reference_value(values, sizes);
}

/// An error of 1: what the study says, else the right value, of a history its range.
double scale_of(const Study& study, std::size_t output, const ReferenceValue& reference) {
  const StudyOutput& what = study.outputs[output];
  if (what.scale) return *what.scale;
  const auto& values = reference.value.values;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double scale = what.value == StudyValue::History ? *most - *least : std::abs(values.back());
  if (scale > 0) return scale;
  throw sim::InputError({study.file.string()},
                        fmt::format("output `{}` is {} in the reference: an error relative to that "
                                    "says nothing; expected a `scale`",
                                    what.name, values.back()));
}

double largest_known(const std::vector<double>& values) {
  double most = kNoValue;
  for (const double value : values)
    if (std::isfinite(value) && !(most >= value)) most = value;
  return most;
}

CaseAssessment assess_case(const CaseValues& values, const Assessment& so_far, double time) {
  CaseAssessment result;
  result.time = time;
  result.error = 0;
  for (std::size_t o = 0; o < so_far.references.size(); ++o) {
    const bool single = !values.empty() && values[o].values.size() == 1;
    result.values.push_back(single ? values[o].values[0] : kNoValue);
    result.errors.push_back(values.empty() ? kNoValue
                                           : difference(values[o], so_far.references[o].value) /
                                                 so_far.scales[o]);
    if (!(result.errors.back() <= result.error)) result.error = result.errors.back();
  }
  return result;
}

/// The error as far as it can be told.
double told(const Assessment& assessment, std::size_t i) {
  const double error = assessment.cases[i].error;
  return std::isfinite(assessment.uncertainty) ? std::max(error, assessment.uncertainty) : error;
}

/// Errors that differ by less count as equal: their tables would not show it.
constexpr double kNearer = 0.99;

void find_front(const std::vector<StudyCase>& cases, Assessment& assessment) {
  std::vector<std::size_t> order;  // of those that take part, from cheap to dear
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (cases[i].reference < 0 && std::isfinite(assessment.cases[i].error)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(assessment.cases[a].time, told(assessment, a)) <
           std::pair(assessment.cases[b].time, told(assessment, b));
  });
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    assessment.cases[i].on_front = told(assessment, i) < kNearer * nearest;
    if (assessment.cases[i].on_front) nearest = told(assessment, i);
  }
  const std::vector<std::size_t> best = front(assessment);
  for (const std::size_t i : order) {
    if (assessment.cases[i].on_front) continue;
    const auto better = std::find_if(best.begin(), best.end(), [&](std::size_t j) {
      return kNearer * told(assessment, j) <= told(assessment, i);
    });
    assessment.cases[i].better = static_cast<int>(*better);
  }
}

}  // namespace

std::vector<std::size_t> front(const Assessment& assessment) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < assessment.cases.size(); ++i)
    if (assessment.cases[i].on_front) result.push_back(i);
  std::sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
    return assessment.cases[a].time < assessment.cases[b].time;
  });
  return result;
}

std::vector<CaseValues> values_of_cases(const Study& study, const std::vector<StudyCase>& cases,
                                        const std::vector<CaseRecord>& records,
                                        const std::filesystem::path& directory) {
  std::vector<CaseValues> values(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i)
    if (records[i].succeeded()) values[i] = values_of(study, results_of(directory, cases[i]));
  return values;
}

Assessment assess(const Study& study, const std::vector<StudyCase>& cases,
                  const std::vector<CaseRecord>& records, const std::filesystem::path& directory,
                  bool cpu_time) {
  const std::vector<CaseValues> values = values_of_cases(study, cases, records, directory);
  const std::vector<CaseValues> runs = reference_runs(study, cases, records, values);
  Assessment assessment;
  assessment.cpu_time = cpu_time;
  std::vector<double> uncertainties;
  for (std::size_t o = 0; o < study.outputs.size(); ++o) {
    assessment.references.push_back(reference_of(study, o, runs));
    assessment.scales.push_back(scale_of(study, o, assessment.references[o]));
    uncertainties.push_back(assessment.references[o].uncertainty / assessment.scales[o]);
  }
  assessment.uncertainty = largest_known(uncertainties);
  for (std::size_t i = 0; i < cases.size(); ++i)
    assessment.cases.push_back(
        assess_case(values[i], assessment, cpu_time ? records[i].cpu() : records[i].wall()));
  find_front(cases, assessment);
  return assessment;
}

}  // namespace articular::tools
