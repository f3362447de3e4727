#include "sim/wrap/wrap_surface.hpp"

#include <map>
#include <utility>

namespace articular::sim {

WrapSurface make_wrap_surface(const Triangles& triangles) {
  WrapSurface s;
  s.triangles = triangles;
  s.edge_of_face.resize(3, triangles.cols());
  std::map<std::pair<int, int>, int> open;  // edges that lack a triangle the other way round
  for (int f = 0; f < static_cast<int>(triangles.cols()); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(k, f), b = triangles((k + 1) % 3, f);
      const auto other = open.find({b, a});
      if (other != open.end()) {
        s.edges[static_cast<std::size_t>(other->second)].face[1] = f;
        s.edge_of_face(k, f) = other->second;
        open.erase(other);
        continue;
      }
      s.edge_of_face(k, f) = static_cast<int>(s.edges.size());
      open.emplace(std::pair(a, b), s.edge_of_face(k, f));
      s.edges.push_back({{a, b}, {f, -1}});
    }
  return s;
}

Vec3 PlacedSurface::normal(int face) const {
  const auto corner = surface->triangles.col(face);
  const Vec3 a = X->col(corner[0]), b = X->col(corner[1]), c = X->col(corner[2]);
  const Vec3 n = (b - a).cross(c - a);
  const double length = n.norm();
  return length > 0 ? Vec3(pose.R * (n / length)) : Vec3::Zero();
}

}  // namespace articular::sim
