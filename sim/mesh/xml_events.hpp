#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace articular::sim {

using XmlAttributes = std::map<std::string, std::string, std::less<>>;

/// The value of an attribute, or `otherwise`.
std::string attribute(const XmlAttributes& attributes, std::string_view name,
                      std::string_view otherwise = "");

enum class XmlNext { Continue, Stop };

/// What is told of an XML text, in its order. What is not set is passed over.
struct XmlEvents {
  /// @param at  where the element begins in the text [byte]
  std::function<XmlNext(const std::string& name, const XmlAttributes& attributes, std::size_t at)>
      start{};
  std::function<void(std::string_view characters)> text{};  // in pieces
  std::function<void(const std::string& name)> end{};
};

/// Reads XML with expat, until its end or where an event stops it. Documents that define entities
/// are refused, so that no text grows.
/// @param file    for messages
/// @param format  ".vtu": for messages, which quote nothing of the file
/// @throws InputError with the line, where it is no XML, and what the events throw
void read_xml(const std::string& file, std::string_view format, std::string_view text,
              const XmlEvents& events);

}  // namespace articular::sim
