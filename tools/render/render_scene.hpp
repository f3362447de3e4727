#pragma once

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/render/colour_scale.hpp"
#include "tools/render/layers.hpp"
#include "tools/render/look.hpp"
#include "tools/render/marks.hpp"
#include "tools/render/page.hpp"
#include "tools/render/render_legend.hpp"
#include "tools/render/skin.hpp"
#include "tools/render/survey.hpp"
#include "tools/render/tubes.hpp"

class vtkActor;
class vtkPolyData;

namespace articular::tools {

/// One of the scenes that stand side by side in a picture.
struct Panel {
  const Frame& frame;
  std::string title, moment;
  Vec3 middle;  // of what is seen, in world coordinates
};

/// What all pictures have in common.
struct Setting {
  Page page;
  Look look;
  ViewAxes axes;
  Directions directions;
  Survey survey;
  std::optional<ColourScale> field;  // of the survey's field, if it has one
  int num_panels = 1;
};

/// Draws frames off-screen, all from the same direction, with the same scale and the same colours.
/// Surfaces with a field are drawn without light, and nothing translucent lies over them: their
/// colours are those of the scale. Their shape shows in outlines. Needs a display while it lives.
class RenderScene {
 public:
  explicit RenderScene(Setting setting);
  ~RenderScene();
  RenderScene(const RenderScene&) = delete;
  RenderScene& operator=(const RenderScene&) = delete;

  /// RGB, or RGBA on transparent paper. @param panels  as many as the setting says
  /// @throws SystemError when the display can't draw
  Image draw(const std::vector<Panel>& panels);

  /// Of all pictures from now on. Bones become translucent, so that no mark is hidden.
  void set_marks(Marks marks) { marks_ = std::move(marks); }

 private:
  /// One whose colours are those of a scale, or one in light.
  enum class Surface { Coloured, Lit };
  void place_cameras();
  void add_part(vtkRenderer& panel, const Part& part);
  void add_body(vtkRenderer& panel, const Part& part);
  Surface add_skin(vtkRenderer& panel, const Part& part, const Skin& skin);
  void add_lines(vtkRenderer& panel, const Part& part);
  void add_tubes(vtkRenderer& panel, LineKind kind, vtkPolyData& tubes, const ColourScale* scale);
  vtkActor& add_surface(vtkRenderer& panel, vtkPolyData& surface);
  void add_outline(vtkRenderer& panel, vtkPolyData& surface, Surface of);
  /// Lines that lie in a surface. @param width  of the page's text
  void add_ink(vtkRenderer& panel, vtkPolyData& lines, double width, Surface of);
  void colour_by(const ColourScale& scale, bool per_cell, vtkActor& actor);
  double opacity_of(const Part& part, bool has_values) const;
  void add_marks(vtkRenderer& panel);
  void add_labels(vtkRenderer& panel, const Rect& rect);
  void add_sheet(const std::vector<Panel>& panels);
  Image composed();
  void draw_mask();

  Setting setting_;
  Page fine_;  // the page in the window's pixels
  PageLayout layout_;
  double half_height_ = 1;  // of what a panel shows, in the unit of the files
  double line_radius_ = 0;
  std::optional<ColourScale> activation_, tension_;
  std::optional<Marks> marks_;
  std::vector<vtkActor*> coloured_, translucent_;  // of what is being drawn
  vtkSmartPointer<vtkRenderer> sheet_, labels_;    // behind the panels and before them
  std::vector<vtkSmartPointer<vtkRenderer>> panels_;
  vtkSmartPointer<vtkRenderWindow> window_;
};

}  // namespace articular::tools
