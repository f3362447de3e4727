#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "tools/render/clip.hpp"
#include "tools/render/paper.hpp"

namespace articular::tools {

/// How a scene is drawn, whatever it shows.
struct Look {
  Paper paper;
  bool mesh_edges = false;
  bool fibres = false;                    // on the surface of tissue
  std::map<std::string, double> opacity;  // of parts, where it is not the usual one
  std::optional<Clip> clip;
};

/// @throws InputError for an opacity out of range, and one of no body of these
void check_opacity(const std::map<std::string, double>& opacity,
                   const std::set<std::string>& bodies);

}  // namespace articular::tools
