#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/toml_document.hpp"
#include "sim/scenario/toml_override.hpp"

namespace articular::sim {

/// The words of [choice], by name: {"disc", "rigid"}.
using ChosenWords = std::vector<std::pair<std::string, std::string>>;

/// An entry that the choices leave out.
struct LeftOut {
  std::string list, name;  // "body", "disc_left"
  Location where;
};

struct Choices {
  ChosenWords words;
  std::vector<LeftOut> left_out;  // those that have a name
};

/// Takes out of the document what its choices leave out: each entry of an array of tables may have
///
///   when = { disc = "tissue" }     or     when = { disc = ["rigid", "coarse"], load = "bite" }
///
/// and is there only if every choice that it names has that word, or one of these. What is left has
/// no `when`, and the document no [choice]: nobody else knows of them.
/// @throws InputError  for a choice that does not exist, and a word that no `when` mentions
Choices apply_choices(Node& document);

/// Whether it sets a choice: that has to be done before they are applied, all others after it, so
/// that a name means the entry that is there.
bool sets_a_choice(const Override& change);

}  // namespace articular::sim
