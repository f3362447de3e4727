#include "tools/study/history_columns.hpp"

namespace articular::tools {

sim::KeyType history_columns() {
  const sim::KeyType column = {sim::form::Text{"column of history.csv"}};
  return {sim::form::Either{{{column}, {sim::list_of(column)}}}};
}

std::vector<std::string> read_history_columns(const sim::Node& node) {
  if (node.text() != nullptr) return {sim::read_text(node)};
  std::vector<std::string> columns;
  for (const sim::Node& element :
       sim::read_list(node, "a column of history.csv, or a list of them"))
    columns.push_back(sim::read_text(element));
  return columns;
}

}  // namespace articular::tools
