#pragma once

#include <optional>
#include <vector>

#include "sim/mesh/deepest_inside.hpp"
#include "sim/model/configuration.hpp"

namespace articular::sim {

/// Two bodies that lie in each other and that nothing parts: no [[contact]] names them.
struct IgnoredOverlap {
  int inner = 0, outer = 0;  // indices into Model::bodies: a node of `inner` lies in `outer`
  Vec3 x;                    // [m], the deepest node
  double depth = 0;          // [m]
  bool is_whole = false;     // all nodes of `inner` lie there
  double t = 0;              // [s]
};

/// Looks for bodies that lie in each other deeper than half an element of their tissues, or than a
/// fiftieth of the smaller body where both are rigid. Left out: bodies with `collides = false` or
/// with contact meshes of their own, tissue that is tied to the other, two bodies that are fixed or
/// driven, and open surfaces.
class IgnoredOverlaps {
 public:
  IgnoredOverlaps(const Scenario& scenario, const Model& model);

  std::vector<IgnoredOverlap> find(const Configuration& now) const;
  std::vector<IgnoredOverlap> at_start() const;

 private:
  struct Surface {
    std::vector<NodeRef> nodes;
    Triangles triangles;
    bool is_closed = false;
    double deep = 0;             // [m]
    std::optional<Solid> solid;  // of a rigid body, in its frame
  };
  class Look;

  void add_surface(int body);
  bool is_ignored(int a, int b) const;

  const Model& model_;
  std::vector<Surface> surfaces_;  // by body; empty where it doesn't count
};

/// Keeps what has gone into another body since the start, as it was when it was first seen.
class OverlapWatch {
 public:
  OverlapWatch(const Scenario& scenario, const Model& model);

  void look(const Configuration& now);
  const std::vector<IgnoredOverlap>& since_start() const { return since_start_; }

 private:
  IgnoredOverlaps overlaps_;
  std::vector<IgnoredOverlap> at_start_, since_start_;
};

}  // namespace articular::sim
