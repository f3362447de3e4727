#include "sim/mesh/mesh_continue.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace articular::sim {
namespace {

/// Nodes nearer to the cut than this part of an edge that crosses it are moved onto it.
constexpr double kSnap = 1.0 / 3;
/// Slopes are means over so many neighbours along the cut, by turns: facets of a scan are noisy.
constexpr int kSmoothings = 4;

/// Least sine between the direction of continuation and the normals at the cut: steeper sheets
/// can't be carried on.
constexpr double kLeastAcross = 0.1;
/// Rows of triangles beyond the cut: more than this is a wrong length.
constexpr double kMostRows = 10000;

[[noreturn]] void refuse_slope() {
  throw std::invalid_argument(
      "the surface stands across the direction of `continued` where it is cut, or turns over "
      "there; "
      "an open sheet that runs along it is needed");
}

using Edge = std::pair<int, int>;

/// The surface while it is cut: nodes, and how far each lies beyond the plane [m].
struct CutSurface {
  std::vector<Vec3> x;
  std::vector<double> beyond;
  std::vector<Eigen::Vector3i> faces;
  std::map<Edge, int> crossings;  // of edges (low, high index)

  double at(int node) const { return beyond[static_cast<std::size_t>(node)]; }
  const Vec3& position(int node) const { return x[static_cast<std::size_t>(node)]; }
};

/// Moves every node whose shortest way to the plane along an edge is short onto the plane.
void snap(const Triangles& triangles, CutSurface& cut) {
  std::vector<double> least(cut.x.size(), kSnap);
  std::vector<Vec3> target = cut.x;
  std::vector<char> moves(cut.x.size(), 0);
  for (Eigen::Index f = 0; f < triangles.cols(); ++f)
    for (int k = 0; k < 3; ++k)
      for (const auto& [from, to] : {Edge(triangles(k, f), triangles((k + 1) % 3, f)),
                                     Edge(triangles((k + 1) % 3, f), triangles(k, f))}) {
        const double a = cut.at(from), b = cut.at(to);
        if (!(a * b < 0)) continue;
        const double part = a / (a - b);
        const auto i = static_cast<std::size_t>(from);
        if (part >= least[i]) continue;
        least[i] = part;
        target[i] = cut.position(from) + part * (cut.position(to) - cut.position(from));
        moves[i] = 1;
      }
  for (std::size_t i = 0; i < cut.x.size(); ++i)
    if (moves[i] != 0) {
      cut.x[i] = target[i];
      cut.beyond[i] = 0;
    }
}

/// The node where an edge crosses the plane.
int crossing(int a, int b, CutSurface& cut) {
  const auto [entry, is_new] =
      cut.crossings.try_emplace(std::minmax(a, b), static_cast<int>(cut.x.size()));
  if (is_new) {
    const double part = cut.at(a) / (cut.at(a) - cut.at(b));
    cut.x.push_back(cut.position(a) + part * (cut.position(b) - cut.position(a)));
    cut.beyond.push_back(0);
  }
  return entry->second;
}

/// Keeps of a triangle what is not beyond the plane.
void keep_near_part(const Eigen::Vector3i& triangle, CutSurface& cut) {
  std::vector<int> polygon;
  bool inside = false;
  for (int k = 0; k < 3; ++k) {
    const int a = triangle[k], b = triangle[(k + 1) % 3];
    inside = inside || cut.at(a) < 0;
    if (cut.at(a) <= 0) polygon.push_back(a);
    if (cut.at(a) * cut.at(b) < 0) polygon.push_back(crossing(a, b, cut));
  }
  if (!inside) return;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    cut.faces.emplace_back(polygon[0], polygon[k], polygon[k + 1]);
}

CutSurface cut_along_plane(const MeshData& surface, const Continuation& c) {
  CutSurface cut;
  for (Eigen::Index i = 0; i < surface.X.cols(); ++i) {
    cut.x.emplace_back(surface.X.col(i));
    cut.beyond.push_back(c.direction.dot(surface.X.col(i) - c.at));
  }
  snap(surface.triangles, cut);
  for (Eigen::Index f = 0; f < surface.triangles.cols(); ++f)
    keep_near_part(surface.triangles.col(f), cut);
  return cut;
}

/// Edges on the plane that belong to one face, in the order of that face.
std::vector<Edge> rim(const CutSurface& cut) {
  std::map<Edge, int> count;
  for (const Eigen::Vector3i& face : cut.faces)
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if (cut.at(a) == 0 && cut.at(b) == 0) ++count[{a, b}];
    }
  std::vector<Edge> edges;
  for (const auto& [edge, times] : count)
    if (!count.contains({edge.second, edge.first})) edges.push_back(edge);
  return edges;
}

/// σ at every node of the rim, and the direction up.
struct Slopes {
  std::map<int, double> at;
  Vec3 up;
};

Slopes slopes(const CutSurface& cut, const std::vector<Edge>& edges, const Vec3& direction) {
  std::map<int, Vec3> normals;
  for (const auto& [a, b] : edges) normals[a] = normals[b] = Vec3::Zero();
  Vec3 mean = Vec3::Zero();
  for (const Eigen::Vector3i& face : cut.faces) {
    const Vec3& x0 = cut.position(face[0]);
    const Vec3 area = (cut.position(face[1]) - x0).cross(cut.position(face[2]) - x0);
    for (const int node : face) {
      const auto normal = normals.find(node);
      if (normal == normals.end()) continue;
      normal->second += area;
      mean += area;
    }
  }
  Slopes result;
  const Vec3 across = mean - mean.dot(direction) * direction;
  result.up = across.normalized();
  if (!(across.norm() > kLeastAcross * mean.norm())) refuse_slope();
  for (const auto& [node, normal] : normals) {
    if (!(normal.dot(result.up) > kLeastAcross * normal.norm())) refuse_slope();
    result.at[node] = -normal.dot(direction) / normal.dot(result.up);
  }
  for (int round = 0; round < kSmoothings; ++round) {
    std::map<int, std::pair<double, int>> sums;
    for (const auto& [node, slope] : result.at) sums[node] = {slope, 1};
    for (const auto& [a, b] : edges) {
      sums[a].first += result.at[b];
      sums[b].first += result.at[a];
      ++sums[a].second;
      ++sums[b].second;
    }
    for (const auto& [node, sum] : sums) result.at[node] = sum.first / sum.second;
  }
  return result;
}

/// Adds rows of nodes beyond the rim, and the triangles between them.
void carry_on(const std::vector<Edge>& edges, const Continuation& c, CutSurface& cut) {
  const Slopes slope = slopes(cut, edges, c.direction);
  double width = 0;
  for (const auto& [a, b] : edges) width += (cut.position(b) - cut.position(a)).norm();
  const double wanted =
      std::ceil(c.length * static_cast<double>(edges.size()) / width * (1 - 1e-9));
  if (!(wanted <= kMostRows))
    throw std::invalid_argument(
        "the length of `continued` is more than 10 000 times an edge of the surface where it is "
        "cut");
  const auto rows = static_cast<int>(wanted);
  std::map<int, int> last;  // node of the latest row by node of the rim
  for (const auto& [node, unused] : slope.at) last[node] = node;
  for (int row = 1; row <= rows; ++row) {
    const double u = c.length * row / rows;
    const double g = u < c.easing ? u - u * u / (2 * c.easing) : c.easing / 2;
    std::map<int, int> next;
    for (const auto& [node, sigma] : slope.at) {
      next[node] = static_cast<int>(cut.x.size());
      cut.x.push_back(cut.position(node) + u * c.direction + sigma * g * slope.up);
      cut.beyond.push_back(u);
    }
    for (const auto& [a, b] : edges) {
      cut.faces.emplace_back(last[b], last[a], next[a]);
      cut.faces.emplace_back(last[b], next[a], next[b]);
    }
    last = std::move(next);
  }
}

/// The faces with the nodes that they use.
MeshData compact(const CutSurface& cut) {
  std::vector<int> index(cut.x.size(), -1), kept;
  MeshData mesh;
  mesh.triangles.resize(3, static_cast<Eigen::Index>(cut.faces.size()));
  for (std::size_t f = 0; f < cut.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int node = cut.faces[f][k];
      int& to = index[static_cast<std::size_t>(node)];
      if (to < 0) {
        to = static_cast<int>(kept.size());
        kept.push_back(node);
      }
      mesh.triangles(k, static_cast<Eigen::Index>(f)) = to;
    }
  mesh.X.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i)
    mesh.X.col(static_cast<Eigen::Index>(i)) = cut.position(kept[i]);
  return mesh;
}

}  // namespace

MeshData continued(const MeshData& surface, const Continuation& continuation) {
  CutSurface cut = cut_along_plane(surface, continuation);
  const std::vector<Edge> edges = rim(cut);
  if (edges.empty())
    throw std::invalid_argument(
        "the plane where the surface should be continued does not cross it");
  carry_on(edges, continuation, cut);
  return compact(cut);
}

}  // namespace articular::sim
