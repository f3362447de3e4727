#include "tests/fuzz/toml_mutator.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace articular::fuzz {
namespace {

/// Of a text.
struct Span {
  std::size_t begin = 0, end = 0;

  std::string of(std::string_view text) const {
    return std::string(text.substr(begin, end - begin));
  }
};
using Spans = std::vector<Span>;

constexpr const char* kValues[] = {
    // clang-format off
    "0", "-1", "1", "2147483647", "2147483648", "-9223372036854775808", "9223372036854775807",
    "0.0", "-0.0", "1e-320", "1e308", "-1e308", "inf", "nan", "0x7fffffff", "true", "false",
    "\"\"", "\" \"", "\"\\u0000\"", "\"../..\"", "\"/dev/null\"", "\"${HOME}\"", "\"${\"",
    "\"1e308 m\"", "\"0 mm\"", "\"-1 kg\"", "\"nan s\"", "\"1e-320 s\"", "\"1 1 mm\"",
    "\"0 0 0 mm\"", "\"1e308 -1e308 1 m\"", "\"1 Pa*m^2/m^2\"", "[]", "[[]]", "{}",
    "[0, 0, 0]", "[1e308, 1e308, 1e308]", "[1, \"1 mm\", true]", "{ x = 1 }",
    "1979-05-27T07:32:00Z", "07:32:00", "''' '''", "\"\"\"\n\"\"\""};
constexpr const char* kNumbers[] = {"0", "-1", "1", "2", "1e-320", "1e-9", "1e9", "1e308", "-1e308",
                                    "nan", "inf", "2147483648", "99999999999999999999", "1e999"};
constexpr const char* kUnits[] = {"m", "mm", "s", "ms", "kg", "g/cm^3", "N", "kPa", "deg", "rad/s",
                                  "N/m", "1/s", "m/s^2", "Pa s/m", "K", "mm^", "mm/0", "m^99", ""};
// clang-format on

template <class List>
const auto& any_of(const List& list, std::mt19937& random) {
  return list[random() % std::size(list)];
}

/// Behind the text in quotes that begins at `at`; at least one character on.
std::size_t behind_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

/// Behind the value that begins at `at`: at a comma, bracket, comment or end of line that is not
/// within it.
std::size_t behind_value(std::string_view text, std::size_t at) {
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_quotes(text, at);
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && --depth < 0) return at;
    if (depth == 0 && (c == ',' || c == '\n' || c == '#')) return at;
    ++at;
  }
  return at;
}

Span trimmed(std::string_view text, Span span) {
  const auto is_blank = [&](std::size_t i) { return text[i] == ' ' || text[i] == '\t'; };
  while (span.begin < span.end && is_blank(span.begin)) ++span.begin;
  while (span.begin < span.end && is_blank(span.end - 1)) --span.end;
  return span;
}

/// Calls visit(place) for each `=`, `[` and `,` that stands outside of texts and comments.
template <class Visit>
void for_each_mark(std::string_view text, Visit visit) {
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_quotes(text, at);
    } else if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else {
      if (c == '=' || c == '[' || c == ',') visit(at);
      ++at;
    }
  }
}

/// Values of keys and elements of lists.
Spans values_in(std::string_view text) {
  Spans values;
  for_each_mark(text, [&](std::size_t at) {
    const Span value = trimmed(text, {at + 1, behind_value(text, at + 1)});
    if (value.begin < value.end) values.push_back(value);
  });
  return values;
}

Spans keys_in(std::string_view text) {
  Spans keys;
  for_each_mark(text, [&](std::size_t at) {
    if (text[at] != '=') return;
    std::size_t begin = at;
    while (begin > 0 && std::string_view("\n,{").find(text[begin - 1]) == std::string_view::npos)
      --begin;
    const Span key = trimmed(text, {begin, at});
    if (key.begin < key.end) keys.push_back(key);
  });
  return keys;
}

/// Statements: a key with its value, which may be several lines, or a head of a table.
Spans lines_in(std::string_view text) {
  Spans lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t mark = text.find_first_of("=\n", begin);
    std::size_t end = mark;
    if (mark != std::string_view::npos && text[mark] == '=') end = behind_value(text, mark + 1);
    end = text.find('\n', std::min(end, text.size()));
    end = end == std::string_view::npos ? text.size() : end + 1;
    lines.push_back({begin, end});
    begin = end;
  }
  return lines;
}

/// Heads with what stands below them, and what stands above the first.
Spans tables_in(std::string_view text) {
  Spans tables{{0, 0}};
  for (const Span& line : lines_in(text)) {
    if (text[line.begin] == '[') tables.push_back({line.begin, line.begin});
    tables.back().end = line.end;
  }
  return tables;
}

Spans numbers_in(std::string_view text) {
  Spans numbers;
  constexpr std::string_view kDigits = "0123456789", kRest = "0123456789.eE";
  for (std::size_t at = 0; (at = text.find_first_of(kDigits, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_not_of(kRest, at), text.size());
    numbers.push_back({at, end});
    at = end;
  }
  return numbers;
}

/// What stands behind a number within quotes.
Spans units_in(std::string_view text) {
  Spans units;
  for (const Span& number : numbers_in(text)) {
    const std::size_t end = std::min(text.find_first_of("\"\n", number.end), text.size());
    if (number.end + 1 < end && text[number.end] == ' ') units.push_back({number.end + 1, end});
  }
  return units;
}

std::string replaced(std::string text, const Span& span, const std::string& by) {
  return text.replace(span.begin, span.end - span.begin, by);
}

/// Takes away, doubles, moves in front of another, or puts in one of the other text's.
std::string rearranged(const std::string& text, std::string_view other,
                       Spans (*parts)(std::string_view), std::mt19937& random) {
  const Spans mine = parts(text), theirs = parts(other);
  if (mine.empty()) return text;
  const Span part = any_of(mine, random), place = any_of(mine, random);
  const std::string copy = part.of(text);
  switch (random() % 5) {
    case 0:
      return replaced(text, part, "");
    case 1:
      return std::string(text).insert(place.begin, copy);
    case 2:
      return replaced(text, part, place.of(text));
    case 3: {
      std::string moved = replaced(text, part, "");
      return moved.insert(std::min(place.begin, moved.size()), copy);
    }
    default:
      return theirs.empty()
                 ? text
                 : std::string(text).insert(place.begin, any_of(theirs, random).of(other));
  }
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

/// A value or key of great depth or length.
std::string enlarged(const std::string& part, std::mt19937& random) {
  const std::size_t times = std::size_t{1} << (random() % 8);
  switch (random() % 4) {
    case 0:
      return repeated("[", times) + part + repeated("]", times);
    case 1:
      return repeated("{ x = ", times) + part + repeated(" }", times);
    case 2:
      return "[" + repeated(part + ", ", times) + part + "]";
    default:
      return repeated("x.", times) + part;
  }
}

}  // namespace

std::string changed_toml(const std::string& text, std::string_view other, std::mt19937& random) {
  const auto replace_any = [&](const Spans& places, const auto& by) {
    return places.empty() ? text : replaced(text, any_of(places, random), by());
  };
  const auto any_part = [&](Spans (*parts)(std::string_view)) {
    const std::string_view from = random() % 2 == 0 || other.empty() ? text : other;
    const Spans spans = parts(from);
    return spans.empty() ? std::string() : any_of(spans, random).of(from);
  };
  switch (random() % 9) {
    case 0:
      return rearranged(text, other, tables_in, random);
    case 1:
      return rearranged(text, other, lines_in, random);
    case 2:
      return replace_any(values_in(text), [&] { return std::string(any_of(kValues, random)); });
    case 3:
      return replace_any(values_in(text), [&] { return any_part(values_in); });
    case 4:
      return replace_any(keys_in(text), [&] { return any_part(keys_in); });
    case 5:
      return replace_any(numbers_in(text), [&] { return std::string(any_of(kNumbers, random)); });
    case 6:
      return replace_any(units_in(text), [&] { return std::string(any_of(kUnits, random)); });
    case 7: {
      const Spans values = values_in(text);
      if (values.empty()) return text;
      const Span value = any_of(values, random);
      return replaced(text, value, enlarged(value.of(text), random));
    }
    default:
      return replace_any(keys_in(text),
                         [&] { return any_part(keys_in) + "." + any_part(keys_in); });
  }
}

}  // namespace articular::fuzz
