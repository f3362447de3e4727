#pragma once

#include <string>

#include "sim/scenario/key_table.hpp"

namespace articular::tools {

/// A JSON schema (draft 7) of files with these keys, as text. It says what the tables say; what
/// joins several keys it lets pass.
std::string json_schema(const sim::KeyTable& root, const std::string& title);

}  // namespace articular::tools
