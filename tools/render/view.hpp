#pragma once

#include <string>

#include "fem/base/types.hpp"
#include "tools/render/run_summary.hpp"

class vtkPointSet;

/// From where a scene is seen. Pictures are parallel projections: a length across the picture is
/// the same wherever it lies in depth, so that a scale bar holds everywhere.
namespace articular::tools {

/// The directions of a picture in world coordinates: right and up in it, and from the scene to the
/// eye.
struct ViewAxes {
  Vec3 right, up, to_eye;
};

/// Where the eye is, seen from the scene: towards the body's left, back and top.
/// @param view  "front", "top", ...
/// @param up    "y" (z anterior) or "z" (y posterior); "": as `directions` say, else z
/// @throws InputError for another one
ViewAxes view_axes(const std::string& view, const std::string& up, const Directions& directions);

/// The box, along the axes of a view, around all points seen so far.
class ViewBox {
 public:
  explicit ViewBox(const ViewAxes& axes) : axes_(axes) {}
  void add(const Vec3& p);
  void add(vtkPointSet& set);
  bool is_empty() const { return low_.x() > high_.x(); }
  /// Along right, up and to_eye.
  Vec3 size() const { return high_ - low_; }
  Vec3 middle() const;  // in world coordinates

 private:
  ViewAxes axes_;
  Vec3 low_ = Vec3::Constant(1e300), high_ = Vec3::Constant(-1e300);
};

/// Half of the height that a panel of this width by height has to show for a box of this size to
/// lie in it with a small margin.
double half_height_for(const Vec3& size, double width_by_height);

}  // namespace articular::tools
