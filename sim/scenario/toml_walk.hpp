#pragma once

#include "sim/scenario/toml_document.hpp"

namespace articular::sim {

/// visit(node) for a tree and all that is in it.
template <class Visit>
void for_each_node(const Node& node, const Visit& visit) {
  visit(node);
  if (const TomlTable* table = node.table())
    for (const Member& member : table->members) for_each_node(member.node, visit);
  if (const Node::List* list = node.list())
    for (const Node& entry : *list) for_each_node(entry, visit);
}

}  // namespace articular::sim
