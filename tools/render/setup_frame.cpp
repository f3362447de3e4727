#include "tools/render/setup_frame.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include "sim/lines/line_path.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::tools {
namespace {

constexpr Rgb kAttached = {0.80, 0.10, 0.10}, kSupported = {0.10, 0.55, 0.20},
              kLineEnd = {0.10, 0.25, 0.75};

vtkSmartPointer<vtkPointSet> lines_of(const sim::Model& model, const sim::Configuration& now,
                                      double unit) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> paths;
  vtkNew<vtkDoubleArray> kind;
  kind->SetName("kind");
  vtkNew<vtkStringArray> name;
  name->SetName("name");
  for (const sim::Line& line : model.lines) {
    const std::vector<sim::WeightedPoint> path = sim::path_from_start(model, line, now);
    paths->InsertNextCell(static_cast<int>(path.size()));
    for (const sim::WeightedPoint& point : path) {
      const Vec3 x = now.position(point) / unit;
      paths->InsertCellPoint(points->InsertNextPoint(x.data()));
    }
    kind->InsertNextValue(line.muscle >= 0 ? 0 : 1);
    name->InsertNextValue(line.name);
  }
  auto set = vtkSmartPointer<vtkPolyData>::New();
  set->SetPoints(points);
  set->SetLines(paths);
  set->GetCellData()->AddArray(kind);
  set->GetCellData()->AddArray(name);
  return set;
}

}  // namespace

Frame start_frame(const sim::Model& model, const sim::Configuration& now, double unit) {
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

Marks::Points attached_nodes(const sim::Model& model, double unit) {
  Marks::Points attached{{}, kAttached};
  for (const sim::Tissue& tissue : model.tissues)
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i)
      if (tissue.nodes[i].rigid >= 0)
        attached.at.emplace_back(tissue.X.col(static_cast<Eigen::Index>(i)) / unit);
  return attached;
}

Marks::Points supported_nodes(const sim::Model& model, double unit) {
  Marks::Points supported{{}, kSupported};
  for (const sim::SupportModel& support : model.supports)
    for (const sim::SupportModel::Node& node : support.nodes)
      supported.at.emplace_back(
          model.tissues[static_cast<std::size_t>(support.tissue)].X.col(node.node) / unit);
  return supported;
}

Marks::Points line_ends(const sim::Model& model, const sim::Configuration& now, double unit) {
  Marks::Points ends{{}, kLineEnd};
  for (const sim::Line& line : model.lines)
    for (const sim::WeightedPoint* point : {&line.path.front(), &line.path.back()})
      ends.at.emplace_back(now.position(*point) / unit);
  return ends;
}

}  // namespace articular::tools
