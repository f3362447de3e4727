#pragma once

#include <map>
#include <optional>
#include <string>

#include "tools/render/clip.hpp"
#include "tools/render/paper.hpp"

namespace articular::tools {

/// How a scene is drawn, whatever it shows.
struct Look {
  Paper paper;
  bool mesh_edges = false;
  std::map<std::string, double> opacity;  // of parts, where it is not the usual one
  std::optional<Clip> clip;
};

}  // namespace articular::tools
