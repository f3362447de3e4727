#pragma once

#include "tests/benchmarks/contact_scene.hpp"

/// Static studies that verify contact; each prints one table, in markdown.
namespace articular::sim {

void study_patch(const StudyOptions& options);
void study_drag(const StudyOptions& options);
void study_hertz(const StudyOptions& options);
void study_cylinders(const StudyOptions& options);
void study_layer(const StudyOptions& options);
void study_lines(const StudyOptions& options);

}  // namespace articular::sim
