#include "sim/statics/supports.hpp"

#include <algorithm>
#include <set>

namespace articular::sim {

std::string name_of(const Model& model, SupportChange::Kind kind, ContactId index) {
  if (kind == SupportChange::Kind::Ligament) {
    const LigamentModel& ligament = model.ligaments[static_cast<std::size_t>(index)];
    return "ligament `" + model.lines[static_cast<std::size_t>(ligament.line)].name + "`";
  }
  const ContactModel contact = model.contacts[index];
  const auto body = [&](int b) {
    return "`" + model.bodies[static_cast<std::size_t>(b)].name + "`";
  };
  return "contact of " + body(contact.a) + " and " + body(contact.b);
}

Supports::Supports(const Moment& now) : pulling_(now.model.ligaments.size(), 0) {
  for (const ContactPairState* pair : now.contact.pair_states()) {
    std::vector<char>& pressing = pressing_[pair->contact];
    pressing.assign(static_cast<std::size_t>(pair->pressure.size()), 0);
    for (const int group : pair->groups)
      pressing[static_cast<std::size_t>(group)] = pair->pressure[group] > 0 ? 1 : 0;
  }
  for (std::size_t i = 0; i < pulling_.size(); ++i)
    pulling_[i] =
        now.lines[static_cast<std::size_t>(now.model.ligaments[i].line)].tension > 0 ? 1 : 0;
}

std::vector<SupportChange> Supports::changes_since(const Supports& before) const {
  std::vector<SupportChange> changes;
  std::set<ContactId> contacts;
  for (const auto* pressing : {&before.pressing_, &pressing_})
    for (const auto& [contact, groups] : *pressing) contacts.insert(contact);
  const auto groups_of = [](const Supports& supports, ContactId contact) {
    const auto known = supports.pressing_.find(contact);
    return known == supports.pressing_.end() ? std::vector<char>{} : known->second;
  };
  for (const ContactId contact : contacts) {
    const std::vector<char> was = groups_of(before, contact), is = groups_of(*this, contact);
    SupportChange change{.kind = SupportChange::Kind::Contact, .index = contact};
    for (std::size_t g = 0; g < std::max(was.size(), is.size()); ++g) {
      const bool pressed = g < was.size() && was[g] != 0, presses = g < is.size() && is[g] != 0;
      change.began += presses && !pressed ? 1 : 0;
      change.ceased += pressed && !presses ? 1 : 0;
      change.held |= pressed;
      change.holds |= presses;
    }
    if (change.began + change.ceased > 0) changes.push_back(change);
  }
  for (std::size_t l = 0; l < pulling_.size(); ++l) {
    const bool was = before.pulling_[l] != 0, is = pulling_[l] != 0;
    if (was == is) continue;
    changes.push_back({.kind = SupportChange::Kind::Ligament,
                       .index = static_cast<ContactId>(l),
                       .began = is ? 1 : 0,
                       .ceased = was ? 1 : 0,
                       .held = was,
                       .holds = is});
  }
  return changes;
}

}  // namespace articular::sim
