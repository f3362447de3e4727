#include "tools/study/case_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace articular::tools {
namespace {

/// Without digits, and what stands among them.
std::string kind_of(std::string text) {
  std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
  return text;
}

std::vector<std::string> warnings_in(const std::filesystem::path& summary) {
  std::ifstream stream(summary);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  try {
    return json.at("warnings").get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

std::string count_text(const CaseWarning& warning, std::size_t num_cases) {
  return fmt::format("{} of {} runs", warning.num_cases, num_cases);
}

}  // namespace

CaseWarnings case_warnings(const std::vector<StudyCase>& cases,
                           const std::vector<CaseRecord>& records,
                           const std::filesystem::path& directory) {
  CaseWarnings found{{}, cases.size()};
  std::map<std::string, std::size_t> place;  // among them, by kind
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (!records[i].succeeded()) continue;
    std::set<std::string> counted;
    for (const std::string& text : warnings_in(results_of(directory, cases[i]) / "summary.json")) {
      const std::string kind = kind_of(text);
      if (!counted.insert(kind).second) continue;
      const auto [known, is_new] = place.try_emplace(kind, found.kinds.size());
      if (is_new) found.kinds.push_back({text, cases[i].name});
      ++found.kinds[known->second].num_cases;
    }
  }
  return found;
}

std::string warnings_table(const CaseWarnings& warnings) {
  if (warnings.kinds.empty()) return "";
  std::string text = "\n| Warned of | in | first in |\n| --- | --- | --- |\n";
  for (const CaseWarning& warning : warnings.kinds) {
    std::string words = warning.text;
    std::replace(words.begin(), words.end(), '|', '/');
    text += fmt::format("| {} | {} | {} |\n", words, count_text(warning, warnings.num_cases),
                        warning.case_name);
  }
  return text;
}

void tell_warnings(const CaseWarnings& warnings) {
  for (const CaseWarning& warning : warnings.kinds)
    fmt::print(stderr, "articular: warning: in {}, first in `{}`: {}\n",
               count_text(warning, warnings.num_cases), warning.case_name, warning.text);
}

}  // namespace articular::tools
