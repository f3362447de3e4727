#include "tools/verify/problems.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include "sim/base/error.hpp"
#include "tools/verify/contacts.hpp"
#include "tools/verify/laws.hpp"
#include "tools/verify/lines.hpp"
#include "tools/verify/motions.hpp"
#include "tools/verify/repeats.hpp"
#include "tools/verify/solids.hpp"

namespace articular::tools {

std::vector<Problem> all_problems() {
  std::vector<Problem> all;
  for (const auto group : {law_problems, solid_problems, contact_problems, motion_problems,
                           line_problems, repeat_problems})
    for (Problem& problem : group()) all.push_back(std::move(problem));
  return all;
}

std::vector<Problem> chosen(const std::vector<Problem>& problems, const std::string& pattern,
                            bool quick) {
  std::vector<Problem> result;
  std::string names;
  for (const Problem& problem : problems) {
    if (quick && !problem.is_quick) continue;
    names += (names.empty() ? "" : ", ") + problem.name;
    if (::fnmatch(("*" + pattern + "*").c_str(), problem.name.c_str(), 0) == 0)
      result.push_back(problem);
  }
  if (result.empty())
    throw sim::InputError(
        fmt::format("--only: no problem's name has `{}` in it; expected a part "
                    "of one of {}",
                    pattern, names));
  return result;
}

}  // namespace articular::tools
