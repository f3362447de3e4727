#pragma once

#include <array>
#include <filesystem>
#include <random>
#include <string>

#include "sim/base/error.hpp"
#include "sim/mesh/mesh_io.hpp"

namespace articular::sim {

/// Up to three damages: bytes changed, removed, doubled or cut off; numbers replaced by large ones.
inline std::string damaged(std::string text, std::mt19937& random) {
  for (unsigned k = 0; k <= random() % 3; ++k) {
    const std::size_t at = random() % text.size(), length = random() % 20;
    switch (random() % 5) {
      case 0:
        text[at] = static_cast<char>(random() & 0xff);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.resize(at + 1);
        break;
      default:
        if (const std::size_t digit = text.find_first_of("0123456789", at);
            digit != std::string::npos)
          text.replace(digit, 1, std::array{"4294967297", "-1", "1e308", "99"}[random() % 4]);
    }
    if (text.empty()) text = " ";
  }
  return text;
}

/// What is wrong with a mesh file, "" if nothing is.
inline std::string refusal(const std::filesystem::path& file) {
  try {
    read_mesh(file, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace articular::sim
