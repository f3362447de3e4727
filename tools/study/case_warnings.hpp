#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/study_run.hpp"

namespace articular::tools {

struct CaseWarning {
  std::string text;           // the first of its kind
  std::string case_name;      // of that one
  std::size_t num_cases = 0;  // with one of this kind
};

/// What runs were warned of. Warnings that differ in their numbers only are of one kind.
struct CaseWarnings {
  std::vector<CaseWarning> kinds;
  std::size_t num_cases = 0;  // in all
};

/// By the summaries of cases that succeeded, in the order of the cases. Cases with commands of
/// their own may have none.
CaseWarnings case_warnings(const std::vector<StudyCase>& cases,
                           const std::vector<CaseRecord>& records,
                           const std::filesystem::path& directory);

/// For a page in Markdown; "" without any.
std::string warnings_table(const CaseWarnings& warnings);

/// The same on stderr, a line a kind.
void tell_warnings(const CaseWarnings& warnings);

}  // namespace articular::tools
