#pragma once

#include <string>
#include <vector>

namespace articular::tools {

/// A target that is off by more of its spreads than this is missed: that is no scatter. It
/// contradicts others, can't be reached, or has the wrong sign or unit.
inline constexpr double kMissed = 5;

struct TargetMisfit {
  std::string name;    // as a user finds it: "`bite` at 0.5 s"
  double spreads = 0;  // too large: > 0
};

/// Those that are missed, in words, largest first; "" where none is.
std::string missed_text(std::vector<TargetMisfit> misfits);

/// Tells of them on stderr, also where progress is not wanted. @param missed  of missed_text()
void warn_of_missed(const std::string& missed);

/// The same as a paragraph of Markdown; "" where none is.
std::string missed_paragraph(const std::string& missed);

}  // namespace articular::tools
