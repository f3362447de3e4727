#include "tools/fit/missed_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace articular::tools {
namespace {

std::string in_words(double spreads) {
  return std::abs(spreads) < 100 ? fmt::format("{:.1f}", spreads) : fmt::format("{:.0f}", spreads);
}

}  // namespace

std::string missed_text(std::vector<TargetMisfit> misfits) {
  std::erase_if(misfits, [](const TargetMisfit& m) { return std::abs(m.spreads) <= kMissed; });
  std::stable_sort(misfits.begin(), misfits.end(),
                   [](const TargetMisfit& a, const TargetMisfit& b) {
                     return std::abs(a.spreads) > std::abs(b.spreads);
                   });
  std::string text;
  for (const TargetMisfit& m : misfits)
    text +=
        fmt::format("{}{} by {} spreads", text.empty() ? "" : ", ", m.name, in_words(m.spreads));
  return text;
}

void warn_of_missed(const std::string& missed) {
  if (!missed.empty()) fmt::print(stderr, "articular: warning: missed: {}\n", missed);
}

std::string missed_paragraph(const std::string& missed) {
  return missed.empty() ? "" : fmt::format("\n**Missed**: {}.\n", missed);
}

}  // namespace articular::tools
