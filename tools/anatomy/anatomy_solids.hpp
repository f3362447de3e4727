#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "tools/anatomy/anatomy_mesh.hpp"

/// Bones to look at: unions of simple solids given by signed distances, contoured. mm.
namespace articular::anatomy {

/// A corner of a thick sheet: half the thickness there is r.
struct Knot {
  double x, y, z, r;
};

/// A triangle thickened by a radius that varies linearly over it. Two equal corners make a tapered
/// rod.
struct ThickTriangle {
  ThickTriangle(const Knot& a, const Knot& b, const Knot& c);
  Knot a, b, c;
  Vec3 center;
  double reach = 0;  // everything of it lies within this distance of the centre
};

using Sheet = std::vector<ThickTriangle>;

constexpr double kFar = 1e3;  // more than any distance that matters

/// Signed distance, < 0 inside; kFar where the sheet is empty.
double distance(const Sheet& sheet, const Vec3& p);

/// The lesser of two distances, with a fillet where they differ by less than `width`.
double smooth_min(double a, double b, double width);

/// Two triangles a quadrilateral, between two rows of knots of equal length.
void add_strip(Sheet& sheet, const std::vector<Knot>& lower, const std::vector<Knot>& upper);
void add_rods(Sheet& sheet, const std::vector<Knot>& chain);

/// Cubic through the knots (Catmull-Rom), n pieces a span.
std::vector<Knot> smoothed(const std::vector<Knot>& knots, int n);

using Distance = std::function<double(const Vec3&)>;

/// Contours the zero level of a distance that is even in x, on a grid of spacing h with a plane at
/// x = 0. Closed, outward normals.
Mesh contour_even(const Distance& distance, const Vec3& low, const Vec3& high, double h);

/// The same of any distance.
Mesh contour(const Distance& distance, const Vec3& low, const Vec3& high, double h);

/// Faces of the surface that `keep` likes, by middle and outward normal; without the nodes of the
/// others.
Mesh part_of(const Mesh& surface, const std::function<bool(const Vec3&, const Vec3&)>& keep);

/// Volume of a closed surface [mm^3] and its centre of volume.
std::pair<double, Vec3> volume_and_center(const Mesh& surface);

}  // namespace articular::anatomy
