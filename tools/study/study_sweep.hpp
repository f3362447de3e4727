#pragma once

#include <string>
#include <vector>

#include "tools/study/study_assessment.hpp"

/// What a study says that knows nothing of what is right: the outputs of its cases, side by side.
namespace articular::tools {

/// One row a case: outcome, times, memory, and value of each output.
/// @param values  of each case, see values_of_cases()
std::string sweep_csv(const Study& study, const std::vector<StudyCase>& cases,
                      const std::vector<CaseRecord>& records,
                      const std::vector<std::vector<OutputValue>>& values);

/// The same in Markdown, for people, and what failed.
std::string sweep_text(const Study& study, const std::vector<StudyCase>& cases,
                       const std::vector<CaseRecord>& records,
                       const std::vector<std::vector<OutputValue>>& values);

}  // namespace articular::tools
