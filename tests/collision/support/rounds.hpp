#pragma once

#include "tests/support/address_sanitizer.hpp"

namespace articular::collision::testing {

/// How often a random property is tried. A sanitizer looks at memory, not at verdicts: with it an
/// eighth will do.
inline int rounds(int n) { return has_address_sanitizer() ? n / 8 : n; }

}  // namespace articular::collision::testing
