#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/toml_reader.hpp"

namespace articular::tools {

/// What distinguishes a run of the scenario from the scenario as it is written.
struct StudySettings {
  std::vector<std::string> overrides;  // of `articular run --set`, PATH=VALUE
  std::optional<int> threads;
  std::vector<std::string> prepare;  // arguments of an `articular` command that makes its meshes
  bool reproducible = false;         // of `articular run`; no key says so
};

/// These settings and, over them, those of `more`.
StudySettings operator+(StudySettings settings, const StudySettings& more);

/// `set`, `threads` and `prepare` of a table.
StudySettings read_settings(const sim::TableReader& table);

/// A table's own keys, and those that read_settings() reads.
sim::KeyTable with_settings(std::string_view name, std::vector<sim::Key> keys);

/// A value as TOML writes it, so that an override reads the same again.
std::string toml_text(const sim::Node& node);

}  // namespace articular::tools
