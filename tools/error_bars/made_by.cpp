#include "tools/error_bars/made_by.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tools/study/study_prepare.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

/// Splits a command as a shell would, quotes and ${NAME} but nothing else.
std::vector<std::string> words_of_command(const std::string& text) {
  std::vector<std::string> words;
  bool is_open = false;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == 0 && (c == ' ' || c == '\t')) {
      is_open = false;
      continue;
    }
    if (!is_open) words.emplace_back();
    is_open = true;
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (const std::size_t end = text.find('}', i);
               text.compare(i, 2, "${") == 0 && end != std::string::npos) {
      const char* value = std::getenv(text.substr(i + 2, end - i - 2).c_str());
      if (value != nullptr) words.back() += value;
      i = end;
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// `--size=2` as `--size 2`.
std::vector<std::string> split_options(const std::vector<std::string>& words) {
  std::vector<std::string> split;
  for (const std::string& word : words) {
    const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
    split.push_back(word.substr(0, equals));
    if (equals != std::string::npos) split.push_back(word.substr(equals + 1));
  }
  return split;
}

/// The word with the value of an option; 0: it is not there.
std::size_t value_word(const std::vector<std::string>& words, const std::string& option) {
  const auto at = std::find(words.begin(), words.end(), option);
  return words.end() - at > 1 ? static_cast<std::size_t>(at - words.begin()) + 1 : 0;
}

}  // namespace

std::optional<MeshCommand> mesh_command(const std::string& made_by) {
  std::vector<std::string> words = split_options(words_of_command(made_by));
  if (words.size() < 2 || fs::path(words[0]).filename() != "articular") return {};
  words.erase(words.begin());
  if (words[0] != "anatomy" && words[0] != "mesh") return {};
  const MeshCommand command{words, value_word(words, "--size"), value_word(words, "--out")};
  if (command.size_word == 0 || command.out_word == 0) return {};
  if (!(std::strtod(words[command.size_word].c_str(), nullptr) > 0)) return {};
  return command;
}

std::vector<std::string> resized_arguments(const MeshCommand& command, double factor) {
  std::vector<std::string> words = command.words;
  std::string& size = words[command.size_word];
  char* rest = nullptr;
  const double number = std::strtod(size.c_str(), &rest);
  size = fmt::format("{:.6g}{}", factor * number, rest);
  const std::string place = fmt::format("${{{}}}", kPrepared);
  std::string& out = words[command.out_word];
  out = words[0] == "mesh" ? place + "/" + fs::path(out).filename().string() : place;
  return words;
}

}  // namespace articular::tools
