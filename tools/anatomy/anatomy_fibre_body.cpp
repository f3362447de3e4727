#include "tools/anatomy/anatomy_fibre_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/mesh/fibre_field.hpp"
#include "tools/anatomy/anatomy_grid.hpp"

namespace articular::anatomy {
namespace {

constexpr double kRoundness = 0.6;  // of cross-sections: 0 a rectangle, 1 an ellipse
constexpr double kReach = 0.25;     // of the length, that gives way as an end sits down on its bone

/// A cubic through values at 0, 1, 2, ... (Catmull-Rom).
template <class Value>
Value spline(const std::vector<Value>& values, double s) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto i = static_cast<std::size_t>(std::clamp(std::floor(s), 0.0, last - 1));
  const double t = s - static_cast<double>(i);
  const Value &p1 = values[i], &p2 = values[i + 1];
  const Value p0 = i > 0 ? values[i - 1] : Value(2 * p1 - p2);
  const Value p3 = i + 2 < values.size() ? values[i + 2] : Value(2 * p2 - p1);
  const Value m1 = (p2 - p0) / 2, m2 = (p3 - p1) / 2;
  return (2 * t * t * t - 3 * t * t + 1) * p1 + (t * t * t - 2 * t * t + t) * m1 +
         (3 * t * t - 2 * t * t * t) * p2 + (t * t * t - t * t) * m2;
}

/// The middle surface of a body: x from -1 in front to 1 at the back, w from 0 to 1 along it.
class MiddleSurface {
 public:
  explicit MiddleSurface(const FibreBody& body) {
    for (const FibreRow& row : body.rows) {
      front_.push_back(row.front);
      middle_.push_back(row.middle);
      back_.push_back(row.back);
      half_thickness_.push_back(row.half_thickness);
    }
    constexpr int kSamples = 200;
    const auto last = static_cast<double>(middle_.size() - 1);
    Vec3 before = middle_.front();
    for (int i = 0; i <= kSamples; ++i) {
      parameter_.push_back(last * i / kSamples);
      const Vec3 p = spline(middle_, parameter_.back());
      way_.push_back(i == 0 ? 0 : way_.back() + (p - before).norm());  // [mm]
      before = p;
    }
  }

  double length() const { return way_.back(); }  // [mm], of the middle line
  double width() const {                         // [mm], the mean of all rows
    double sum = 0;
    for (std::size_t i = 0; i < front_.size(); ++i)
      sum += (middle_[i] - front_[i]).norm() + (back_[i] - middle_[i]).norm();
    return sum / static_cast<double>(front_.size());
  }
  double thickness() const {  // [mm], the mean of all rows
    const double sum = std::accumulate(half_thickness_.begin(), half_thickness_.end(), 0.0);
    return 2 * sum / static_cast<double>(half_thickness_.size());
  }
  double half_thickness(double w) const { return spline(half_thickness_, parameter(w)); }

  Vec3 point(double x, double w) const {
    const double s = parameter(w);
    return 0.5 * x * (x - 1) * spline(front_, s) + (1 - x * x) * spline(middle_, s) +
           0.5 * x * (x + 1) * spline(back_, s);
  }
  Vec3 normal(double x, double w) const {
    constexpr double kStep = 1e-4;
    const double w0 = std::max(w - kStep, 0.0), w1 = std::min(w + kStep, 1.0);
    const Vec3 across = point(x + kStep, w) - point(x - kStep, w);
    return (point(x, w1) - point(x, w0)).cross(across).normalized();
  }

 private:
  double parameter(double w) const {
    const double way = w * way_.back();
    const auto after = std::upper_bound(way_.begin() + 1, way_.end() - 1, way);
    const auto i = static_cast<std::size_t>(after - way_.begin());
    const double t = (way - way_[i - 1]) / (way_[i] - way_[i - 1]);
    return parameter_[i - 1] + t * (parameter_[i] - parameter_[i - 1]);
  }

  std::vector<Vec3> front_, middle_, back_;  // of the rows
  std::vector<double> half_thickness_;
  std::vector<double> parameter_, way_;  // samples of the middle line
};

Vec3 gradient(const Distance& distance, const Vec3& p) {
  constexpr double kStep = 1e-3;
  Vec3 slope;
  for (int i = 0; i < 3; ++i) {
    const Vec3 step = kStep * Vec3::Unit(i);
    slope[i] = distance(p + step) - distance(p - step);
  }
  return slope.normalized();
}

/// Where the bone is `away` from p, along its normal.
Vec3 on_bone(const Distance& bone, double away, Vec3 p) {
  for (int i = 0; i < 8; ++i) p += (away - bone(p)) * gradient(bone, p);
  return p;
}

/// How far p has to go outwards until the bone is `clearance` away; negative where it is farther.
double way_out(const Distance& bone, const Vec3& p, const Vec3& outwards, double clearance) {
  constexpr double kFarthest = 15;  // [mm]
  double way = 0;
  for (int i = 0; i < 60; ++i) {
    const double lacks = clearance - bone(p + way * outwards);
    if (std::abs(lacks) < 1e-3) break;
    way = std::clamp(way + lacks, -kFarthest, kFarthest);
  }
  return way;
}

CellGrid grid_of(const MiddleSurface& surface, double h) {
  return {even_cells(surface.width(), h, 4), even_cells(surface.thickness(), h, 2),
          std::max(6, static_cast<int>(std::lround(surface.length() / h)))};
}

/// Rows of nodes beyond the last one that sit on the bone by their inner side; 0: the face does.
int seats_by_side(const FibreEnd& end, const CellGrid& grid) {
  return static_cast<int>(std::lround(end.side_part * grid.nw));
}

/// Moves a column of nodes through the thickness.
void move_column(int i, int k, const Vec3& move, const CellGrid& grid, Mesh& mesh) {
  for (int j = 0; j <= grid.nv; ++j) mesh.X_mm.col(grid.node(i, j, k)) += move;
}

/// What is left of the move of an end at a part of the length beyond it.
double give_way(double part) {
  const double rest = std::max(1 - part / kReach, 0.0);
  return rest * rest;
}

/// Moves the inner side of an end onto its bone, and what is next to it along.
void seat_side(const FibreEnd& end, const Distance& bone, double seated, bool at_origin,
               const MiddleSurface& surface, const CellGrid& grid, Mesh& mesh) {
  const int seats = seats_by_side(end, grid);
  for (int i = 0; i <= grid.nu; ++i) {
    double way = 0;
    for (int from_end = 0; from_end <= grid.nw; ++from_end) {
      const int k = at_origin ? from_end : grid.nw - from_end;
      const Vec3 outwards = surface.normal(2.0 * i / grid.nu - 1, static_cast<double>(k) / grid.nw);
      if (from_end <= seats)
        way = way_out(bone, mesh.X_mm.col(grid.node(i, 0, k)), outwards, seated);
      const double beyond = static_cast<double>(std::max(from_end - seats, 0)) / grid.nw;
      move_column(i, k, give_way(beyond) * way * outwards, grid, mesh);
    }
  }
}

/// Moves columns that do not sit on a bone outwards until they are clear of all.
void clear_bones(const FibreBody& body, const Bones& bones, const MiddleSurface& surface,
                 const CellGrid& grid, Mesh& mesh) {
  const Distance nearest = [&](const Vec3& p) {
    double distance = kFar;
    for (const auto& [name, bone] : bones) distance = std::min(distance, bone(p));
    return distance;
  };
  const int first = seats_by_side(body.origin, grid) + 1,
            last = grid.nw - seats_by_side(body.insertion, grid) - 1;
  for (int k = first; k <= last; ++k)
    for (int i = 0; i <= grid.nu; ++i) {
      const Vec3 outwards = surface.normal(2.0 * i / grid.nu - 1, static_cast<double>(k) / grid.nw);
      const double way = way_out(nearest, mesh.X_mm.col(grid.node(i, 0, k)), outwards, body.clear);
      move_column(i, k, std::max(way, 0.0) * outwards, grid, mesh);
    }
}

/// Moves the face of an end onto its bone, and what is behind it along.
void seat_face(const Distance& bone, double away, bool at_origin, const CellGrid& grid,
               Mesh& mesh) {
  for (int j = 0; j <= grid.nv; ++j)
    for (int i = 0; i <= grid.nu; ++i) {
      const Vec3 end = mesh.X_mm.col(grid.node(i, j, at_origin ? 0 : grid.nw));
      const Vec3 move = on_bone(bone, away, end) - end;
      for (int k = 0; k <= grid.nw; ++k) {
        const double beyond = static_cast<double>(at_origin ? k : grid.nw - k) / grid.nw;
        mesh.X_mm.col(grid.node(i, j, k)) += give_way(beyond) * move;
      }
    }
}

std::vector<int> end_nodes(const FibreEnd& end, bool at_origin, const CellGrid& grid) {
  std::vector<int> nodes;
  for (int k = 0; k <= grid.nw; ++k)
    for (int j = 0; j <= grid.nv; ++j)
      for (int i = 0; i <= grid.nu; ++i) {
        const int from_end = at_origin ? k : grid.nw - k;
        const bool by_side = j == 0 && from_end <= seats_by_side(end, grid);
        if (end.side_part > 0 ? by_side : from_end == 0) nodes.push_back(grid.node(i, j, k));
      }
  return nodes;
}

}  // namespace

FibreEnds fibre_body_ends(const FibreBody& body, double h) {
  const CellGrid grid = grid_of(MiddleSurface(body), h);
  return {end_nodes(body.origin, true, grid), end_nodes(body.insertion, false, grid)};
}

Mesh fibre_body_mesh(const FibreBody& body, const Bones& bones, double h) {
  const MiddleSurface surface(body);
  const CellGrid grid = grid_of(surface, h);
  Mesh mesh = grid.fill([&](double u, double v, double w) -> Vec3 {
    const double x = u * std::sqrt(1 - kRoundness * v * v / 2),
                 y = v * std::sqrt(1 - kRoundness * u * u / 2);
    return surface.point(x, w) + y * surface.half_thickness(w) * surface.normal(x, w);
  });
  for (const bool at_origin : {true, false}) {
    const FibreEnd& end = at_origin ? body.origin : body.insertion;
    const Distance& bone = bones.at(end.bone);
    if (end.side_part > 0) {
      seat_side(end, bone, body.seated, at_origin, surface, grid, mesh);
    } else {
      seat_face(bone, body.seated, at_origin, grid, mesh);
    }
  }
  clear_bones(body, bones, surface, grid, mesh);
  const FibreEnds ends = fibre_body_ends(body, h);
  mesh.fibres = fem::conserved_fibres(mesh.X_mm, mesh.tets, ends.origin, ends.insertion);
  return mesh;
}

}  // namespace articular::anatomy
