#pragma once

#include <span>
#include <vector>

#include "sim/wrap/wrap_surface.hpp"

/// A string without friction between two points, over the edges of triangulated surfaces.
///
/// The string crosses edge i at P_i = A_i + t_i (B_i − A_i). For a given sequence of edges its
/// length L(t) = Σ |P_i+1 − P_i| is convex: it is a sum of norms of affine functions. The string is
/// taut where L is least over t in [kEnd, 1 − kEnd].
namespace articular::sim {

/// Where a string crosses an edge.
struct EdgeCrossing {
  int surface = 0, edge = 0;
  bool forward = true;  // from the edge's face[0] to its face[1], or back
  double t = 0.5;       // from its node[0] to its node[1]
};

/// An end of a string. One that lies on a surface, or so little below that it does not matter,
/// knows on which of its triangles.
struct StringEnd {
  Vec3 x = Vec3::Zero();  // [m]
  int surface = -1, face = -1;
};

/// How near to a node a crossing comes, by the length of its edge. Crossings on several edges of a
/// node stay apart, so that L has all derivatives. An edge adds at most about this part of its
/// length to L.
constexpr double kEnd = 1e-7;

/// A string of n crossings as it lies, and the memory to compute it with.
struct StringShape {
  std::vector<Vec3> a, e;    // of each crossing: the edge's node[0], and from it to node[1]
  std::vector<Vec3> P;       // n + 2 points, ends included
  std::vector<Vec3> u;       // n + 1 unit vectors
  std::vector<double> l;     // n + 1 lengths [m]
  std::vector<double> t, g;  // n: parameters and ∂L/∂t [m]
  std::vector<double> diagonal, beside, step, tried;
  std::vector<char> fixed;
  double length = 0;  // [m]
  int iterations = 0;
};

/// Whether a crossing is as near to a node of its edge as it may be; then which one, or -1.
int node_at_end(const WrapSurface& surface, const EdgeCrossing& crossing);

/// The same crossings from the other end of the string.
void turn_round(std::vector<EdgeCrossing>& crossings);

/// Makes a string taut over its sequence of edges, from where it is, by Newton's method with active
/// bounds [Bertsekas 1982, SIAM J. Control Optim. 20:221]. The Hessian is tridiagonal.
void pull_taut(std::span<const PlacedSurface> surfaces, const Vec3& from, const Vec3& to,
               std::vector<EdgeCrossing>& crossings, StringShape& shape);

}  // namespace articular::sim
