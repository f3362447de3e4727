#include "tools/render/clip.hpp"

#include <vtkClipPolyData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkUnstructuredGrid.h>

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

vtkSmartPointer<vtkPointSet> clipped(vtkPointSet& set, const Clip& clip, double unit) {
  if (auto* const surface = vtkPolyData::SafeDownCast(&set))
    return clipped_surface(*surface, clip, unit);
  vtkNew<vtkTableBasedClipDataSet> cut;
  cut->SetInputData(&set);
  cut->SetClipFunction(plane_of(clip, unit));
  cut->Update();
  return cut->GetOutput();
}

vtkSmartPointer<vtkPolyData> clipped_surface(vtkPolyData& surface, const Clip& clip, double unit) {
  vtkNew<vtkClipPolyData> cut;
  cut->SetInputData(&surface);
  cut->SetClipFunction(plane_of(clip, unit));
  cut->Update();
  return cut->GetOutput();
}

}  // namespace articular::tools
