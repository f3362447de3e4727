#include "tools/manual/completed_value.hpp"

#include <regex>

namespace articular::tools {
namespace {

/// What the pattern's first group has, at each place where the pattern is found.
std::vector<std::string> all_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.push_back(match->str(1));
  return found;
}

bool has_word(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

/// `articular scenarios` prints lines "NAME KIND TITLE".
std::string listing_command(bool studies) {
  return std::string("articular scenarios 2> /dev/null | sed -n '/^[^ ]* *study /") +
         (studies ? "" : "!") + "s/ .*//p'";
}

template <class T>
void append(const std::vector<T>& more, std::vector<T>& list) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

CompletedValue completed_value(const Argument& argument) {
  CompletedValue completed;
  if (argument.value.empty()) return completed;
  if (std::regex_match(argument.value, std::regex("[a-z0-9_-]+(\\|[a-z0-9_-]+)+")))
    completed.words = all_in(argument.value, "([a-z0-9_-]+)");
  if (argument.value == "KEY=VALUE")
    completed.words = {"accuracy=fast", "accuracy=balanced", "accuracy=accurate"};
  completed.folders = has_word(argument.value, "DIR");
  completed.endings = all_in(argument.description, "(?:^|[ (])(\\.[a-z0-9]+)\\b");
  completed.files = completed.endings.empty() && has_word(argument.value, "FILE");
  if (argument.description.find("see `articular scenarios`") != std::string::npos)
    completed.listing = listing_command(argument.names.back() == "study");
  return completed;
}

CompletedValue completed_positional(const Command& command) {
  CompletedValue all;
  for (const Argument& argument : command.positionals) {
    const CompletedValue one = completed_value(argument);
    append(one.words, all.words);
    append(one.endings, all.endings);
    all.files = all.files || one.files;
    all.folders = all.folders || one.folders;
    if (!one.listing.empty()) all.listing = one.listing;
  }
  return all;
}

}  // namespace articular::tools
