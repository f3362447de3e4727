#include "tools/render/setup_picture.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cmath>
#include <numbers>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/lines/line_path.hpp"
#include "sim/mesh/vtk_files.hpp"
#include "sim/model/configuration.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/render_scene.hpp"
#include "tools/render/virtual_display.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr Rgb kAttached = {0.80, 0.10, 0.10}, kSupported = {0.10, 0.55, 0.20},
              kLineEnd = {0.10, 0.25, 0.75}, kScaleColour = {0.16, 0.19, 0.23};
constexpr Rgb kAxes[] = {{0.75, 0.15, 0.15}, {0.15, 0.55, 0.15}, {0.15, 0.25, 0.75}};

void refuse_frames(const RenderOptions& options) {
  if (options.all || options.frame || !options.movie.empty() || !options.field.empty() ||
      !options.only.empty())
    throw sim::InputError({options.run.string()},
                          "a scenario has no frames and no fields yet: expected none of --all, "
                          "--frame, --movie, --field, --only; or the folder of a run");
}

vtkSmartPointer<vtkPointSet> lines_of(const sim::Model& model, const sim::Configuration& now,
                                      double unit) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> paths;
  vtkNew<vtkDoubleArray> kind;
  kind->SetName("kind");
  for (const sim::Line& line : model.lines) {
    const std::vector<sim::WeightedPoint> path = sim::path_from_start(model, line, now);
    paths->InsertNextCell(static_cast<int>(path.size()));
    for (const sim::WeightedPoint& point : path) {
      const Vec3 x = now.position(point) / unit;
      paths->InsertCellPoint(points->InsertNextPoint(x.data()));
    }
    kind->InsertNextValue(line.muscle >= 0 ? 0 : 1);
  }
  auto set = vtkSmartPointer<vtkPolyData>::New();
  set->SetPoints(points);
  set->SetLines(paths);
  set->GetCellData()->AddArray(kind);
  return set;
}

Frame start_of(const sim::Model& model, const sim::Configuration& now, double unit) {
  Frame frame{0, 0, {}};
  for (const sim::BodyModel& body : model.bodies) {
    if (body.tissue >= 0) {
      const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
      frame.parts.push_back({body.name, PartKind::Tissue,
                             sim::make_grid(tissue.X, unit, tissue.elements.tets(), {})});
    } else if (body.X.cols() > 0) {
      frame.parts.push_back(
          {body.name, PartKind::Bone,
           sim::make_surface(start_positions(model, body), unit, body.triangles)});
    }
  }
  if (!model.lines.empty())
    frame.parts.push_back({"lines", PartKind::Lines, lines_of(model, now, unit)});
  return frame;
}

void add_bodies(const Frame& frame, Marks& marks) {
  for (const Part& part : frame.parts) {
    if (part.kind == PartKind::Lines) continue;
    double box[6];
    part.set->GetBounds(box);
    marks.labels.push_back(
        {0.5 * Vec3(box[0] + box[1], box[2] + box[3], box[4] + box[5]), part.name});
  }
}

void add_attached_nodes(const sim::Model& model, double unit, Marks& marks) {
  Marks::Points attached{{}, kAttached};
  for (const sim::Tissue& tissue : model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].rigid >= 0)
        attached.at.emplace_back(tissue.X.col(static_cast<Eigen::Index>(i)) / unit);
  marks.points.push_back(std::move(attached));
}

void add_supported_nodes(const sim::Model& model, double unit, Marks& marks) {
  Marks::Points supported{{}, kSupported};
  for (const sim::SupportModel& support : model.supports)
    for (const sim::SupportModel::Node& node : support.nodes)
      supported.at.emplace_back(
          model.tissues[static_cast<std::size_t>(support.tissue)].X.col(node.node) / unit);
  marks.points.push_back(std::move(supported));
}

void add_line_ends(const sim::Model& model, const sim::Configuration& now, double unit,
                   Marks& marks) {
  Marks::Points ends{{}, kLineEnd};
  for (const sim::Line& line : model.lines)
    for (const sim::WeightedPoint* point : {&line.path.front(), &line.path.back()})
      ends.at.emplace_back(now.position(*point) / unit);
  marks.points.push_back(std::move(ends));
}

/// Across the picture from its middle, in halves of its height, as deep as the middle of the scene.
class MiddlePlane {
 public:
  MiddlePlane(const ViewFit& fit, const ViewAxes& axes)
      : axes_(axes), depth_((fit.eye() - fit.middle()).dot(axes.to_eye)) {
    middle_ = fit.eye() - depth_ * axes.to_eye;
  }
  double half() const { return depth_ * std::tan(kHalfViewAngleDeg * std::numbers::pi / 180); }
  Vec3 at(double right, double up) const {
    return middle_ + half() * (right * axes_.right + up * axes_.up);
  }

 private:
  ViewAxes axes_;
  double depth_;
  Vec3 middle_;
};

/// Lower left in the picture.
void add_axes(const MiddlePlane& plane, double aspect, Marks& marks) {
  const Vec3 origin = plane.at(-0.84 * aspect, -0.76);
  const double length = 0.13 * plane.half();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = length * Vec3::Unit(k);
    marks.segments.push_back({origin, origin + axis, kAxes[k]});
    marks.labels.push_back({origin + 1.25 * axis, std::string(1, static_cast<char>('x' + k))});
  }
}

/// The largest of 1, 2, 5 times a power of ten that is not above the value.
double round_down(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= value) return digit * power;
  return power;
}

/// Lower right in the picture, as long as it would be in the middle of the scene.
void add_scale(const MiddlePlane& plane, double aspect, const std::string& unit, Marks& marks) {
  constexpr double kMiddle = 0.75, kHeight = -0.92;
  const double length = round_down(0.3 * plane.half() * aspect), half = 0.5 * length / plane.half();
  marks.segments.push_back({plane.at(kMiddle * aspect - half, kHeight),
                            plane.at(kMiddle * aspect + half, kHeight), kScaleColour});
  marks.labels.push_back(
      {plane.at(kMiddle * aspect, kHeight + 0.05), fmt::format("{:g} {}", length, unit)});
}

}  // namespace

int render_setup(const RenderOptions& options) {
  refuse_frames(options);
  const ViewAxes axes = view_axes(options.view, options.up);
  const sim::Scenario scenario = sim::read_scenario(options.run);
  const sim::Model model = sim::build_model(scenario);
  const double unit = scenario.output.length_unit.metres;
  sim::Configuration now;
  sim::read_state(model, sim::initial_state(model).data(), 0, now);
  const Frame frame = start_of(model, now, unit);
  if (frame.parts.empty())
    throw sim::InputError({options.run.string()}, "no body of this scenario has a mesh to draw");

  ViewFit fit(axes, scene_borders(options.width, options.height));
  bool focus_found = options.focus.empty();
  for (const Part& part : frame.parts) {
    if (!options.focus.empty() && part.name != options.focus) continue;
    focus_found = true;
    add_points(*part.set, fit);
  }
  if (!focus_found)
    throw sim::InputError({options.run.string()},
                          "--focus: no body with a mesh is called `" + options.focus + "`");
  Marks marks;
  add_bodies(frame, marks);
  add_attached_nodes(model, unit, marks);
  add_supported_nodes(model, unit, marks);
  add_line_ends(model, now, unit, marks);
  const MiddlePlane plane(fit, axes);
  const double aspect = static_cast<double>(options.width) / options.height;
  add_axes(plane, aspect, marks);
  add_scale(plane, aspect, scenario.output.length_unit.name, marks);
  marks.legend = std::string("red: attached nodes; ") +
                 (model.supports.empty() ? "" : "green: supported nodes; ") +
                 "blue: ends of muscles and ligaments";

  const fs::path folder = options.out.empty() ? fs::path(".") : options.out;
  make_folder(folder);
  const VirtualDisplay display;
  RenderScene picture({scenario.name, {}, {}, {}}, {}, axes, fit, options.width, options.height);
  picture.set_marks(std::move(marks));
  const fs::path file = (folder / (scenario.name + "_setup.png")).lexically_normal();
  write_png(file, *picture.draw(frame, "set-up"));
  fmt::print("wrote {}\n", file.string());
  return 0;
}

}  // namespace articular::tools
