// Which bodies can meet, and what acts between them.
#include <algorithm>

#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

/// Friction, which acts on velocities.
void read_friction(const TableReader& table, Scenario::Analysis analysis, ContactPair& pair) {
  table.may("friction", pair.friction, as_number(kNotNegative));
  table.may("slip_velocity", pair.slip_velocity, as_quantity(kVelocity, kPositive));
  if (!(pair.friction > 0)) table.refuse({"slip_velocity"}, "there is no friction");
  if (pair.friction > 0 && analysis == Scenario::Analysis::Static)
    fail(*table.find("friction"),
         "needs a dynamic analysis: in a static one nothing has a velocity");
}

ContactPair read_contact(const Node& node, const Context& context, Scenario::Analysis analysis) {
  const TableReader table(node, "[[contact]]",
                          {"bodies", "self", "friction", "slip_velocity", "damping"});
  ContactPair pair;
  pair.where = node.where;
  const Node& which = table.exactly_one({"bodies", "self"});
  const bool is_self = table.find("self") != nullptr;
  const Node& first = is_self ? which : read_list(which, "the names of two bodies", 2)[0];
  const Node& second = is_self ? which : (*which.list())[1];
  const Body& a = read_touching_body(first, context);
  const Body& b = read_touching_body(second, context);
  if (&a == &b && a.kind != Body::Kind::Tissue)
    fail(second, fmt::format("only tissue can touch itself, body `{}` is rigid", a.name));
  pair.a = a.name;
  pair.b = b.name;
  read_friction(table, analysis, pair);
  table.may("damping", pair.damping, as_quantity(kContactDamping, kNotNegative));
  return pair;
}

}  // namespace

/// A body that can touch something.
const Body& read_touching_body(const Node& node, const Context& context) {
  const Body& body = read_body_reference(node, context);
  if (!has_surface(body))
    fail(node, fmt::format("body `{}` has no surface that could touch", body.name));
  if (!body.collides) fail(node, fmt::format("body `{}` has collides = false", body.name));
  return body;
}

void read_contacts(const TableReader& document, const Context& context, Scenario& scenario) {
  const Node* node = document.find("contact");
  if (node == nullptr) return;
  if (std::holds_alternative<bool>(node->value)) {
    scenario.contact = read_boolean(*node);
    return;
  }
  if (node->list() == nullptr)
    fail(*node, fmt::format("expected false or entries that start with [[contact]], found {}",
                            found(*node)));
  read_each(*node->list(), [&](const Node& element) {
    ContactPair pair = read_contact(element, context, scenario.analysis);
    for (const ContactPair& other : scenario.contacts)
      if (std::minmax(pair.a, pair.b) == std::minmax(other.a, other.b))
        throw InputError(element.where,
                         fmt::format("[[contact]]: the pair `{}`, `{}` is given twice, first at {}",
                                     pair.a, pair.b, place(other.where)));
    scenario.contacts.push_back(std::move(pair));
  });
}

}  // namespace articular::sim
