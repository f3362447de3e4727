#pragma once

#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/render/colour_map.hpp"
#include "tools/render/render_series.hpp"

class vtkActor;
class vtkPolyData;

namespace articular::tools {

/// Half of the angle of view, measured vertically [degree]: a portrait lens, little distortion.
constexpr double kHalfViewAngleDeg = 12;

/// Borders of the part of the picture where the scene stands: beside the scales, below the title.
ViewFit::Borders scene_borders(int width, int height);

/// Drawn over a frame, in world coordinates of the frame.
struct Marks {
  struct Points {
    std::vector<Vec3> at;
    Rgb colour;
  };
  struct Segment {
    Vec3 from, to;
    Rgb colour;
  };
  struct Label {
    Vec3 at;
    std::string text;
  };
  std::vector<Points> points;
  std::vector<Segment> segments;
  std::vector<Label> labels;
  std::string legend;
};

/// Draws frames off-screen, all with the same eye and the same colours. Needs a display while it
/// lives.
class RenderScene {
 public:
  RenderScene(const Series& series, const Survey& survey, const ViewAxes& axes, const ViewFit& fit,
              int width, int height);
  ~RenderScene();
  RenderScene(const RenderScene&) = delete;
  RenderScene& operator=(const RenderScene&) = delete;

  /// RGB. @param moment  of the frame, in words @throws SystemError when the display can't draw
  vtkSmartPointer<vtkImageData> draw(const Frame& frame, const std::string& moment);

  /// Of all pictures from now on. Bones become transparent, so that no mark is hidden.
  void set_marks(Marks marks) { marks_ = std::move(marks); }

  /// "0 to 120 kPa": what the colours mean.
  std::string range_text() const;

 private:
  void choose_colours();
  void add_tissue(const Part& part);
  void add_bone(const Part& part);
  void add_lines(const Part& part);
  void add_coloured(const Part& part, vtkPolyData& surface);
  vtkActor& add_surface(vtkPolyData& surface);
  void add_tubes(vtkPointSet& lines, bool muscles);
  void add_marks();
  void add_labels();
  void add_field_scale();
  void add_activation_scale();
  int pixels(double at_1000_lines) const;

  std::string name_;
  Survey survey_;
  int width_, height_;
  double line_radius_;
  double display_scale_ = 1;  // unit of the file -> unit shown
  std::string display_unit_;
  std::optional<Marks> marks_;
  vtkSmartPointer<vtkLookupTable> colours_, activation_colours_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkRenderWindow> window_;
};

}  // namespace articular::tools
