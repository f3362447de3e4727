#pragma once

namespace articular::sim {

/// As project(VERSION) in CMakeLists.txt says it.
extern const char* const kVersion;

/// The day of this version, as CITATION.cff says it: "2026-11-26".
extern const char* const kReleaseDate;

}  // namespace articular::sim
