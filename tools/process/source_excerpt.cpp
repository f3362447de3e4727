#include "tools/process/source_excerpt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

constexpr std::size_t kWidest = 90;  // characters of a line that are shown

/// The digits at the beginning of the text, taken away from it; 0: there are none.
int take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// What stands before the ": " of a message. A file's name may have colons of its own: the first
/// reading that names a file counts.
std::optional<sim::Location> place_in(std::string_view message) {
  for (std::size_t colon = message.find(':'); colon != std::string_view::npos;
       colon = message.find(':', colon + 1)) {
    sim::Location place{std::string(message.substr(0, colon))};
    std::string_view rest = message.substr(colon + 1);
    place.line = take_number(rest);
    if (place.line > 0 && rest.starts_with(":") && !rest.starts_with(": ")) {
      rest.remove_prefix(1);
      place.column = take_number(rest);
    }
    std::error_code error;
    if (place.line > 0 && rest.starts_with(": ") &&
        std::filesystem::is_regular_file(place.file, error))
      return place;
  }
  return std::nullopt;
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The characters of a line, a tab as a space; nothing if it is no text.
std::optional<std::vector<std::string>> characters(std::string_view line) {
  std::vector<std::string> all;
  for (char c : line) {
    if (c == '\t') c = ' ';
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) return std::nullopt;
    if (continues_character(c) && !all.empty())
      all.back() += c;
    else
      all.emplace_back(1, c);
  }
  return all;
}

std::optional<std::string> read_line(const sim::Location& place) {
  std::ifstream in(place.file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number)
    if (number == place.line) {
      if (line.ends_with('\r')) line.pop_back();
      return line;
    }
  return std::nullopt;
}

}  // namespace

std::string source_excerpt(std::string_view message) {
  const auto place = place_in(message);
  const auto line = place ? read_line(*place) : std::nullopt;
  const auto text = line ? characters(*line) : std::nullopt;
  if (!text || text->empty()) return "";
  const auto column = static_cast<std::size_t>(place->column);  // counts from 1
  if (column > text->size() + 1) return "";
  const std::size_t longest_begin = text->size() > kWidest ? text->size() - kWidest : 0;
  const std::size_t begin =
      std::min(longest_begin, column > kWidest / 2 ? column - kWidest / 2 : 0);
  const std::size_t end = std::min(text->size(), begin + kWidest);
  const std::string number = fmt::format("{:>5}", place->line), cut = begin > 0 ? "..." : "";
  std::string shown = cut;
  for (std::size_t i = begin; i < end; ++i) shown += (*text)[i];
  std::string excerpt = fmt::format("{} | {}{}\n", number, shown, end < text->size() ? "..." : "");
  if (column > 0)
    excerpt += fmt::format("{:{}} | {:>{}}\n", "", number.size(), "^", cut.size() + column - begin);
  return excerpt;
}

}  // namespace articular::tools
