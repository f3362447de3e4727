#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articular::sim {

/// An element of XML with all that is in it.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  // trimmed, without what stands in children
  std::vector<XmlElement> children;
  int line = 0;

  /// nullptr: there is none.
  const std::string* attribute(std::string_view name) const;
  const XmlElement* child(std::string_view name) const;
};

/// Reads a whole document into memory.
/// @param file  for messages
/// @throws InputError with the line, where it is no XML or is nested more than 100 deep
XmlElement read_xml_tree(const std::string& file, std::string_view format, std::string_view text);

}  // namespace articular::sim
