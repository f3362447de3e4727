#include "tools/import/febio_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_sets.hpp"

namespace articular::tools {
namespace {

using BodyPairs = std::set<std::pair<std::string, std::string>>;

const ImportedBody* body_of(const ScenarioDraft& draft, const sim::MeshSet& surface) {
  const auto found = std::find_if(draft.bodies.begin(), draft.bodies.end(),
                                  [&](const ImportedBody& body) { return has_all(body, surface); });
  return found != draft.bodies.end() ? &*found : nullptr;
}

void add_tie(ScenarioDraft& draft, const FebioContact& contact, const ImportedBody& a,
             const sim::MeshSet& first, const ImportedBody& b, const sim::MeshSet& second) {
  if (a.is_rigid() == b.is_rigid())
    draft.lose(contact.line,
               fmt::format("the tie of {} and {}: only a tissue is tied to a rigid body",
                           sim::in_ticks(a.name), sim::in_ticks(b.name)));
  else if (b.is_rigid())
    attach(draft, a, b.name, first);
  else
    attach(draft, b, a.name, second);
}

void add_sliding(ScenarioDraft& draft, BodyPairs& pairs, const FebioContact& contact,
                 const ImportedBody& a, const ImportedBody& b) {
  if (!pairs.insert({std::min(a.name, b.name), std::max(a.name, b.name)}).second) return;
  TomlEntry entry("[[contact]]");
  if (&a == &b)
    entry.add("self", toml_text(a.name));
  else
    entry.add("bodies", fmt::format("[{}, {}]", toml_text(a.name), toml_text(b.name)));
  if (contact.friction > 0 && draft.model.is_dynamic)
    entry.add("friction", fmt::format("{}", contact.friction));
  else if (contact.friction > 0)
    draft.lose(contact.line, "friction: in a static analysis nothing has a velocity");
  draft.text += entry.text();
  draft.probes += TomlEntry("[[probe]]")
                      .add("name", toml_text(new_name(draft, a.name + " on " + b.name)))
                      .add("kind", "\"contact\"")
                      .add("bodies", fmt::format("[{}, {}]", toml_text(b.name), toml_text(a.name)))
                      .text();
}

}  // namespace

bool add_contacts(ScenarioDraft& draft) {
  BodyPairs pairs;
  for (const FebioContact& contact : draft.model.contacts) {
    const sim::MeshSet& first = *set_called(draft, contact.first, contact.line);
    const sim::MeshSet& second = *set_called(draft, contact.second, contact.line);
    const ImportedBody *const a = body_of(draft, first), *const b = body_of(draft, second);
    if (a == nullptr || b == nullptr)
      draft.lose(contact.line,
                 fmt::format("contact of {} and {}: they are not surfaces of two bodies",
                             sim::in_ticks(first.name), sim::in_ticks(second.name)));
    else if (contact.type.starts_with("tied"))
      add_tie(draft, contact, *a, first, *b, second);
    else
      add_sliding(draft, pairs, contact, *a, *b);
  }
  return !pairs.empty();
}

}  // namespace articular::tools
