#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/assembly/moment.hpp"

namespace articular::sim {

/// How a contact or a ligament changed from one iterate to the next.
struct SupportChange {
  enum class Kind { Contact, Ligament };
  Kind kind = Kind::Contact;
  ContactId index = 0;  // the contact, or index into Model::ligaments
  int began = 0;        // nodes that press now and did not before; of a ligament 1: it is taut
  int ceased = 0;       // nodes that pressed and do not now; of a ligament 1: it is slack
  bool held = false;    // it carried anything before,
  bool holds = false;   // and now
  bool flips() const { return held != holds; }
};

/// "contact of `a` and `b`", "ligament `acl`".
std::string name_of(const Model& model, SupportChange::Kind kind, ContactId index);

/// What holds bodies in their places at one moment and may cease to: contacts that press, and
/// ligaments that pull. Where Newton's iteration does not settle, these go to and fro.
class Supports {
 public:
  explicit Supports(const Moment& now);
  /// Contacts first, in the order of the model.
  std::vector<SupportChange> changes_since(const Supports& before) const;

 private:
  std::map<ContactId, std::vector<char>> pressing_;  // of those near, by smoothing group
  std::vector<char> pulling_;                        // by ligament
};

}  // namespace articular::sim
