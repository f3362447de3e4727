#pragma once

#include <string>

#include "tools/render/colour_map.hpp"

namespace articular::tools {

/// What a picture is drawn on, and the colour of text and lines that can be read on it.
struct Paper {
  Rgb ground = {1, 1, 1};
  Rgb ink = {0.10, 0.12, 0.15};
  bool transparent = false;
};

/// @param name  "white", "black", "transparent" or a colour by its name in CSS, as "lightgray"
/// @throws InputError for another one
Paper paper_of(const std::string& name);

}  // namespace articular::tools
