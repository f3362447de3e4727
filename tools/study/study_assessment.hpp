#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/study_run.hpp"
#include "tools/study/study_values.hpp"

namespace articular::tools {

/// How near a case came. Everything is NaN for a case that did not finish.
struct CaseAssessment {
  std::vector<double> values;  // of each output, in the column's unit; of a history NaN
  std::vector<double> errors;  // of each output, relative to its scale
  double error = 0;            // the largest of them
  double time = 0;             // [s]
  bool on_front = false;       // no other case is as near in less time, nor nearer in as much
  int better = -1;             // else the cheapest case on the front that is as near
};

struct Assessment {
  std::vector<ReferenceValue> references;  // of each output
  std::vector<double> scales;              // of each output: an error of 1, in the column's unit
  double uncertainty = 0;  // of the error, by the worst known output; NaN: not known of any
  bool cpu_time = false;   // times are those of the processor, as cases ran side by side
  std::vector<CaseAssessment> cases;
};

/// The outputs of each case, as it left them in its folder; none of a case that did not finish.
/// @throws sim::InputError  when an output is not in the results
std::vector<std::vector<OutputValue>> values_of_cases(const Study& study,
                                                      const std::vector<StudyCase>& cases,
                                                      const std::vector<CaseRecord>& records,
                                                      const std::filesystem::path& directory);

/// Compares what the cases left in their folders with what is right. On the front an error below
/// the uncertainty of the reference counts as one of that size, and errors within a hundredth of
/// each other as equal.
/// @throws sim::SimulationError  when a reference did not finish
/// @throws sim::InputError       when an output is not in the results
Assessment assess(const Study& study, const std::vector<StudyCase>& cases,
                  const std::vector<CaseRecord>& records, const std::filesystem::path& directory,
                  bool cpu_time);

/// The numbers of the cases on the front, from cheap to accurate.
std::vector<std::size_t> front(const Assessment& assessment);

}  // namespace articular::tools
