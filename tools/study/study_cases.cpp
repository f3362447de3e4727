#include "tools/study/study_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "sim/base/error.hpp"
#include "sim/base/message_text.hpp"

namespace articular::tools {
namespace {

constexpr const char* kAsItIs = "as it is";
constexpr std::size_t kLongestFolder = 100;
constexpr std::size_t kMostCases = 10000;  // each is a run

std::string name_of(const StudyKnob& knob, const StudyKnob::Choice& choice) {
  return knob.name + " = " + choice.name;
}

std::vector<StudyCase> one_at_a_time(const Study& study) {
  std::vector<StudyCase> cases{{kAsItIs, "", study.settings}};
  for (const StudyKnob& knob : study.knobs)
    for (const StudyKnob::Choice& choice : knob.choices)
      cases.push_back({name_of(knob, choice), "", study.settings + choice.settings});
  return cases;
}

void refuse_too_many(const Study& study, double count) {
  if (count <= static_cast<double>(kMostCases)) return;
  throw sim::InputError(
      {study.file.string()},
      fmt::format("the knobs make {:g} cases; expected {} at most", count, kMostCases));
}

std::vector<StudyCase> every_combination(const Study& study) {
  double count = 1;
  for (const StudyKnob& knob : study.knobs) count *= static_cast<double>(knob.choices.size());
  refuse_too_many(study, count);
  std::vector<StudyCase> cases{{"", "", study.settings}};
  for (const StudyKnob& knob : study.knobs) {
    std::vector<StudyCase> more;
    for (const StudyCase& so_far : cases)
      for (const StudyKnob::Choice& choice : knob.choices)
        more.push_back({so_far.name + (so_far.name.empty() ? "" : ", ") + name_of(knob, choice), "",
                        so_far.settings + choice.settings});
    cases = std::move(more);
  }
  if (study.knobs.empty()) cases[0].name = kAsItIs;
  return cases;
}

std::string folder_name(const std::string& name) {
  std::string folder;
  for (const char c : name.substr(0, kLongestFolder)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (plain)
      folder += c;
    else if (!folder.empty() && folder.back() != '_')
      folder += '_';
  }
  return folder;
}

}  // namespace

void name_folders(std::vector<StudyCase>& cases) {
  std::set<std::string> taken;  // letter case does not tell folders apart everywhere
  std::map<std::string, int> last_number;
  const auto lower = [](std::string text) {
    for (char& letter : text)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return text;
  };
  for (StudyCase& c : cases) {
    const std::string wanted = folder_name(c.name);
    int& last = last_number.try_emplace(lower(wanted), 1).first->second;
    for (c.folder = wanted; !taken.insert(lower(c.folder)).second;)
      c.folder = fmt::format("{}-{}", wanted, ++last);
  }
}

std::vector<StudyCase> study_cases(const Study& study) {
  std::vector<StudyCase> cases =
      study.every_combination ? every_combination(study) : one_at_a_time(study);
  for (const StudyExtra& extra : study.extras)
    cases.push_back({extra.name, "", study.settings + extra.settings});
  for (std::size_t i = 0; i < study.references.size(); ++i) {
    const StudyReference& reference = study.references[i];
    cases.push_back({study.references.size() == 1 ? std::string("reference")
                                                  : fmt::format("reference {}", reference.size),
                     "", study.settings + reference.settings, static_cast<int>(i)});
  }
  refuse_too_many(study, static_cast<double>(cases.size()));
  std::set<std::string> names;
  for (const StudyCase& c : cases)
    if (!names.insert(c.name).second)
      throw sim::InputError(
          {study.file.string()},
          fmt::format("two cases are called `{}`; expected different names of knobs, choices and "
                      "cases",
                      sim::one_line(c.name)));
  name_folders(cases);
  return cases;
}

}  // namespace articular::tools
