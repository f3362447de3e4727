#include "sim/wrap/taut_string.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace articular::sim {
namespace {

constexpr double kLow = kEnd, kHigh = 1 - kEnd;
constexpr int kMostStringIterations = 300;
/// ∂L/∂t by the length of the edge. Below the first Newton's method converges fast, the second is
/// round-off.
constexpr double kNear = 1e-6, kStringRoundOff = 1e-15;

/// Points, directions and length for the parameters t. @return the length
double lay(const std::vector<double>& t, StringShape& s) {
  const std::size_t n = s.a.size();
  s.length = 0;
  for (std::size_t i = 0; i < n; ++i) s.P[i + 1] = s.a[i] + t[i] * s.e[i];
  for (std::size_t i = 0; i <= n; ++i) {
    const Vec3 d = s.P[i + 1] - s.P[i];
    s.l[i] = d.norm();
    s.u[i] = s.l[i] > 0 ? Vec3(d / s.l[i]) : Vec3::Zero();
    s.length += s.l[i];
  }
  return s.length;
}

/// ∂L/∂t_i = e_i·(u_i−1 − u_i). @return the largest of those that a bound does not hold, by edges
double find_gradient(StringShape& s) {
  double largest = 0;
  for (std::size_t i = 0; i < s.a.size(); ++i) {
    s.g[i] = s.e[i].dot(s.u[i] - s.u[i + 1]);
    s.fixed[i] = (s.t[i] <= kLow && s.g[i] > 0) || (s.t[i] >= kHigh && s.g[i] < 0);
    const double length = s.e[i].norm();
    if (s.fixed[i] == 0 && length > 0) largest = std::max(largest, std::abs(s.g[i]) / length);
  }
  return largest;
}

/// ∂²|d|/∂t_i∂t_j of one segment, by e_i·(I − u uᵀ) e_j / l.
double bend(const Vec3& e, const Vec3& f, const Vec3& u, double l) {
  return l > 0 ? (e.dot(f) - e.dot(u) * f.dot(u)) / l : 0;
}

/// H step = −g over what is not fixed, H tridiagonal.
void solve(StringShape& s) {
  const std::size_t n = s.a.size();
  constexpr double kRegular = 1e-14;  // of the diagonal: an edge along the string
  for (std::size_t i = 0; i < n; ++i) {
    if (s.fixed[i] != 0) {
      s.diagonal[i] = 1;
      s.beside[i] = s.step[i] = 0;
      continue;
    }
    s.diagonal[i] =
        bend(s.e[i], s.e[i], s.u[i], s.l[i]) + bend(s.e[i], s.e[i], s.u[i + 1], s.l[i + 1]);
    s.diagonal[i] +=
        kRegular * s.e[i].squaredNorm() * (1 / s.length + (s.l[i] > 0 ? 1 / s.l[i] : 0));
    s.beside[i] =
        i + 1 < n && s.fixed[i + 1] == 0 ? -bend(s.e[i], s.e[i + 1], s.u[i + 1], s.l[i + 1]) : 0;
    s.step[i] = -s.g[i];
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = s.beside[i - 1] / s.diagonal[i - 1];
    s.diagonal[i] -= factor * s.beside[i - 1];
    if (!(s.diagonal[i] > 0)) s.diagonal[i] = s.e[i].squaredNorm() / s.length;
    s.step[i] -= factor * s.step[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) s.step[i] -= s.beside[i] * s.step[i + 1];
    s.step[i] /= s.diagonal[i];
  }
}

/// The step, without what a bound would cut off at once. What is left leads downhill for a while.
void find_step(StringShape& s) {
  for (std::size_t k = 0; k <= s.a.size(); ++k) {
    solve(s);
    bool all_within = true;
    for (std::size_t i = 0; i < s.a.size(); ++i) {
      const bool outward = (s.t[i] <= kLow && s.step[i] < 0) || (s.t[i] >= kHigh && s.step[i] > 0);
      if (s.fixed[i] != 0 || !outward) continue;
      s.fixed[i] = 1;
      all_within = false;
    }
    if (all_within) return;
  }
}

/// At a bound, or clear of it.
double within_bounds(double t) {
  constexpr double kAtBound = 1e-3 * kEnd;
  if (t < kLow + kAtBound) return kLow;
  return t > kHigh - kAtBound ? kHigh : t;
}

/// A step leaves a part of the way to the bound, until that is short: L is like a cone around a
/// node, and Newton's method leaves its tip in small steps only.
double advanced(double t, double step) {
  constexpr double kLeft = 0.1;
  const double low = t - kLow > kEnd ? kLow + kLeft * (t - kLow) : kLow;
  const double high = kHigh - t > kEnd ? kHigh - kLeft * (kHigh - t) : kHigh;
  return within_bounds(std::clamp(t + step, low, high));
}

/// The part of the step that brings the first crossing to its bound.
double first_bound(const StringShape& s) {
  double part = 1;
  for (std::size_t i = 0; i < s.t.size(); ++i)
    if (s.step[i] != 0)
      part = std::min(part, ((s.step[i] < 0 ? kLow : kHigh) - s.t[i]) / s.step[i]);
  return part;
}

/// Along the step, cut off at the bounds, until L falls [Bertsekas 1982, eq. 12]. Around a node the
/// step may be so long that nothing cut off helps: then up to the first bound, where that crossing
/// stays.
bool advance(StringShape& s, bool near) {
  constexpr double kArmijo = 1e-4, kSlack = 1e-15, kShortest = 1e-15;
  const double start = s.length, bound = first_bound(s);
  double part = 1;
  while (part > kShortest) {
    double expected = 0;
    for (std::size_t i = 0; i < s.t.size(); ++i) {
      s.tried[i] = advanced(s.t[i], part * s.step[i]);
      expected += s.g[i] * (s.tried[i] - s.t[i]);
    }
    const double length = lay(s.tried, s);
    if (near || length <= start + kArmijo * std::min(expected, 0.0) + kSlack * start) {
      std::swap(s.t, s.tried);
      return true;
    }
    const bool passes_bound = part > bound && 0.5 * part < bound;
    part = passes_bound ? bound : 0.5 * part;
  }
  lay(s.t, s);
  return false;
}

}  // namespace

int node_at_end(const WrapSurface& surface, const EdgeCrossing& crossing) {
  const WrapEdge& edge = surface.edges[static_cast<std::size_t>(crossing.edge)];
  if (crossing.t <= kLow) return edge.node[0];
  return crossing.t >= kHigh ? edge.node[1] : -1;
}

void turn_round(std::vector<EdgeCrossing>& crossings) {
  std::reverse(crossings.begin(), crossings.end());
  for (EdgeCrossing& crossing : crossings) crossing.forward = !crossing.forward;
}

void pull_taut(std::span<const PlacedSurface> surfaces, const Vec3& from, const Vec3& to,
               std::vector<EdgeCrossing>& crossings, StringShape& s) {
  const std::size_t n = crossings.size();
  for (auto* list : {&s.a, &s.e}) list->resize(n);
  for (auto* list : {&s.t, &s.g, &s.diagonal, &s.beside, &s.step, &s.tried}) list->resize(n);
  s.fixed.resize(n);
  s.P.resize(n + 2);
  s.u.resize(n + 1);
  s.l.resize(n + 1);
  s.P.front() = from;
  s.P.back() = to;
  for (std::size_t i = 0; i < n; ++i) {
    const PlacedSurface& surface = surfaces[static_cast<std::size_t>(crossings[i].surface)];
    const WrapEdge& edge = surface.surface->edges[static_cast<std::size_t>(crossings[i].edge)];
    s.a[i] = surface.at(edge.node[0]);
    s.e[i] = surface.at(edge.node[1]) - s.a[i];
    s.t[i] = within_bounds(crossings[i].t);
  }
  lay(s.t, s);
  double last = find_gradient(s);
  for (int k = 0; k < kMostStringIterations && last > kStringRoundOff; ++k) {
    ++s.iterations;
    const bool near = last < kNear;
    find_step(s);
    if (!advance(s, near)) {
      find_gradient(s);
      break;
    }
    const double now = find_gradient(s);
    // Near the end round-off is reached where the gradient no longer falls.
    if (near && now >= 0.5 * last) break;
    last = now;
  }
  for (std::size_t i = 0; i < n; ++i) crossings[i].t = s.t[i];
}

}  // namespace articular::sim
