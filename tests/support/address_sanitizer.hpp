#pragma once

// Of the sanitizer's own library, where the program is linked with it.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming): so it calls itself
extern "C" void __asan_init() __attribute__((weak));

namespace articular {

/// Memory then is not what it is without: its malloc tells nothing and keeps what was freed. Known
/// when the program runs only, as the same objects are linked with and without.
inline bool has_address_sanitizer() { return __asan_init != nullptr; }

}  // namespace articular
