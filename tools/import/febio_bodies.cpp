#include "tools/import/febio_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cctype>
#include <set>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_sets.hpp"

namespace articular::tools {
namespace {

bool share_nodes(const ImportedBody& body, const sim::MeshSet& part) { return has_any(body, part); }

void add_part(const sim::MeshSet& part, ImportedBody& body) {
  body.parts.push_back(part.name);
  for (const int node : part.nodes) body.has_node[static_cast<std::size_t>(node)] = 1;
}

void join(const ImportedBody& other, ImportedBody& body) {
  body.parts.insert(body.parts.end(), other.parts.begin(), other.parts.end());
  for (std::size_t i = 0; i < body.has_node.size(); ++i)
    body.has_node[i] = body.has_node[i] != 0 || other.has_node[i] != 0 ? 1 : 0;
}

/// A part joins all bodies of its material that it shares nodes with (rigid ones: all).
void place_part(const sim::MeshSet& part, const FebioMaterial& material, std::size_t num_nodes,
                std::vector<ImportedBody>& bodies) {
  ImportedBody joined{part.name, &material, {}, std::vector<char>(num_nodes)};
  add_part(part, joined);
  for (auto body = bodies.begin(); body != bodies.end();) {
    const bool joins =
        body->material == &material && (joined.is_rigid() || share_nodes(*body, part));
    if (!joins) {
      ++body;
      continue;
    }
    std::swap(*body, joined);  // the earlier one is first, and has the name
    join(*body, joined);
    body = bodies.erase(body);
  }
  bodies.push_back(std::move(joined));
}

void tell_of_common_nodes(const std::vector<ImportedBody>& bodies, std::vector<Loss>& losses) {
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t c = b + 1; c < bodies.size(); ++c) {
      if (bodies[b].is_rigid() || bodies[c].is_rigid()) continue;
      std::size_t common = 0;
      for (std::size_t i = 0; i < bodies[b].has_node.size(); ++i)
        common += bodies[b].has_node[i] != 0 && bodies[c].has_node[i] != 0 ? 1U : 0U;
      if (common > 0)
        losses.push_back(
            {bodies[c].material->element->line,
             fmt::format(
                 "the {} nodes that {} and {} share: one tissue is not tied to another, and "
                 "these two come apart",
                 common, sim::in_ticks(bodies[b].name), sim::in_ticks(bodies[c].name))});
    }
}

void give_names(std::vector<ImportedBody>& bodies) {
  std::set<std::string> names;
  for (ImportedBody& body : bodies) {
    if (body.is_rigid() && !body.material->name.empty()) body.name = body.material->name;
    const std::string name = scenario_name(body.name);
    body.name = name;
    for (int k = 2; !names.insert(body.name).second; ++k) body.name = fmt::format("{} {}", name, k);
  }
}

}  // namespace

std::vector<ImportedBody> bodies_of(const FebioModel& model, const sim::MeshData& mesh,
                                    std::vector<Loss>& losses) {
  std::vector<ImportedBody> bodies;
  for (const FebioPart& part : model.parts) {
    const FebioMaterial* const material = find_material(model, part.material);
    const sim::MeshSet* const set = sim::find_set(mesh, part.name);
    if (material == nullptr || set == nullptr) {
      losses.push_back(
          {part.line, fmt::format("the part {}: it has no {}", sim::in_ticks(part.name),
                                  material == nullptr ? "material" : "elements")});
    } else if (material->type != "rigid body" && set->tets.empty()) {
      losses.push_back({part.line, fmt::format("the part {}: deformable shells and lines",
                                               sim::in_ticks(part.name))});
    } else {
      place_part(*set, *material, static_cast<std::size_t>(mesh.X.cols()), bodies);
    }
  }
  give_names(bodies);
  tell_of_common_nodes(bodies, losses);
  return bodies;
}

std::string scenario_name(const std::string& text) {
  std::string name;
  for (const char c : text)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == ' '
                ? c
                : '_';
  name.erase(0, name.find_first_not_of(' '));
  name.erase(name.find_last_not_of(' ') + 1);
  return name.empty() || name == "lines" ? "body " + name : name;
}

bool has_all(const ImportedBody& body, const sim::MeshSet& set) {
  return !set.nodes.empty() && std::all_of(set.nodes.begin(), set.nodes.end(), [&](int node) {
    return body.has_node[static_cast<std::size_t>(node)] != 0;
  });
}

bool has_any(const ImportedBody& body, const sim::MeshSet& set) {
  return std::any_of(set.nodes.begin(), set.nodes.end(),
                     [&](int node) { return body.has_node[static_cast<std::size_t>(node)] != 0; });
}

Eigen::Vector3d center_of(const ImportedBody& body, const sim::MeshData& mesh) {
  double whole = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto add = [&](double size, const Eigen::Vector3d& middle) {
    whole += size;
    sum += size * middle;
  };
  for (const std::string& part : body.parts) {
    const sim::MeshSet& set = *sim::find_set(mesh, part);
    for (const int t : set.tets) {
      const Eigen::Matrix<double, 3, 4> x = mesh.X(Eigen::all, mesh.tets.col(t));
      const Eigen::Matrix3d edges = x.rightCols<3>().colwise() - x.col(0);
      add(edges.determinant(), x.rowwise().mean());
    }
    if (!set.tets.empty()) continue;
    for (const auto& [a, b, c] : set.faces) {
      const Eigen::Vector3d p = mesh.X.col(a), q = mesh.X.col(b), r = mesh.X.col(c);
      add((q - p).cross(r - p).norm(), (p + q + r) / 3);
    }
  }
  return whole > 0 ? Eigen::Vector3d(sum / whole) : sum;
}

}  // namespace articular::tools
