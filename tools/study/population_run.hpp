#pragma once

#include "tools/study/study_run.hpp"

namespace articular::tools {

/// Runs a population and writes DIR/population.md, .csv and .html. Prints the files' names.
/// @throws StudyInterrupted  what is finished stays
int study_population(const Study& study, const StudyRunOptions& options);

}  // namespace articular::tools
