#pragma once

#include <string_view>

namespace articular::sim {

/// The dotted key with most parts, those of the keys around it counted too.
struct KeyDepth {
  int parts = 0;  // 0: no key has a dot
  int line = 0;
};

/// `a.b = { c = [{ d.e = 1 }] }` has 5. Dots in texts and comments do not count; a number with a
/// dot counts as a key of two parts. The parser goes into each part of a key by recursion, and so
/// does who copies its tree, so that many thousand parts overflow the stack: such a text must not
/// come to them.
KeyDepth deepest_key(std::string_view toml);

}  // namespace articular::sim
