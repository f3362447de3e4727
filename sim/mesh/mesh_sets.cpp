#include "sim/mesh/mesh_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/base/message_text.hpp"

namespace articular::sim {
namespace {

constexpr std::size_t kMostNames = 12;  // of a message

/// @param kept  ascending, not empty
void keep_tetrahedra(MeshData& mesh, const std::vector<int>& kept) {
  mesh.tets = mesh.tets(Eigen::all, kept).eval();
  for (auto& [name, values] : mesh.cell_vectors) values = values(Eigen::all, kept).eval();
  mesh.triangles.resize(3, 0);
  std::vector<int> new_tet(static_cast<std::size_t>(kept.back()) + 1, -1);
  for (std::size_t k = 0; k < kept.size(); ++k)
    new_tet[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  for (MeshSet& set : mesh.sets) {
    std::vector<int> left;
    for (const int t : set.tets)
      if (static_cast<std::size_t>(t) < new_tet.size() && new_tet[static_cast<std::size_t>(t)] >= 0)
        left.push_back(new_tet[static_cast<std::size_t>(t)]);
    set.tets = std::move(left);
  }
}

void keep_faces(MeshData& mesh, const std::vector<std::array<int, 3>>& faces) {
  mesh.tets.resize(4, 0);
  mesh.cell_vectors.clear();
  mesh.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f)
    mesh.triangles.col(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  for (MeshSet& set : mesh.sets) set.tets.clear();
}

}  // namespace

const MeshSet* find_set(const MeshData& mesh, const std::string& name) {
  const auto found = std::find_if(mesh.sets.begin(), mesh.sets.end(),
                                  [&](const MeshSet& set) { return set.name == name; });
  return found != mesh.sets.end() ? &*found : nullptr;
}

void add_set_of_points(const std::string& name, const std::vector<double>& values, MeshData& mesh) {
  if (!std::ranges::all_of(values, [](double value) { return value == 0 || value == 1; })) return;
  MeshSet set;
  set.name = name;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == 1) set.nodes.push_back(static_cast<int>(i));
  if (!set.nodes.empty()) mesh.sets.push_back(std::move(set));
}

std::string known_sets(const MeshData& mesh) {
  if (mesh.sets.empty())
    return "; it has no sets at all (formats with sets: Gmsh .msh, Abaqus .inp, FEBio .feb, "
           "Nastran .bdf, Medit .mesh, TetGen .ele; in VTK files point arrays of whole numbers, "
           "0 and 1)";
  std::string names;
  for (std::size_t s = 0; s < std::min(mesh.sets.size(), kMostNames); ++s)
    names += (s == 0 ? "" : ", ") + in_ticks(mesh.sets[s].name);
  if (mesh.sets.size() > kMostNames)
    names += fmt::format(" and {} more", mesh.sets.size() - kMostNames);
  return "; it has " + names;
}

void keep_parts(MeshData& mesh, const std::vector<std::string>& parts) {
  std::vector<int> tets;
  std::vector<std::array<int, 3>> faces;
  for (const std::string& part : parts) {
    const MeshSet* set = find_set(mesh, part);
    if (set == nullptr)
      throw std::invalid_argument(
          fmt::format("the mesh has no set {}{}", in_ticks(part), known_sets(mesh)));
    if (set->tets.empty() && set->faces.empty())
      throw std::invalid_argument(
          fmt::format("the set {} has nodes only; expected one of elements", in_ticks(part)));
    tets.insert(tets.end(), set->tets.begin(), set->tets.end());
    faces.insert(faces.end(), set->faces.begin(), set->faces.end());
  }
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  if (tets.empty())
    keep_faces(mesh, faces);
  else
    keep_tetrahedra(mesh, tets);
}

void renumber_sets(MeshData& mesh, const std::vector<int>& new_index) {
  const auto renumbered = [&](int a) { return new_index[static_cast<std::size_t>(a)]; };
  for (MeshSet& set : mesh.sets) {
    for (int& a : set.nodes) a = renumbered(a);
    std::erase_if(set.nodes, [](int a) { return a < 0; });
    for (auto& face : set.faces)
      for (int& a : face) a = renumbered(a);
    std::erase_if(set.faces,
                  [](const auto& face) { return *std::min_element(face.begin(), face.end()) < 0; });
  }
}

}  // namespace articular::sim
