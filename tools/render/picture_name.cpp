#include "tools/render/picture_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "tools/render/render.hpp"

namespace articular::tools {
namespace {

/// Long lists as their number and a hash: file names have an end.
std::string joined(const std::vector<std::string>& parts) {
  constexpr std::size_t kLongest = 100;
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "+") + part;
  if (text.size() > kLongest)
    return fmt::format("{}-parts-{:08x}", parts.size(),
                       std::hash<std::string>()(text) & 0xFFFFFFFFU);
  return text;
}

}  // namespace

std::string picture_name(const std::string& name, const std::string& field,
                         const RenderOptions& options) {
  std::string text = name;
  const auto add = [&](const std::string& word) {
    if (!word.empty()) text += "_" + word;
  };
  add(field);
  if (options.flat) add("flat");
  add(options.view);
  add(joined(options.only));
  if (!options.hidden.empty()) add("without-" + joined(options.hidden));
  if (!options.focus.empty()) add("focus-" + options.focus);
  if (!options.clip.empty()) add("clip-" + options.clip);
  if (options.deformation != 1) add(fmt::format("deformation-{:g}", options.deformation));
  // What a shell or another system would take for something else.
  for (char& c : text) {
    if (c == '<') c = '-';
    if (c == '>') c = '+';
    if (c == ':' || c == '/' || c == ' ') c = '-';
  }
  return text;
}

}  // namespace articular::tools
