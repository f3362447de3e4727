#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/study_file.hpp"

namespace articular::tools {

/// One run of the study.
struct StudyCase {
  std::string name;    // "step = 0.5 ms", unique
  std::string folder;  // its name as that of a folder, unique
  StudySettings settings;
  int reference = -1;                         // which of Study::references it is
  std::vector<std::string> command = {};      // in place of `articular run`
  std::vector<std::string> environment = {};  // "NAME=VALUE"
  bool prepares_alone = false;                // its meshes are its own, and made when it is run
};

/// The scenario as it is, what the knobs make of it, the extra cases, and the references.
std::vector<StudyCase> study_cases(const Study& study);

/// Gives each case a folder of its own, by its name.
void name_folders(std::vector<StudyCase>& cases);

}  // namespace articular::tools
