#pragma once

#include <string>
#include <vector>

#include "tools/keys/key_sections.hpp"

namespace articular::tools {

/// One or more tables of keys, and what stands above them.
struct KeyDocument {
  std::string title, introduction;
  std::vector<KeySection> sections;
};

/// All as Markdown, with links between sections.
std::string keys_as_markdown(const std::vector<KeyDocument>& documents);

/// A section for a terminal, a few lines for each key. @param only  this key alone; "": all
std::string keys_as_text(const KeySection& section, std::string_view only = "");

/// A section in a line or two: its keys, a star at the required ones.
std::string keys_in_short(const KeySection& section);

}  // namespace articular::tools
