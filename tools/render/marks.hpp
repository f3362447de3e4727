#pragma once

#include <string>
#include <vector>

#include "fem/base/types.hpp"
#include "tools/render/colour_map.hpp"

namespace articular::tools {

/// Drawn over a frame, in world coordinates of the frame.
struct Marks {
  struct Points {
    std::vector<Vec3> at;
    Rgb colour;
  };
  struct Label {
    Vec3 at;
    std::string text;
  };
  std::vector<Points> points;
  std::vector<Label> labels;
  std::string legend;
};

}  // namespace articular::tools
