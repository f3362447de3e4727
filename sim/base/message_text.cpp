#include "sim/base/message_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace articular::sim {
namespace {

constexpr std::size_t kLongestQuote = 60;      // [bytes] of a text that a message repeats
constexpr std::size_t kLongestList = 20;       // names that a message lists
constexpr std::size_t kLongestMistyped = 200;  // [bytes]: distances take time by the square

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Twice the edit distance (insert, delete, replace; a change of letter case counts 1 of 2).
std::size_t doubled_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = 2 * j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = 2 * (i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replace = a[i] == b[j] ? 0 : (lower(a[i]) == lower(b[j]) ? 1 : 2);
      const std::size_t best = std::min({row[j + 1] + 2, row[j] + 2, diagonal + replace});
      diagonal = row[j + 1];
      row[j + 1] = best;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(line.begin(), line.end(), is_control, ' ');
  return line;
}

std::string in_ticks(std::string_view name) { return "`" + one_line(name) + "`"; }

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, kLongestQuote)) {
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (is_control(c))
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  // A cut in the middle of a UTF-8 character is moved to before that character.
  if (text.size() > kLongestQuote) {
    if ((static_cast<unsigned char>(text[kLongestQuote]) & 0xC0) == 0x80) {
      while ((static_cast<unsigned char>(out.back()) & 0xC0) == 0x80) out.pop_back();
      out.pop_back();
    }
    out += "...";
  }
  return out + "\"";
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& names) {
  if (name.size() > kLongestMistyped) return "";
  // A third of the letters may be wrong, one always: `hup` is not a mistyped `body`.
  const std::size_t farthest = 2 * std::max<std::size_t>(1, (name.size() + 1) / 3);
  std::string nearest;
  std::size_t least = farthest + 1;
  for (const std::string& candidate : names) {
    const std::size_t distance = doubled_distance(name, candidate);
    if (distance < least && distance < 2 * candidate.size()) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(name, names);
  if (!nearest.empty()) return fmt::format("; did you mean {}?", in_ticks(nearest));
  if (names.empty()) return "";
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kLongestList); ++i)
    list += (i == 0 ? "" : ", ") + in_ticks(names[i]);
  if (names.size() > kLongestList) list += ", ...";
  return (names.size() == 1 ? "; expected " : "; expected one of ") + list;
}

}  // namespace articular::sim
