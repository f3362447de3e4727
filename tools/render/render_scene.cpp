#include "tools/render/render_scene.hpp"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "tools/render/fibre_strokes.hpp"

namespace articular::tools {
namespace {

// Every pixel is the mean of 2 x 2: smooth edges on any driver, also where the window can't do it.
constexpr int kSupersampling = 2;

constexpr Rgb kIvory = {0.94, 0.90, 0.80};
constexpr Rgb kPlainTissue = {0.80, 0.52, 0.47};
constexpr Rgb kPlainLine = {0.80, 0.84, 0.88};
constexpr double kBoneOpacity = 0.3;                        // where it would hide what is coloured
constexpr double kOutlineWidth = 0.09, kEdgeWidth = 0.045;  // of the page's text

void set_colour(vtkProperty& property, const Rgb& c) { property.SetColor(c[0], c[1], c[2]); }

/// Left empty where no scale stands beside the scene.
double strip_width(const Page& page, const Setting& setting) {
  return std::max(axes_width(page, setting.axes, setting.directions),
                  setting.field ? legend_width(page, *setting.field) : 0);
}

}  // namespace

RenderScene::RenderScene(Setting setting)
    : setting_(std::move(setting)),
      fine_(finer(setting_.page, kSupersampling)),
      layout_(lay_out(fine_, setting_.num_panels, strip_width(fine_, setting_))),
      line_radius_(0.0065 * setting_.survey.size.norm()),
      sheet_(vtkSmartPointer<vtkRenderer>::New()),
      labels_(vtkSmartPointer<vtkRenderer>::New()),
      window_(vtkSmartPointer<vtkRenderWindow>::New()) {
  const Survey& seen = setting_.survey;
  if (!seen.of_lines) {
    if (seen.has_muscles) activation_ = activation_scale();
    if (seen.highest_tension) tension_ = tension_scale(*seen.highest_tension);
  }
  window_->SetShowWindow(false);
  window_->SetUseOffScreenBuffers(true);
  window_->SetAlphaBitPlanes(1);  // for depth peeling,
  window_->SetMultiSamples(0);    // which excludes the window's own smoothing
  window_->SetSize(fine_.width, fine_.height);
  window_->SetNumberOfLayers(3);
  window_->AddRenderer(sheet_);
  labels_->SetLayer(2);
  window_->AddRenderer(labels_);
  for (int i = 0; i < setting_.num_panels; ++i) {
    panels_.push_back(vtkSmartPointer<vtkRenderer>::New());
    vtkRenderer& panel = *panels_.back();
    panel.SetLayer(1);
    panel.UseDepthPeelingOn();  // translucent bones in the right order
    panel.SetMaximumNumberOfPeels(8);
    vtkNew<vtkLightKit> lights;
    lights->SetKeyLightIntensity(0.82);
    lights->SetKeyToFillRatio(2.0);
    lights->SetFillLightWarmth(0.52);  // as set by VTK, bluish light turns ivory to grey-green
    lights->SetBackLightWarmth(0.5);
    lights->AddLightsToRenderer(&panel);
    window_->AddRenderer(&panel);
  }
  place_cameras();
}

RenderScene::~RenderScene() { window_->Finalize(); }

void RenderScene::place_cameras() {
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const Rect& r = layout_.panels[i];
    panels_[i]->SetViewport(r.x / fine_.width, r.y / fine_.height, (r.x + r.width) / fine_.width,
                            (r.y + r.height) / fine_.height);
    half_height_ = half_height_for(setting_.survey.size, r.width / r.height);
    vtkCamera& camera = *panels_[i]->GetActiveCamera();
    camera.ParallelProjectionOn();
    camera.SetParallelScale(half_height_);
    camera.SetViewUp(setting_.axes.up.data());
  }
}

vtkActor& RenderScene::add_surface(vtkRenderer& panel, vtkPolyData& surface) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&surface);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty& property = *actor->GetProperty();
  if (setting_.look.mesh_edges) {
    const Rgb& ink = setting_.look.paper.ink;
    property.EdgeVisibilityOn();
    property.SetEdgeColor(ink[0], ink[1], ink[2]);
    property.SetLineWidth(static_cast<float>(std::max(1.0, kEdgeWidth * fine_.text)));
  }
  panel.AddActor(actor);
  return *actor;
}

void RenderScene::add_outline(vtkRenderer& panel, vtkPolyData& surface, Surface of) {
  if (surface.GetNumberOfCells() == 0) return;
  // Light shows how a surface bends.
  add_ink(panel,
          *outline_of(surface, *panel.GetActiveCamera(),
                      of == Surface::Lit ? Outline::Contour : Outline::ContourAndBends),
          kOutlineWidth, of);
}

void RenderScene::add_ink(vtkRenderer& panel, vtkPolyData& lines, double width, Surface of) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&lines);
  mapper->ScalarVisibilityOff();
  // In front of the surface that they lie in, by 20/65536 of the depth that the camera sees.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0, -20);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty& property = *actor->GetProperty();
  set_colour(property, setting_.look.paper.ink);
  property.SetLineWidth(static_cast<float>(std::max(1.0, width * fine_.text)));
  property.LightingOff();
  panel.AddActor(actor);
  if (of == Surface::Coloured) coloured_.push_back(actor);
}

void RenderScene::colour_by(const ColourScale& scale, bool per_cell, vtkActor& actor) {
  vtkMapper& mapper = *actor.GetMapper();
  if (per_cell)
    mapper.SetScalarModeToUseCellFieldData();
  else
    mapper.SetScalarModeToUsePointFieldData();
  mapper.SelectColorArray(kShown);
  mapper.SetLookupTable(scale.colours);
  mapper.UseLookupTableScalarRangeOn();
  // Values are interpolated, not colours: a mean of two colours may be one that the scale lacks.
  mapper.SetInterpolateScalarsBeforeMapping(per_cell ? 0 : 1);
  mapper.ScalarVisibilityOn();
  actor.GetProperty()->LightingOff();
  coloured_.push_back(&actor);
}

double RenderScene::opacity_of(const Part& part, bool has_values) const {
  const auto& asked = setting_.look.opacity;
  if (const auto found = asked.find(part.name); found != asked.end()) return found->second;
  if (part.kind != PartKind::Bone || has_values) return 1;
  return marks_ || !setting_.survey.coloured.empty() ? kBoneOpacity : 1;
}

RenderScene::Surface RenderScene::add_skin(vtkRenderer& panel, const Part& part, const Skin& skin) {
  vtkActor& actor = add_surface(panel, *skin.faces);
  // Seen through, colours would mix: a translucent body has no field.
  const double opacity = opacity_of(part, skin.has_values);
  if (skin.has_values && opacity == 1) {
    colour_by(*setting_.field, skin.per_cell, actor);
    return Surface::Coloured;
  }
  vtkNew<vtkPolyDataNormals> normals;  // smooth, but for edges sharper than this
  normals->SetInputData(skin.faces);
  normals->SetFeatureAngle(50);
  actor.GetMapper()->SetInputConnection(normals->GetOutputPort());
  vtkProperty& property = *actor.GetProperty();
  set_colour(property, part.kind == PartKind::Tissue ? kPlainTissue : kIvory);
  property.SetAmbient(0.08);
  property.SetSpecular(0.18);
  property.SetSpecularPower(25);
  property.SetOpacity(opacity);
  if (opacity < 1) translucent_.push_back(&actor);
  return Surface::Lit;
}

void RenderScene::add_body(vtkRenderer& panel, const Part& part) {
  const Survey& seen = setting_.survey;
  const FieldValues values =
      seen.coloured.contains(part.name) ? drawn_values(part, seen) : FieldValues{};
  const double factor = setting_.field ? setting_.field->factor : 1;
  const Skin skin = skin_of(part, values, factor, setting_.look.clip, metres_of(seen.length_unit));
  if (skin.faces->GetNumberOfCells() > 0) {
    const Surface surface = add_skin(panel, part, skin);
    add_outline(panel, *skin.faces, surface);
    if (setting_.look.fibres) add_ink(panel, *fibre_strokes(*skin.faces), kEdgeWidth, surface);
  }
  if (skin.blank == nullptr) return;
  vtkActor& blank = add_surface(panel, *skin.blank);
  set_colour(*blank.GetProperty(), kBlankColour);
  blank.GetProperty()->LightingOff();
  coloured_.push_back(&blank);
  add_outline(panel, *skin.blank, Surface::Coloured);
}

void RenderScene::add_tubes(vtkRenderer& panel, LineKind kind, vtkPolyData& tubes,
                            const ColourScale* scale) {
  const auto& clip = setting_.look.clip;
  vtkSmartPointer<vtkPolyData> shown = &tubes;
  if (tubes.GetNumberOfCells() > 0 && clip)
    shown =
        vtkPolyData::SafeDownCast(clipped(tubes, *clip, metres_of(setting_.survey.length_unit)));
  if (shown->GetNumberOfCells() == 0) return;
  vtkActor& actor = add_surface(panel, *shown);
  actor.GetProperty()->EdgeVisibilityOff();  // a tube is no mesh of the model
  set_colour(*actor.GetProperty(), kPlainLine);
  if (scale != nullptr) colour_by(*scale, false, actor);
  if (kind == LineKind::Muscle)  // a cord is hardly thicker than its outlines
    add_outline(panel, *shown, scale != nullptr ? Surface::Coloured : Surface::Lit);
}

void RenderScene::add_lines(vtkRenderer& panel, const Part& part) {
  const Survey& seen = setting_.survey;
  const auto add = [&](LineKind kind, const std::optional<ColourScale>& own,
                       const std::string& own_field) {
    const auto& scale = seen.of_lines ? setting_.field : own;
    add_tubes(panel, kind,
              *tubes_of(*part.set, kind, line_radius_, seen.of_lines ? seen.field : own_field,
                        scale ? scale->factor : 1),
              scale ? &*scale : nullptr);
  };
  add(LineKind::Muscle, activation_, "activation");
  add(LineKind::Ligament, tension_, "force");
}

void RenderScene::add_part(vtkRenderer& panel, const Part& part) {
  if (part.kind == PartKind::Lines)
    add_lines(panel, part);
  else
    add_body(panel, part);
}

void RenderScene::add_marks(vtkRenderer& panel) {
  for (const Marks::Points& points : marks_->points) {
    vtkNew<vtkPoints> at;
    vtkNew<vtkCellArray> dots;
    for (const Vec3& p : points.at) {
      dots->InsertNextCell(1);
      dots->InsertCellPoint(at->InsertNextPoint(p.data()));
    }
    vtkNew<vtkPolyData> set;
    set->SetPoints(at);
    set->SetVerts(dots);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(set);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    set_colour(*actor->GetProperty(), points.colour);
    actor->GetProperty()->SetPointSize(static_cast<float>(0.32 * fine_.text));
    actor->GetProperty()->LightingOff();
    panel.AddActor(actor);
  }
}

/// Where two would cover each other, the one further down is moved below the other.
void RenderScene::add_labels(vtkRenderer& panel, const Rect& rect) {
  struct Placed {
    double x, y, half_width;
    std::string text;
  };
  constexpr double kSize = 0.85;
  std::vector<Placed> placed;
  for (const Marks::Label& label : marks_->labels) {
    panel.SetWorldPoint(label.at.x(), label.at.y(), label.at.z(), 1);
    panel.WorldToView();
    const double* const view = panel.GetViewPoint();  // from -1 to 1
    placed.push_back({rect.x + 0.5 * (1 + view[0]) * rect.width,
                      rect.y + 0.5 * (1 + view[1]) * rect.height,
                      0.5 * text_width(label.text, kSize * fine_.text, true), label.text});
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.y > b.y; });
  const Sheet sheet{*labels_, fine_, setting_.look.paper.ink};
  for (std::size_t i = 0; i < placed.size(); ++i) {
    Placed& label = placed[i];
    for (std::size_t j = 0; j < i; ++j)  // those above, from the top down
      if (std::abs(label.x - placed[j].x) < label.half_width + placed[j].half_width)
        label.y = std::min(label.y, placed[j].y - 1.1 * kSize * fine_.text);
    add_text(sheet, label.text, label.x, label.y,
             {kSize, true, Align::Centre, setting_.look.paper.ground});
  }
}

void RenderScene::add_sheet(const std::vector<Panel>& panels) {
  const Sheet sheet{*sheet_, fine_, setting_.look.paper.ink};
  for (std::size_t i = 0; i < panels.size(); ++i)
    add_heading(sheet, layout_.headings[i], panels[i].title, panels[i].moment);
  if (setting_.field) add_field_legend(sheet, layout_.legend, *setting_.field);
  add_axes(sheet, layout_.legend, setting_.axes, setting_.directions);
  const double pixel = 2 * half_height_ / layout_.panels.front().height;
  add_scale_bar(sheet, layout_.foot, pixel, setting_.survey.length_unit);
  if (marks_) {
    add_text(sheet, marks_->legend, layout_.foot.x, layout_.foot.y + 1.6 * fine_.text, {0.9});
    return;
  }
  std::vector<ColourScale> scales;
  for (const auto& scale : {activation_, tension_})
    if (scale) scales.push_back(*scale);
  add_line_legends(sheet, layout_.foot, scales);
}

/// White where a colour of a scale is seen, else black.
void RenderScene::draw_mask() {
  sheet_->RemoveAllViewProps();
  sheet_->SetBackground(0, 0, 0);
  const auto paint = [](vtkActor& actor, double c) {
    actor.GetMapper()->ScalarVisibilityOff();
    vtkProperty& property = *actor.GetProperty();
    property.SetColor(c, c, c);
    property.LightingOff();
    property.EdgeVisibilityOff();
  };
  for (const auto& panel : panels_) {
    vtkActorCollection& actors = *panel->GetActors();
    actors.InitTraversal();
    while (vtkActor* const actor = actors.GetNextActor()) paint(*actor, 0);
  }
  for (vtkActor* const actor : coloured_) paint(*actor, 1);
}

Image RenderScene::composed() {
  std::vector<Rgb> grounds = {setting_.look.paper.ground};
  if (setting_.look.paper.transparent) grounds = {{1, 1, 1}, {0, 0, 0}};
  const bool veils = !coloured_.empty() && !translucent_.empty();
  std::vector<Image> veiled, unveiled;
  for (const Rgb& ground : grounds) {
    sheet_->SetBackground(ground[0], ground[1], ground[2]);
    veiled.push_back(drawn(*window_));
    if (!veils) continue;
    for (vtkActor* const actor : translucent_) actor->VisibilityOff();
    unveiled.push_back(drawn(*window_));
    for (vtkActor* const actor : translucent_) actor->VisibilityOn();
  }
  if (veils) {
    for (vtkActor* const actor : translucent_) actor->VisibilityOff();
    draw_mask();
    const Image mask = drawn(*window_);
    for (std::size_t i = 0; i < veiled.size(); ++i)
      veiled[i] = unveiled_where(*mask, *unveiled[i], *veiled[i]);
  }
  for (Image& image : veiled) image = averaged(*image, kSupersampling);
  return veiled.size() == 2 ? with_opacity(*veiled[0], *veiled[1]) : veiled.front();
}

Image RenderScene::draw(const std::vector<Panel>& panels) {
  coloured_.clear();
  translucent_.clear();
  sheet_->RemoveAllViewProps();
  labels_->RemoveAllViewProps();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    vtkRenderer& panel = *panels_[i];
    panel.RemoveAllViewProps();
    // The outlines need the camera.
    const Vec3 focus = panels[i].middle,
               eye = focus + 2 * setting_.survey.diagonal * setting_.axes.to_eye;
    panel.GetActiveCamera()->SetFocalPoint(focus.data());
    panel.GetActiveCamera()->SetPosition(eye.data());
    for (const Part& part : panels[i].frame.parts) add_part(panel, part);
    if (marks_) {
      add_marks(panel);
      add_labels(panel, layout_.panels[i]);
    }
    panel.ResetCameraClippingRange();  // nothing is cut away, also not beside the focus
  }
  add_sheet(panels);
  return composed();
}

}  // namespace articular::tools
