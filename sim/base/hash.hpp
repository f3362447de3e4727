#pragma once

#include <cstdint>
#include <string_view>

namespace articular::sim {

inline constexpr std::uint64_t kHashOfNothing = 14695981039346656037ULL;

/// FNV-1a, 64 bits: a plain hash is enough to notice damage and mix-ups.
/// @param so_far  of what stands before the bytes
inline std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t so_far = kHashOfNothing) {
  for (const char byte : bytes)
    so_far = (so_far ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return so_far;
}

}  // namespace articular::sim
