#include "tools/keys/key_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "tools/keys/key_words.hpp"

namespace articular::tools {
namespace {

constexpr std::size_t kLineWidth = 95;  // of a terminal

/// The part of a link behind `#`, as GitHub and GitLab make it of a heading.
std::string anchor(std::string_view heading) {
  std::string text;
  for (const char c : heading)
    if (c == ' ')
      text += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Replaces "<section>" in a text.
template <class Replace>
std::string with_sections(std::string_view text, const Replace& replace) {
  std::string result;
  for (std::size_t start; (start = text.find('<')) != std::string_view::npos;) {
    const std::size_t end = text.find('>', start);
    if (end == std::string_view::npos) break;
    result += text.substr(0, start);
    result += replace(text.substr(start + 1, end - start - 1));
    text.remove_prefix(end + 1);
  }
  return result + std::string(text);
}

std::string with_links(const std::string& text) {
  return with_sections(text, [](std::string_view name) {
    return fmt::format("[{}](#{})", without_brackets(name), anchor(name));
  });
}

std::string plain(const std::string& text) {
  std::string result =
      with_sections(text, [](std::string_view name) { return without_brackets(name); });
  std::erase(result, '`');
  return result;
}

/// The words of a tag with which there is such a key: "all", "`linear`, `yeoh`", "all but `joint`".
std::string words_with(const KeyRow& row, const KeySection& section) {
  if (row.with.empty()) return "all";
  std::vector<std::string_view> without;
  for (const auto& [word, keys] : section.variants->by_word)
    if (std::find(row.with.begin(), row.with.end(), word) == row.with.end())
      without.push_back(word);
  if (without.size() < row.with.size() / 2)
    return fmt::format("all but `{}`", fmt::join(without, "`, `"));
  return fmt::format("`{}`", fmt::join(row.with, "`, `"));
}

bool is_tag(const sim::Key& key, const KeySection& section) {
  return section.variants != nullptr && key.name == section.variants->tag;
}

std::string default_cell(const sim::Absence& absence) {
  if (absence.is_error) return "";
  const std::string words = absence_words(absence);
  return words.empty() ? "-" : words;
}

/// The words of a tag, and what each is.
std::string variants_as_markdown(const KeySection& section) {
  std::string text = fmt::format("| `{}` | |\n| --- | --- |\n", section.variants->tag);
  for (const auto& [word, keys] : section.variants->by_word)
    text += fmt::format("| `\"{}\"` | {} |\n", word, keys().find(section.variants->tag)->meaning);
  return text + "\n";
}

std::string section_as_markdown(const KeySection& section) {
  const bool has_variants = section.variants != nullptr;
  std::string text = fmt::format("### {}\n\n", section.name);
  if (has_variants) text += variants_as_markdown(section);
  text += fmt::format("| Key | Type | Unit | Range | Default |{} Meaning |\n",
                      has_variants ? fmt::format(" With `{}` |", section.variants->tag) : "");
  text += fmt::format("| --- | --- | --- | --- | --- |{} --- |\n", has_variants ? " --- |" : "");
  for (const KeyRow& row : key_rows(section)) {
    const sim::Key& key = row.key;
    const std::string name = fmt::format("`{}`", key.name), unit = unit_words(key.type);
    text += fmt::format(
        "| {} | {} | {} | {} | {} |{} {} |\n", key.absence.is_error ? "**" + name + "**" : name,
        is_tag(key, section) ? "a word, see above" : with_links(type_words(key.type)),
        unit.empty() ? "" : "`" + unit + "`", range_words(key.type), default_cell(key.absence),
        has_variants ? " " + words_with(row, section) + " |" : "", key.meaning);
  }
  return text + "\n";
}

/// The text in lines of a width, each behind blanks.
std::string wrapped(std::string_view text, std::size_t blanks) {
  std::string result, line;
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, space);
    if (!line.empty() && blanks + line.size() + 1 + word.size() > kLineWidth) {
      result += std::string(blanks, ' ') + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + std::string(word);
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  return result + std::string(blanks, ' ') + line + "\n";
}

std::string row_as_text(const KeyRow& row, const KeySection& section) {
  const sim::Key& key = row.key;
  std::string facts = plain(type_words(key.type));
  const std::string unit = unit_words(key.type), range = range_words(key.type),
                    otherwise = plain(absence_words(key.absence));
  if (!unit.empty()) facts += fmt::format(", with a unit such as {}", unit);
  if (!range.empty()) facts += ", " + range;
  if (key.absence.is_error)
    facts += "; required";
  else if (otherwise.starts_with("or ") || otherwise.starts_with("required"))
    facts += "; " + otherwise;
  else if (!otherwise.empty())
    facts += "; default: " + otherwise;
  std::string text = fmt::format("  {}\n", key.name) + wrapped(facts, 6) +
                     wrapped(plain(std::string(key.meaning)), 6);
  if (is_tag(key, section)) {
    for (const auto& [word, keys] : section.variants->by_word)
      text += wrapped(plain(fmt::format("{}: {}", word, keys().find(key.name)->meaning)), 8);
  } else if (!row.with.empty()) {
    text += wrapped(
        fmt::format("with {}: {}", section.variants->tag, plain(words_with(row, section))), 6);
  }
  return text;
}

}  // namespace

std::string keys_as_markdown(const std::vector<KeyDocument>& documents) {
  std::string text =
      "# All keys\n\n"
      "`articular keys --markdown` prints this page. It is made from the tables that the program "
      "reads files by.\n\n"
      "- **Bold** keys are required. A dash means \"none\".\n"
      "- A value with a unit is text, such as `\"15 kPa\"`. Any unit of the same dimension will "
      "do. "
      "A vector is one text: `\"0 0 -9.81 m/s^2\"`.\n"
      "- Some rules join several keys. `articular check FILE` tells of those.\n\n";
  for (const KeyDocument& document : documents) {
    text += fmt::format("## {}\n\n{}\n\n", document.title, document.introduction);
    for (const KeySection& section : document.sections) text += section_as_markdown(section);
  }
  text.pop_back();
  return text;
}

std::string keys_as_text(const KeySection& section, std::string_view only) {
  std::string text = section.name + "\n";
  for (const KeyRow& row : key_rows(section))
    if (only.empty() || row.key.name == only) text += row_as_text(row, section);
  return text;
}

std::string keys_in_short(const KeySection& section) {
  std::string keys;
  std::vector<std::string_view> named;
  for (const KeyRow& row : key_rows(section)) {
    if (std::find(named.begin(), named.end(), row.key.name) != named.end()) continue;
    named.push_back(row.key.name);
    keys += fmt::format("{}{}{}", keys.empty() ? "" : ", ", row.key.name,
                        row.key.absence.is_error && row.with.empty() ? "*" : "");
  }
  return section.name + "\n" + wrapped(keys, 6);
}

}  // namespace articular::tools
