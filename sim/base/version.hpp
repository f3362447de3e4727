#pragma once

namespace articular::sim {

/// As project(VERSION) in CMakeLists.txt says it.
extern const char* const kVersion;

}  // namespace articular::sim
