#include "sim/scenario/scenario_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "sim/scenario/toml_reader.hpp"

namespace articular::sim {
namespace {

/// By choice: the words that some `when` mentions.
using Mentioned = std::map<std::string, std::set<std::string>>;

std::vector<std::string> words_of(const Node& node) {
  constexpr std::string_view kWhat = "a word, or a list of words";
  if (node.text() != nullptr) return {read_text(node)};
  if (node.list() == nullptr) fail(node, fmt::format("expected {}, found {}", kWhat, found(node)));
  std::vector<std::string> words;
  for (const Node& word : read_list(node, kWhat)) words.push_back(read_text(word));
  return words;
}

[[noreturn]] void fail_unknown(const Member& named, const ChosenWords& chosen) {
  std::vector<std::string> names;
  for (const auto& [name, word] : chosen) names.push_back(name);
  throw InputError(named.key_where,
                   names.empty()
                       ? fmt::format("`when`: there is no choice `{}`; expected it in [choice], "
                                     "which the scenario does not have",
                                     one_line(named.key))
                       : fmt::format("`when`: there is no choice `{}`{}", one_line(named.key),
                                     suggestion(named.key, names)));
}

/// Whether an entry is there; notes the words that it mentions.
bool holds(const Node& when, const ChosenWords& chosen, Mentioned& mentioned) {
  const TomlTable* table = when.table();
  if (table == nullptr || table->members.empty())
    fail(when, fmt::format("expected a table of choices such as {{ disc = \"tissue\" }}, found {}",
                           table != nullptr ? "an empty one" : found(when)));
  bool all = true;
  for (const Member& named : table->members) {
    const auto choice = std::find_if(chosen.begin(), chosen.end(), [&](const auto& name_and_word) {
      return name_and_word.first == named.key;
    });
    if (choice == chosen.end()) fail_unknown(named, chosen);
    const std::vector<std::string> words = words_of(named.node);
    mentioned[named.key].insert(words.begin(), words.end());
    all = all && std::find(words.begin(), words.end(), choice->second) != words.end();
  }
  return all;
}

void filter(std::string_view list, Node::List& entries, Choices& choices, Mentioned& mentioned) {
  Node::List kept;
  for (Node& entry : entries) {
    const Node* when = entry.find("when");
    if (when != nullptr) {
      if (!holds(*when, choices.words, mentioned)) {
        if (const Node* name = entry.find("name"); name != nullptr && name->text() != nullptr)
          choices.left_out.push_back({std::string(list), *name->text(), entry.where});
        continue;
      }
      std::erase_if(entry.table()->members,
                    [](const Member& member) { return member.key == "when"; });
    }
    kept.push_back(std::move(entry));
  }
  entries = std::move(kept);
}

void check_mentioned(const Node& choices, const Mentioned& mentioned) {
  for (const Member& choice : choices.table()->members) {
    const auto known = mentioned.find(choice.key);
    if (known == mentioned.end()) {
      std::vector<std::string> names;
      for (const auto& [name, words] : mentioned) names.push_back(name);
      throw InputError(choice.key_where,
                       fmt::format("no `when` mentions the choice `{}`{}", one_line(choice.key),
                                   names.empty() ? "" : suggestion(choice.key, names)));
    }
    std::set<std::string> words = known->second;
    words.insert("off");
    if (words.contains(*choice.node.text())) continue;
    std::string list;
    for (const std::string& word : words)
      list += fmt::format("{}{}", list.empty() ? "" : ", ", in_quotes(word));
    fail(choice.node, fmt::format("no `when` mentions this word; expected one of {}, found {}",
                                  list, found(choice.node)));
  }
}

}  // namespace

Choices apply_choices(Node& document) {
  Choices chosen;
  const Node* choices = document.find("choice");
  if (choices != nullptr && choices->table() == nullptr)
    fail(*choices, fmt::format("expected a table [choice] of words, found {}", found(*choices)));
  if (choices != nullptr)
    for (const Member& choice : choices->table()->members)
      chosen.words.emplace_back(choice.key, read_text(choice.node));
  Mentioned mentioned;
  std::vector<std::string> emptied;
  for (const std::string_view key : kEntryLists) {
    Node* list = document.find(key);
    if (list == nullptr || list->list() == nullptr || list->list()->empty()) continue;
    filter(key, *list->list(), chosen, mentioned);
    if (list->list()->empty()) emptied.emplace_back(key);
  }
  if (choices != nullptr) check_mentioned(*choices, mentioned);
  emptied.emplace_back("choice");
  std::erase_if(document.table()->members, [&](const Member& member) {
    return std::find(emptied.begin(), emptied.end(), member.key) != emptied.end();
  });
  return chosen;
}

bool sets_a_choice(const Override& change) { return change.path.front() == "choice"; }

}  // namespace articular::sim
