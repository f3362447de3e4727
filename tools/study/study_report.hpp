#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/study_assessment.hpp"

namespace articular::tools {

/// " mm" of "tip.position.z [mm]", or "".
std::string unit_of(const std::string& column);

/// "3 runs of each case, median TIMES"
std::string repeats_text(int repeats, const std::string& times);

/// One row a case: outcome, times, memory, error, and value and error of each output.
std::string study_csv(const Study& study, const std::vector<StudyCase>& cases,
                      const std::vector<CaseRecord>& records, const Assessment& assessment);

/// What came out, in Markdown: what is right, the front and what the next halving of the error
/// costs on it, what is dominated and by what, and what failed.
std::string study_text(const Study& study, const std::vector<StudyCase>& cases,
                       const std::vector<CaseRecord>& records, const Assessment& assessment);

/// gnuplot's commands for pareto.svg, error against time with the front as a line.
std::string study_plot(const std::vector<StudyCase>& cases, const std::string& title,
                       const Assessment& assessment, const std::filesystem::path& picture);

}  // namespace articular::tools
