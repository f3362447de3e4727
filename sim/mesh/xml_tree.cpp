#include "sim/mesh/xml_tree.hpp"

#include <algorithm>

#include "sim/base/error.hpp"
#include "sim/mesh/white_space.hpp"
#include "sim/mesh/xml_events.hpp"

namespace articular::sim {
namespace {

constexpr std::size_t kDeepest = 100;  // destructors go as deep

std::string without_blanks_around(const std::string& text) {
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), is_space).base();
  return first < last ? std::string(first, last) : std::string();
}

}  // namespace

const std::string* XmlElement::attribute(std::string_view wanted) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& pair) { return pair.first == wanted; });
  return found != attributes.end() ? &found->second : nullptr;
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
  const auto found = std::find_if(children.begin(), children.end(),
                                  [&](const XmlElement& child) { return child.name == wanted; });
  return found != children.end() ? &*found : nullptr;
}

XmlElement read_xml_tree(const std::string& file, std::string_view format, std::string_view text) {
  XmlElement document;
  std::vector<XmlElement*> open = {&document};  // children of open ones alone grow
  int line = 1;
  std::size_t counted = 0;
  XmlEvents events;
  events.start = [&](const std::string& name, const XmlAttributes& attributes, std::size_t at) {
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                        text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
    counted = at;
    if (open.size() > kDeepest)
      throw InputError({file, line}, "elements are nested more than 100 deep");
    XmlElement& element = open.back()->children.emplace_back();
    element.name = name;
    element.attributes.assign(attributes.begin(), attributes.end());
    element.line = line;
    open.push_back(&element);
    return XmlNext::Continue;
  };
  events.text = [&](std::string_view characters) { open.back()->text += characters; };
  events.end = [&](const std::string&) {
    XmlElement& element = *open.back();
    element.text = without_blanks_around(element.text);
    open.pop_back();
  };
  read_xml(file, format, text, events);
  if (document.children.empty()) throw InputError({file, line}, "has no element");
  return std::move(document.children.front());
}

}  // namespace articular::sim
