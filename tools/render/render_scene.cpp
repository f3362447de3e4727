#include "tools/render/render_scene.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGeometryFilter.h>
#include <vtkIdList.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTubeFilter.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/base/error.hpp"
#include "sim/mesh/vtk_files.hpp"
#include "tools/render/colour_map.hpp"
#include "tools/render/render_legend.hpp"

namespace articular::tools {
namespace {

// Every pixel is the mean of 2 x 2: smooth edges on any driver, also where the window can't do it.
constexpr int kSupersampling = 2;

constexpr Rgb kIvory = {0.94, 0.90, 0.80};
constexpr Rgb kPlainTissue = {0.80, 0.52, 0.47};
constexpr Rgb kLigament = {0.80, 0.84, 0.88};
constexpr double kFixedBoneOpacity = 0.32;  // a joint stays visible through the skull

constexpr const char* kShown = "shown";  // the array that is drawn
constexpr const char* kRadius = "radius";

void set_colour(vtkProperty& property, const Rgb& c) { property.SetColor(c[0], c[1], c[2]); }

/// "von_mises" as in a text.
std::string title_of(const std::string& field) {
  if (field == "von_mises") return "von Mises stress";
  std::string title = field;
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

/// The path with equal steps between its points, so that a muscle can have a belly.
Positions resampled(vtkPointSet& set, vtkIdType count, const vtkIdType* nodes, int num_points) {
  std::vector<Vec3> corners;
  std::vector<double> length;  // from the start to each corner
  for (vtkIdType a = 0; a < count; ++a) {
    Vec3 p;
    set.GetPoint(nodes[a], p.data());
    const double step = corners.empty() ? 0 : (p - corners.back()).norm();
    if (!corners.empty() && step == 0) continue;
    length.push_back(corners.empty() ? 0 : length.back() + step);
    corners.push_back(p);
  }
  if (corners.size() < 2) return Positions(3, 0);
  Positions path(3, num_points);
  std::size_t segment = 1;
  for (int i = 0; i < num_points; ++i) {
    const double s = length.back() * i / (num_points - 1);
    while (segment + 1 < corners.size() && length[segment] < s) ++segment;
    const double part = (s - length[segment - 1]) / (length[segment] - length[segment - 1]);
    path.col(i) = corners[segment - 1] + part * (corners[segment] - corners[segment - 1]);
  }
  return path;
}

/// Every pixel the mean of kSupersampling x kSupersampling.
vtkSmartPointer<vtkImageData> averaged(vtkImageData& large, int width, int height) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* const from = static_cast<const unsigned char*>(large.GetScalarPointer());
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  const std::ptrdiff_t row = std::ptrdiff_t{3} * kSupersampling * width;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int j = 0; j < kSupersampling; ++j)
          for (int i = 0; i < kSupersampling; ++i)
            sum += from[(kSupersampling * y + j) * row + 3 * (kSupersampling * x + i) + c];
        *to++ = static_cast<unsigned char>(sum / (kSupersampling * kSupersampling));
      }
  return image;
}

double cell_value(vtkPointSet& set, const char* field, vtkIdType cell, double absent) {
  vtkDataArray* const array = set.GetCellData()->GetArray(field);
  return array != nullptr ? array->GetComponent(cell, 0) : absent;
}

}  // namespace

ViewFit::Borders scene_borders(int width, int height) {
  const double top = std::tan(kHalfViewAngleDeg * std::numbers::pi / 180);
  const double side = top * width / height;
  return {.left = 0.94 * side, .right = 0.72 * side, .bottom = 0.90 * top, .top = 0.84 * top};
}

RenderScene::RenderScene(const Series& series, const Survey& survey, const ViewAxes& axes,
                         const ViewFit& fit, int width, int height)
    : name_(series.name),
      survey_(survey),
      width_(width),
      height_(height),
      line_radius_(0.0065 * fit.diagonal()),
      renderer_(vtkSmartPointer<vtkRenderer>::New()),
      window_(vtkSmartPointer<vtkRenderWindow>::New()) {
  choose_colours();
  renderer_->SetBackground(1, 1, 1);
  renderer_->SetBackground2(0.86, 0.90, 0.94);
  renderer_->GradientBackgroundOn();
  renderer_->UseDepthPeelingOn();  // transparent bones in the right order
  renderer_->SetMaximumNumberOfPeels(8);
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(0.82);
  lights->SetKeyToFillRatio(2.0);
  lights->SetFillLightWarmth(0.52);  // as set by VTK, bluish light turns ivory to grey-green
  lights->SetBackLightWarmth(0.5);
  lights->AddLightsToRenderer(renderer_);

  const Vec3 eye = fit.eye(), focus = eye - fit.depth() * axes.to_eye;
  vtkCamera& camera = *renderer_->GetActiveCamera();
  camera.SetPosition(eye.data());
  camera.SetFocalPoint(focus.data());
  camera.SetViewUp(axes.up.data());
  camera.SetViewAngle(2 * kHalfViewAngleDeg);

  window_->SetShowWindow(false);
  window_->SetUseOffScreenBuffers(true);
  window_->SetAlphaBitPlanes(1);  // for depth peeling,
  window_->SetMultiSamples(0);    // which excludes the window's own smoothing
  window_->SetSize(kSupersampling * width, kSupersampling * height);
  window_->AddRenderer(renderer_);
}

RenderScene::~RenderScene() { window_->Finalize(); }

int RenderScene::pixels(double at_1000_lines) const {
  return std::max(1, static_cast<int>(std::lround(at_1000_lines * kSupersampling *
                                                  std::min(height_, width_) / 1000.0)));
}

void RenderScene::choose_colours() {
  activation_colours_ = colour_table(muscle_colours(), 0, 1);
  if (survey_.field.empty()) return;
  const double rest = rest_value(survey_.field);
  const bool two_sided = survey_.lowest < rest;
  const double largest =
      std::max(std::abs(survey_.lowest - rest), std::abs(survey_.highest - rest));
  // One peak must not take all colours for itself; if it is not far above the rest, it may.
  double reach = largest > 1.5 * survey_.high_percentile ? survey_.high_percentile : largest;
  display_unit_ = survey_.unit == "-" ? "" : survey_.unit;
  if (survey_.unit == "Pa" && reach >= 1e6) {
    display_scale_ = 1e-6;
    display_unit_ = "MPa";
  } else if (survey_.unit == "Pa" && reach >= 1e3) {
    display_scale_ = 1e-3;
    display_unit_ = "kPa";
  }
  reach = round_up(reach * display_scale_);
  const double middle = rest * display_scale_;
  colours_ = two_sided ? colour_table(cool_to_warm(), middle - reach, middle + reach)
                       : colour_table(viridis(), middle, middle + reach);
}

std::string RenderScene::range_text() const {
  if (colours_ == nullptr) return "";
  const double* const range = colours_->GetRange();
  return fmt::format("{:g} to {:g}{}{}", range[0], range[1], display_unit_.empty() ? "" : " ",
                     display_unit_);
}

namespace {

bool has_blank(vtkPolyData& surface, const char* name) {
  vtkDataArray& values = *surface.GetPointData()->GetArray(name);
  for (vtkIdType i = 0; i < values.GetNumberOfTuples(); ++i)
    if (std::isnan(values.GetComponent(i, 0))) return true;
  return false;
}

}  // namespace

vtkActor& RenderScene::add_surface(vtkPolyData& surface) {
  vtkNew<vtkPolyDataNormals> normals;  // smooth, but for edges sharper than this
  normals->SetInputData(&surface);
  normals->SetFeatureAngle(50);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.08);
  actor->GetProperty()->SetSpecular(0.18);
  actor->GetProperty()->SetSpecularPower(25);
  renderer_->AddActor(actor);
  return *actor;
}

void RenderScene::add_coloured(const Part& part, vtkPolyData& surface) {
  vtkActor& actor = add_surface(surface);
  if (!survey_.coloured.contains(part.name)) {
    set_colour(*actor.GetProperty(), kPlainTissue);
    return;
  }
  vtkMapper& mapper = *actor.GetMapper();
  mapper.SetScalarModeToUsePointFieldData();
  mapper.SelectColorArray(kShown);
  mapper.SetLookupTable(colours_);
  mapper.UseLookupTableScalarRangeOn();
  // Values are interpolated, which what is blank has none for: around that, colours are.
  mapper.SetInterpolateScalarsBeforeMapping(has_blank(surface, kShown) ? 0 : 1);
  mapper.ScalarVisibilityOn();
}

void RenderScene::add_tissue(const Part& part) {
  std::vector<double> values = nodal_values(*part.set, survey_.field);
  if (!values.empty()) {
    vtkNew<vtkDoubleArray> shown;
    shown->SetName(kShown);
    for (const double value : values) shown->InsertNextValue(value * display_scale_);
    part.set->GetPointData()->AddArray(shown);
  }
  vtkNew<vtkGeometryFilter> boundary;
  boundary->SetInputData(part.set);
  boundary->Update();
  add_coloured(part, *boundary->GetOutput());
}

void RenderScene::add_bone(const Part& part) {
  if (survey_.coloured.contains(part.name)) return add_tissue(part);
  vtkProperty& property = *add_surface(*vtkPolyData::SafeDownCast(part.set)).GetProperty();
  set_colour(property, kIvory);
  const bool something_inside = !survey_.coloured.empty();
  if (marks_ || (survey_.fixed_bones.contains(part.name) && something_inside))
    property.SetOpacity(kFixedBoneOpacity);
}

void RenderScene::add_lines(const Part& part) {
  add_tubes(*part.set, true);
  add_tubes(*part.set, false);
}

void RenderScene::add_tubes(vtkPointSet& lines, bool muscles) {
  constexpr int kPointsAPath = 33;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> paths;
  vtkNew<vtkDoubleArray> activation, radius;
  activation->SetName(kShown);
  radius->SetName(kRadius);
  for (vtkIdType e = 0; e < lines.GetNumberOfCells(); ++e) {
    const bool is_muscle = cell_value(lines, "kind", e, 0) < 0.5;
    if (is_muscle != muscles) continue;
    vtkNew<vtkIdList> nodes;
    lines.GetCellPoints(e, nodes);
    const Positions path =
        resampled(lines, nodes->GetNumberOfIds(), nodes->GetPointer(0), kPointsAPath);
    if (path.cols() == 0) continue;
    paths->InsertNextCell(kPointsAPath);
    for (int i = 0; i < kPointsAPath; ++i) {
      paths->InsertCellPoint(points->InsertNextPoint(path.col(i).data()));
      // A belly between thin ends, for the eye only: the model has lines.
      const double belly = std::sin(std::numbers::pi * i / (kPointsAPath - 1));
      radius->InsertNextValue(line_radius_ * (muscles ? 0.4 + 0.6 * belly : 0.3));
      activation->InsertNextValue(cell_value(lines, "activation", e, 0));
    }
  }
  if (paths->GetNumberOfCells() == 0) return;
  vtkNew<vtkPolyData> set;
  set->SetPoints(points);
  set->SetLines(paths);
  set->GetPointData()->AddArray(activation);
  set->GetPointData()->SetScalars(radius);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(set);
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tubes->SetNumberOfSides(20);
  tubes->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tubes->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_colour(*actor->GetProperty(), kLigament);
  actor->GetProperty()->SetSpecular(0.25);
  actor->GetProperty()->SetSpecularPower(30);
  if (muscles) {
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray(kShown);
    mapper->SetLookupTable(activation_colours_);
    mapper->UseLookupTableScalarRangeOn();
    if (!marks_) add_activation_scale();
  } else {
    mapper->ScalarVisibilityOff();
  }
  renderer_->AddActor(actor);
}

void RenderScene::add_field_scale() {
  constexpr Box kBar = {0.885, 0.24, 0.018, 0.46};
  constexpr double kGap = 0.008, kLine = 0.034;
  const double* const range = colours_->GetRange();
  add_colour_bar(*renderer_, *colours_, kBar);
  for (const double value : round_labels(range[0], range[1]))
    add_text(*renderer_, fmt::format("{:g}", value), kBar.x + kBar.width + kGap,
             kBar.y + kBar.height * (value - range[0]) / (range[1] - range[0]), {pixels(23)});
  const double middle = kBar.x + kBar.width / 2, top = kBar.y + kBar.height;
  add_text(*renderer_, title_of(survey_.field), middle, top + 2.4 * kLine,
           {pixels(25), true, Align::Centre});
  if (!display_unit_.empty())
    add_text(*renderer_, "[" + display_unit_ + "]", middle, top + 1.3 * kLine,
             {pixels(23), false, Align::Centre});
  const double highest = survey_.highest * display_scale_;
  if (highest > range[1] * (1 + 1e-9))  // else the scale would hide that it ends below the peak
    add_text(*renderer_, fmt::format("peak {:.3g}", highest), middle, kBar.y - 1.3 * kLine,
             {pixels(21), false, Align::Centre});
}

void RenderScene::add_activation_scale() {
  constexpr Box kBar = {0.035, 0.066, 0.13, 0.016};
  constexpr double kGap = 0.03;
  add_colour_bar(*renderer_, *activation_colours_, kBar);
  add_text(*renderer_, "muscle activation", kBar.x, kBar.y + kBar.height + kGap, {pixels(21)});
  add_text(*renderer_, "0", kBar.x, kBar.y - 0.024, {pixels(19)});
  add_text(*renderer_, "1", kBar.x + kBar.width, kBar.y - 0.024, {pixels(19), false, Align::Right});
}

void RenderScene::add_marks() {
  const auto add = [&](const std::vector<Vec3>& corners, int per_cell, const Rgb& colour) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i % static_cast<std::size_t>(per_cell) == 0) cells->InsertNextCell(per_cell);
      cells->InsertCellPoint(points->InsertNextPoint(corners[i].data()));
    }
    vtkNew<vtkPolyData> set;
    set->SetPoints(points);
    if (per_cell == 1)
      set->SetVerts(cells);
    else
      set->SetLines(cells);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(set);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty& property = *actor->GetProperty();
    set_colour(property, colour);
    property.SetPointSize(static_cast<float>(pixels(8)));
    property.SetLineWidth(static_cast<float>(pixels(4)));
    property.LightingOff();
    renderer_->AddActor(actor);
  };
  for (const Marks::Points& points : marks_->points) add(points.at, 1, points.colour);
  for (const Marks::Segment& s : marks_->segments) add({s.from, s.to}, 2, s.colour);
  add_text(*renderer_, marks_->legend, 0.5, 0.035, {pixels(21), false, Align::Centre});
  add_labels();
}

/// Where two would cover each other, the one further down is moved below the other.
void RenderScene::add_labels() {
  struct Placed {
    double x, y, half_width;
    std::string text;
  };
  constexpr double kLine = 0.026, kLetter = 0.008;  // of the picture
  std::vector<Placed> placed;
  for (const Marks::Label& label : marks_->labels) {
    renderer_->SetWorldPoint(label.at.x(), label.at.y(), label.at.z(), 1);
    renderer_->WorldToView();
    const double* const view = renderer_->GetViewPoint();  // from -1 to 1
    placed.push_back({0.5 * (1 + view[0]), 0.5 * (1 + view[1]),
                      0.5 * kLetter * static_cast<double>(label.text.size()), label.text});
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.y > b.y; });
  for (std::size_t i = 0; i < placed.size(); ++i) {
    Placed& label = placed[i];
    for (std::size_t j = 0; j < i; ++j)  // those above, from the top down
      if (std::abs(label.x - placed[j].x) < label.half_width + placed[j].half_width)
        label.y = std::min(label.y, placed[j].y - kLine);
    add_text(*renderer_, label.text, label.x, label.y, {pixels(21), true, Align::Centre});
  }
}

vtkSmartPointer<vtkImageData> RenderScene::draw(const Frame& frame, const std::string& moment) {
  const sim::QuietVtk vtk;
  renderer_->RemoveAllViewProps();
  for (const Part& part : frame.parts) {
    if (part.kind == PartKind::Tissue) add_tissue(part);
    if (part.kind == PartKind::Bone) add_bone(part);
    if (part.kind == PartKind::Lines) add_lines(part);
  }
  add_text(*renderer_, name_, 0.035, 0.945, {pixels(36), true});
  add_text(*renderer_, moment, 0.035, 0.895, {pixels(27)});
  if (colours_ != nullptr) add_field_scale();
  if (marks_) add_marks();
  renderer_->ResetCameraClippingRange();  // nothing is cut away, also not beside the focus
  window_->Render();
  vtkNew<vtkWindowToImageFilter> capture;
  capture->SetInput(window_);
  capture->SetInputBufferTypeToRGB();
  capture->ReadFrontBufferOff();
  capture->ShouldRerenderOff();
  capture->Update();
  if (vtk.failed()) throw sim::SystemError("the display can't draw: " + vtk.message());
  return averaged(*capture->GetOutput(), width_, height_);
}

}  // namespace articular::tools
