#include "sim/build/tie_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "fem/mesh/mesh_parts.hpp"
#include "sim/base/error.hpp"
#include "sim/base/place_text.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// Nodes of a patch, and the most that are thought to be tied by mistake beside one.
constexpr std::size_t kPatch = 8, kStray = 2;

/// Nodes that are tied to a bone, as patches: nodes of a tetrahedron lie in one.
std::vector<std::vector<int>> patches(const Tissue& tissue, int rigid) {
  const auto is_tied = [&](int node) {
    return tissue.nodes[static_cast<std::size_t>(node)].rigid == rigid;
  };
  Tetrahedra tets = tissue.elements.tets();
  for (auto tet : tets.colwise()) {  // free nodes connect nothing
    const auto tied = std::find_if(tet.begin(), tet.end(), is_tied);
    const int stands_in = tied == tet.end() ? tet(0) : *tied;
    for (int& node : tet)
      if (!is_tied(node)) node = stands_in;
  }
  const std::vector<int> part = fem::parts_of_nodes(static_cast<int>(tissue.nodes.size()), tets);
  std::map<int, std::vector<int>> of_part;
  for (int node = 0; node < static_cast<int>(part.size()); ++node)
    if (is_tied(node)) of_part[part[static_cast<std::size_t>(node)]].push_back(node);
  std::vector<std::vector<int>> all;
  all.reserve(of_part.size());
  for (auto& [first, nodes] : of_part) all.push_back(std::move(nodes));
  return all;
}

std::string doubt(const Attachment& tie, const Tissue& tissue, int rigid) {
  const std::vector<std::vector<int>> all = patches(tissue, rigid);
  const auto size = [](const std::vector<int>& patch) { return patch.size(); };
  if (all.empty()) return "";
  const std::size_t most = size(*std::ranges::max_element(all, {}, size));
  const auto stray =
      std::ranges::find_if(all, [&](const auto& patch) { return patch.size() <= kStray; });
  if (most < kPatch || stray == all.end()) return "";
  return prefix(tie.where) +
         fmt::format(
             "`near` ties {} of `{}` to `{}` apart from a patch of {}, at {}: is it meant "
             "to be held there? A smaller distance, or a `box` as well, leaves it out",
             stray->size() == 1 ? "a node" : "two nodes", tie.body, tie.to, most,
             place_text(tissue.X.col(stray->front())));
}

}  // namespace

std::vector<std::string> tie_doubts(const Scenario& scenario, const Model& model) {
  std::map<std::pair<int, int>, std::vector<const Attachment*>> ties;
  for (const Attachment& tie : scenario.attachments)
    ties[{body_index(scenario, tie.body), body_index(scenario, tie.to)}].push_back(&tie);
  std::vector<std::string> doubts;
  for (const auto& [bodies, all] : ties) {
    // Whoever names a place by its corners means it.
    if (!std::ranges::all_of(all,
                             [](const auto* tie) { return tie->region.near_body.has_value(); }))
      continue;
    const BodyModel& tissue = model.bodies[static_cast<std::size_t>(bodies.first)];
    const BodyModel& bone = model.bodies[static_cast<std::size_t>(bodies.second)];
    std::string line =
        doubt(*all.front(), model.tissues[static_cast<std::size_t>(tissue.tissue)], bone.rigid);
    if (!line.empty()) doubts.push_back(std::move(line));
  }
  return doubts;
}

}  // namespace articular::sim
