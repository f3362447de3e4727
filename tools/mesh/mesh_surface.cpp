#include "tools/mesh/mesh_surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

/// Which file, and how to say where in it.
struct Source {
  const std::string& name;
  double unit;

  [[noreturn]] void refuse(const std::string& what) const { throw sim::InputError({name}, what); }
  std::string place(const Vec3& x) const {
    return fmt::format("({:.6g} {:.6g} {:.6g})", x(0) / unit, x(1) / unit, x(2) / unit);
  }
};

/// Triangles by edge, each edge from its smaller to its larger point.
using EdgeFaces = std::map<std::pair<int, int>, std::vector<int>>;

std::pair<int, int> edge_of(const Triangles& triangles, int face, int k) {
  return std::minmax({triangles(k, face), triangles((k + 1) % 3, face)});
}

/// The whole surface, coincident points merged.
struct Soup {
  Positions X;
  Triangles triangles;
  std::vector<int> face_numbers;
};

Soup merged(const sim::MeshData& mesh) {
  std::map<std::array<double, 3>, int> numbers;
  std::vector<int> number(static_cast<std::size_t>(mesh.X.cols()));
  Soup soup;
  soup.X.resize(3, mesh.X.cols());
  for (Eigen::Index a = 0; a < mesh.X.cols(); ++a) {
    const std::array<double, 3> key = {mesh.X(0, a), mesh.X(1, a), mesh.X(2, a)};
    const auto [entry, is_new] = numbers.emplace(key, static_cast<int>(numbers.size()));
    if (is_new) soup.X.col(entry->second) = mesh.X.col(a);
    number[static_cast<std::size_t>(a)] = entry->second;
  }
  soup.X.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(numbers.size()));
  soup.triangles.resize(3, mesh.triangles.cols());
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.cols(); ++f) {
    const Eigen::Vector3i face =
        mesh.triangles.col(f).unaryExpr([&](int a) { return number[static_cast<std::size_t>(a)]; });
    if (face(0) == face(1) || face(1) == face(2) || face(2) == face(0)) continue;
    soup.triangles.col(kept++) = face;
    soup.face_numbers.push_back(static_cast<int>(f));
  }
  soup.triangles.conservativeResize(Eigen::NoChange, kept);
  return soup;
}

/// For each triangle the number of its part; parts are counted in the order of their first one.
/// Triangles belong together that share a point.
std::vector<int> parts_of(const Soup& soup) {
  std::vector<int> parent(static_cast<std::size_t>(soup.X.cols()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int a) {
    while (parent[static_cast<std::size_t>(a)] != a)
      a = parent[static_cast<std::size_t>(a)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(a)])];
    return a;
  };
  for (const auto& face : soup.triangles.colwise())
    for (const int k : {1, 2}) parent[static_cast<std::size_t>(root(face(k)))] = root(face(0));
  std::map<int, int> numbers;
  std::vector<int> part;
  for (const auto& face : soup.triangles.colwise())
    part.push_back(numbers.emplace(root(face(0)), static_cast<int>(numbers.size())).first->second);
  return part;
}

Shell extract(const Soup& soup, const std::vector<int>& faces) {
  Shell shell;
  std::map<int, int> numbers;
  shell.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      shell.triangles(k, static_cast<Eigen::Index>(i)) =
          numbers.emplace(soup.triangles(k, faces[i]), static_cast<int>(numbers.size()))
              .first->second;
    shell.face_numbers.push_back(soup.face_numbers[static_cast<std::size_t>(faces[i])]);
  }
  shell.X.resize(3, static_cast<Eigen::Index>(numbers.size()));
  for (const auto& [from, to] : numbers) shell.X.col(to) = soup.X.col(from);
  return shell;
}

/// About a point of the surface, so that a part far from the origin loses no digits.
double signed_volume(const Shell& shell) {
  double sum = 0;
  const Vec3 origin = shell.X.col(0);
  for (const auto& t : shell.triangles.colwise())
    sum += (shell.X.col(t(0)) - origin)
               .cross(shell.X.col(t(1)) - origin)
               .dot(shell.X.col(t(2)) - origin) /
           6;
  return sum;
}

EdgeFaces edge_faces(const Triangles& triangles) {
  EdgeFaces edges;
  for (int f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k) edges[edge_of(triangles, f, k)].push_back(f);
  return edges;
}

void check_edges(const Source& source, const Shell& shell, const EdgeFaces& edges) {
  const auto number = [&](int f) { return shell.face_numbers[static_cast<std::size_t>(f)] + 1; };
  const auto open = std::count_if(edges.begin(), edges.end(),
                                  [](const auto& edge) { return edge.second.size() == 1; });
  for (const auto& [ends, faces] : edges) {
    if (faces.size() == 2) continue;
    const std::string between =
        source.place(shell.X.col(ends.first)) + " and " + source.place(shell.X.col(ends.second));
    if (faces.size() == 1)
      source.refuse(fmt::format(
          "the surface is open: face {} has no neighbour at its edge between {}, one of {} open "
          "edges; expected a closed surface",
          number(faces[0]), between, open));
    source.refuse(
        fmt::format("faces {}, {} and {} share the edge between {}; expected two at each edge",
                    number(faces[0]), number(faces[1]), number(faces[2]), between));
  }
}

bool runs_forward(const Triangles& triangles, int face, const std::pair<int, int>& edge) {
  for (int k = 0; k < 3; ++k)
    if (triangles(k, face) == edge.first && triangles((k + 1) % 3, face) == edge.second)
      return true;
  return false;
}

/// Turns neighbours alike, from the first triangle on.
void turn_alike(const Source& source, Shell& shell, const EdgeFaces& edges) {
  std::vector<bool> turned(static_cast<std::size_t>(shell.triangles.cols()), false);
  std::vector<int> front = {0};
  turned[0] = true;
  while (!front.empty()) {
    const int f = front.back();
    front.pop_back();
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> edge = edge_of(shell.triangles, f, k);
      const std::vector<int>& faces = edges.at(edge);
      const int g = faces[0] == f ? faces[1] : faces[0];
      const bool alike =
          runs_forward(shell.triangles, f, edge) != runs_forward(shell.triangles, g, edge);
      if (!turned[static_cast<std::size_t>(g)]) {
        if (!alike) std::swap(shell.triangles(0, g), shell.triangles(1, g));
        turned[static_cast<std::size_t>(g)] = true;
        front.push_back(g);
      } else if (!alike) {
        source.refuse(
            fmt::format("the surface has one side only: faces {} and {} can't both look outward",
                        shell.face_numbers[static_cast<std::size_t>(f)] + 1,
                        shell.face_numbers[static_cast<std::size_t>(g)] + 1));
      }
    }
  }
}

/// Around each point the triangles make one ring.
void check_points(const Source& source, const Shell& shell) {
  std::vector<std::vector<std::pair<int, int>>> links(static_cast<std::size_t>(shell.X.cols()));
  for (const auto& t : shell.triangles.colwise())
    for (int k = 0; k < 3; ++k)
      links[static_cast<std::size_t>(t(k))].emplace_back(t((k + 1) % 3), t((k + 2) % 3));
  for (std::size_t a = 0; a < links.size(); ++a) {
    const std::map<int, int> next(links[a].begin(), links[a].end());
    std::size_t ring = 0;
    for (int b = links[a][0].first; ring == 0 || b != links[a][0].first; b = next.at(b)) ++ring;
    if (ring < links[a].size())
      source.refuse(
          fmt::format("two parts of the surface touch in one point, {}; expected them "
                      "apart, or joined along an edge",
                      source.place(shell.X.col(static_cast<Eigen::Index>(a)))));
  }
}

/// Solid angle of the surface as seen from x, by 4π: 1 inside, 0 outside [van Oosterom, Strackee
/// 1983].
double winding_number(const Shell& shell, const Vec3& x) {
  double sum = 0;
  for (const auto& t : shell.triangles.colwise()) {
    const Vec3 a = shell.X.col(t(0)) - x, b = shell.X.col(t(1)) - x, c = shell.X.col(t(2)) - x;
    const double A = a.norm(), B = b.norm(), C = c.norm();
    sum +=
        2 * std::atan2(a.dot(b.cross(c)), A * B * C + a.dot(b) * C + b.dot(c) * A + c.dot(a) * B);
  }
  return sum / (4 * std::numbers::pi);
}

void check_apart(const Source& source, const std::vector<Shell>& shells) {
  for (const Shell& outer : shells)
    for (const Shell& inner : shells)
      if (&outer != &inner && winding_number(outer, inner.X.col(0)) > 0.5)
        source.refuse(fmt::format(
            "the shell of face {} reaches into that of face {}, at {}; "
            "expected shells apart, without cavities",
            inner.face_numbers[0] + 1, outer.face_numbers[0] + 1, source.place(inner.X.col(0))));
}

}  // namespace

double element_volume(double edge) { return edge * edge * edge / (6 * std::numbers::sqrt2); }

Shells closed_shells(const std::string& name, const sim::MeshData& mesh, double unit, double size) {
  const Source source{name, unit};
  const Soup soup = merged(mesh);
  const std::vector<int> part = parts_of(soup);
  const int num_parts = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
  std::vector<std::vector<int>> faces(static_cast<std::size_t>(num_parts));
  for (std::size_t f = 0; f < part.size(); ++f)
    faces[static_cast<std::size_t>(part[f])].push_back(static_cast<int>(f));

  Shells result;
  constexpr std::size_t kLeastFaces = 4;  // of a closed surface
  for (const std::vector<int>& list : faces) {
    Shell shell = extract(soup, list);
    const StrayShell stray{static_cast<int>(list.size()), shell.face_numbers[0]};
    if (list.size() < kLeastFaces) {
      result.stray.push_back(stray);
      continue;
    }
    const EdgeFaces edges = edge_faces(shell.triangles);
    check_edges(source, shell, edges);
    turn_alike(source, shell, edges);
    shell.volume = signed_volume(shell);
    if (shell.volume < 0) {
      shell.triangles.row(0).swap(shell.triangles.row(1));
      shell.volume = -shell.volume;
    }
    if (shell.volume < element_volume(size)) {
      result.stray.push_back(stray);
      continue;
    }
    check_points(source, shell);
    result.shells.push_back(std::move(shell));
  }
  if (result.shells.empty())
    source.refuse(fmt::format(
        "holds no surface that encloses as much as one element of size {:.6g}; expected a closed "
        "surface, or a smaller --size",
        size / unit));
  check_apart(source, result.shells);
  return result;
}

}  // namespace articular::tools
