#include "tools/render/clip.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkClipClosedSurface.h>
#include <vtkClipPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "fem/base/types.hpp"
#include "sim/base/error.hpp"
#include "sim/scenario/quantity.hpp"

namespace articular::tools {
namespace {

/// Its function is positive where something is kept.
vtkSmartPointer<vtkPlane> plane_of(const Clip& clip, double unit) {
  auto plane = vtkSmartPointer<vtkPlane>::New();
  const Vec3 origin = clip.at / unit * Vec3::Unit(clip.axis),
             normal = (clip.below ? -1.0 : 1.0) * Vec3::Unit(clip.axis);
  plane->SetOrigin(origin.data());
  plane->SetNormal(normal.data());
  return plane;
}

vtkSmartPointer<vtkPolyData> clipped_faces(vtkPolyData& surface, const Clip& clip, double unit) {
  vtkNew<vtkClipPolyData> cut;
  cut->SetInputData(&surface);
  cut->SetClipFunction(plane_of(clip, unit));
  cut->Update();
  return cut->GetOutput();
}

bool is_closed(vtkPolyData& surface) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(&surface);
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->ColoringOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells() == 0;
}

/// The faces on the cut get points of their own: the edge around them is sharp, and light does not
/// run over it.
vtkSmartPointer<vtkPolyData> with_own_points_on(vtkPlane& plane, vtkPolyData& surface) {
  const double round_off = 1e-6 * surface.GetLength();
  vtkNew<vtkPoints> points;
  points->DeepCopy(surface.GetPoints());
  std::map<vtkIdType, vtkIdType> own;
  vtkNew<vtkCellArray> faces;
  vtkNew<vtkIdList> corners;
  for (vtkIdType face = 0; face < surface.GetNumberOfCells(); ++face) {
    surface.GetCellPoints(face, corners);
    const bool on_cut = std::all_of(corners->begin(), corners->end(), [&](vtkIdType i) {
      return std::abs(plane.EvaluateFunction(surface.GetPoint(i))) < round_off;
    });
    faces->InsertNextCell(static_cast<int>(corners->GetNumberOfIds()));
    for (const vtkIdType i : *corners) {
      if (on_cut && !own.contains(i)) own[i] = points->InsertNextPoint(surface.GetPoint(i));
      faces->InsertCellPoint(on_cut ? own.at(i) : i);
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(faces);
  return result;
}

}  // namespace

Clip parse_clip(const std::string& text) {
  const auto fail = [&](const std::string& why) {
    throw sim::InputError(
        "--clip: expected what is kept, as an axis, < or > and a length, e.g. "
        "\"y<12mm\", not `" +
        text + "`" + why);
  };
  std::string compact = text;
  std::erase(compact, ' ');
  if (compact.size() < 3 || compact[0] < 'x' || compact[0] > 'z' ||
      (compact[1] != '<' && compact[1] != '>'))
    fail("");
  Clip clip{compact[0] - 'x', 0, compact[1] == '<'};
  try {
    // "12mm" as a scenario would write it: "12 mm".
    std::string length = compact.substr(2);
    if (const auto letter = length.find_first_of("cmuk"); letter != std::string::npos)
      length.insert(letter, " ");
    clip.at = sim::parse_quantity(length, sim::kLength);
  } catch (const std::invalid_argument& error) {
    fail(std::string(": ") + error.what());
  }
  return clip;
}

double metres_of(const std::string& unit) { return unit == "m" ? 1 : unit == "cm" ? 1e-2 : 1e-3; }

void require_kept(const Clip& clip, const Eigen::AlignedBox3d& everything,
                  const std::string& unit) {
  const double at = clip.at / metres_of(unit);
  const double low = everything.min()[clip.axis], high = everything.max()[clip.axis];
  if (clip.below ? low < at : high > at) return;
  const char axis = "xyz"[clip.axis];
  throw sim::InputError(
      fmt::format("--clip: nothing is left: what is drawn lies at {} = {:.4g} to {:.4g} {}", axis,
                  low, high, unit));
}

vtkSmartPointer<vtkPointSet> clipped(vtkPointSet& set, const Clip& clip, double unit) {
  if (auto* const surface = vtkPolyData::SafeDownCast(&set))
    return clipped_faces(*surface, clip, unit);
  vtkNew<vtkTableBasedClipDataSet> cut;
  cut->SetInputData(&set);
  cut->SetClipFunction(plane_of(clip, unit));
  cut->Update();
  return cut->GetOutput();
}

vtkSmartPointer<vtkPolyData> clipped_solid(vtkPolyData& surface, const Clip& clip, double unit) {
  if (is_closed(surface)) {
    const auto plane = plane_of(clip, unit);
    vtkNew<vtkPlaneCollection> planes;
    planes->AddItem(plane);
    vtkNew<vtkClipClosedSurface> cut;
    cut->SetInputData(&surface);
    cut->SetClippingPlanes(planes);
    cut->Update();
    return with_own_points_on(*plane, *cut->GetOutput());
  }
  return clipped_faces(surface, clip, unit);
}

}  // namespace articular::tools
