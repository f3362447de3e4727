#pragma once

#include <string_view>

namespace articular::sim {

/// The dotted key with most parts.
struct KeyDepth {
  int parts = 0;  // 0: no key has a dot
  int line = 0;
};

/// Dots in texts and comments do not count; a number with a dot counts as a key of two parts. The
/// parser goes into each part of a key by recursion, so that one of many thousand parts overflows
/// its stack: such a text must not come to it.
KeyDepth deepest_key(std::string_view toml);

}  // namespace articular::sim
