// Which bodies can meet, and what acts between them.
#include <algorithm>
#include <map>
#include <utility>

#include "sim/scenario/name_pattern.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

/// Entries that go by patterns: ContactPairs keeps a bit for each.
constexpr int kMostPatterns = 64;

/// Friction, which acts on velocities.
void read_friction(const TableReader& table, Scenario::Analysis analysis, ContactPair& pair) {
  table.read("friction", pair.friction);
  table.read("slip_velocity", pair.slip_velocity);
  if (!(pair.friction > 0)) table.refuse({"slip_velocity"}, "there is no friction");
  if (pair.friction > 0 && analysis == Scenario::Analysis::Static)
    fail(*table.find("friction"),
         "needs a dynamic analysis: in a static one nothing has a velocity");
}

/// By its name, or the pattern of names that some body fits which can touch something.
std::string read_touching_bodies(const Node& node, const Context& context) {
  std::string written = read_text(node);
  if (!is_pattern(written)) return read_touching_body(node, context).name;
  const bool any = std::any_of(context.bodies.begin(), context.bodies.end(), [&](const Body& body) {
    return fits(written, body.name) && has_surface(body) && body.collides;
  });
  if (!any)
    fail(node, fmt::format("no body that can touch something has a name like `{}`; `*` stands for "
                           "any characters",
                           one_line(written)));
  return written;
}

/// Of a body with itself, or of all tissues that fit a pattern.
std::vector<ContactPair> read_self_contacts(const Node& node, const Context& context) {
  const std::string written = read_touching_bodies(node, context);
  std::vector<ContactPair> pairs;
  for (const Body& body : context.bodies) {
    if (!fits(written, body.name)) continue;
    if (body.kind == Body::Kind::Tissue && body.collides) {
      pairs.push_back({body.name, body.name, {}});
    } else if (!is_pattern(written)) {
      fail(node, fmt::format("only tissue can touch itself, body `{}` is rigid", body.name));
    }
  }
  if (pairs.empty())
    fail(node, fmt::format("only tissue can touch itself, and none has a name like `{}`",
                           one_line(written)));
  return pairs;
}

ContactPair read_two_bodies(const Node& node, const Context& context) {
  const Node::List& list = read_list(node, "the names of two bodies", 2);
  ContactPair pair{
      read_touching_bodies(list[0], context), read_touching_bodies(list[1], context), {}};
  if (pair.a == pair.b && !is_pattern(pair.a)) {
    const Body& body = read_body_reference(list[1], context);
    if (body.kind != Body::Kind::Tissue)
      fail(list[1], fmt::format("only tissue can touch itself, body `{}` is rigid", body.name));
  }
  return pair;
}

std::vector<ContactPair> read_contact(const Node& node, const Context& context,
                                      Scenario::Analysis analysis) {
  const TableReader table(node, contact_keys(), "[[contact]]");
  const Node& which = table.exactly_one({"bodies", "self"});
  std::vector<ContactPair> pairs;
  if (table.find("self") != nullptr)
    pairs = read_self_contacts(which, context);
  else
    pairs = {read_two_bodies(which, context)};
  ContactPair law;
  read_friction(table, analysis, law);
  table.read("damping", law.damping);
  for (ContactPair& pair : pairs) {
    law.a = pair.a;
    law.b = pair.b;
    pair = law;
    pair.where = node.where;
  }
  return pairs;
}

}  // namespace

const KeyTable& contact_keys() {
  static const KeyTable kTable{
      "[[contact]]",
      {{"bodies",
        {names_of_bodies(2)},
        otherwise("or `self`"),
        "two bodies that can meet; `*` in a name stands for any characters"},
       {"self",
        {form::Text{"name of a tissue"}},
        otherwise("or `bodies`"),
        "a tissue that can meet itself; `*` as above"},
       {"friction",
        {form::Number{kNotNegative}},
        standard(0.0),
        "Coulomb's coefficient; dynamic only"},
       {"slip_velocity",
        {form::Quantity{kVelocity, kPositive}},
        otherwise("1/20 of an element a second, or in 1000 steps if longer"),
        "friction has 0.71 of its value here. Less creeps less and takes more iterations"},
       {"damping",
        {form::Quantity{kContactDamping, kNotNegative}},
        standard("0 Pa s/m"),
        "pressure per closing velocity; surfaces never pull"}}};
  return kTable;
}

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
    fail(*node, fmt::format("expected true, false or entries that start with [[contact]], found {}",
                            found(*node)));
  std::map<std::pair<std::string, std::string>, Location> places;
  read_each(*node->list(), [&](const Node& element) {
    for (ContactPair& pair : read_contact(element, context, scenario.analysis)) {
      const auto [known, is_new] = places.try_emplace(std::minmax(pair.a, pair.b), element.where);
      if (!is_new)
        throw InputError(element.where,
                         fmt::format("[[contact]]: the pair `{}`, `{}` is given twice, first at {}",
                                     pair.a, pair.b, place_text(known->second)));
      scenario.contacts.push_back(std::move(pair));
    }
  });
  const auto num_patterns = std::count_if(
      scenario.contacts.begin(), scenario.contacts.end(),
      [](const ContactPair& pair) { return is_pattern(pair.a) || is_pattern(pair.b); });
  if (num_patterns > kMostPatterns)
    fail(*node, fmt::format("expected at most {} entries with `*`, found {}", kMostPatterns,
                            num_patterns));
}

}  // namespace articular::sim
