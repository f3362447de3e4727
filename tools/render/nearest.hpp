#pragma once

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace articular::tools {

/// Levenshtein's distance: insertions, deletions and replacements that make b of a.
inline std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

/// "unknown field `von_mies`, did you mean `von_mises`? There are: displacement, von_mises"
inline std::string unknown_name(const std::string& kind, const std::string& name,
                                const std::set<std::string>& known) {
  std::string text = "unknown " + kind + " `" + name + "`";
  if (known.empty()) return text + "; there is none";
  const std::string& nearest =
      *std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
        return edit_distance(name, a) < edit_distance(name, b);
      });
  const bool close = edit_distance(name, nearest) <= std::max<std::size_t>(2, name.size() / 2);
  text +=
      close && name.size() > 2 ? ", did you mean `" + nearest + "`? There are: " : "; there are: ";
  for (const std::string& one : known) text += (one == *known.begin() ? "" : ", ") + one;
  return text;
}

}  // namespace articular::tools
