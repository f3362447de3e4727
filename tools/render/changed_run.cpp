#include "tools/render/changed_run.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

const Part& part_of(const Series& series, const Frame& frame, const std::string& name) {
  for (const Part& part : frame.parts)
    if (part.name == name) return part;
  throw sim::InputError({series.directory.string()},
                        fmt::format("frame {} has no part `{}`", frame.index, name));
}

void require_same_mesh(const Series& series, const Frame& frame, const Part& a, const Part& b,
                       const std::string& why) {
  if (a.set->GetNumberOfPoints() == b.set->GetNumberOfPoints() &&
      a.set->GetNumberOfCells() == b.set->GetNumberOfCells())
    return;
  throw sim::InputError(
      {series.directory.string()},
      fmt::format("{}: `{}` has {} points and {} cells in frame {}, there {} and {}; --hide {} "
                  "leaves it out",
                  why, a.name, a.set->GetNumberOfPoints(), a.set->GetNumberOfCells(), frame.index,
                  b.set->GetNumberOfPoints(), b.set->GetNumberOfCells(), a.name));
}

void move_away(vtkPointSet& set, vtkPointSet& start, double factor) {
  for (vtkIdType i = 0; i < set.GetNumberOfPoints(); ++i) {
    Vec3 p, p0;
    set.GetPoint(i, p.data());
    start.GetPoint(i, p0.data());
    p = p0 + factor * (p - p0);
    set.GetPoints()->SetPoint(i, p.data());
  }
}

void subtract(vtkDataSetAttributes& from, vtkDataSetAttributes& what) {
  for (int k = 0; k < from.GetNumberOfArrays(); ++k) {
    vtkDataArray* const array = from.GetArray(k);
    if (array == nullptr || array->GetName() == nullptr) continue;
    if (std::string(array->GetName()) == "kind") continue;  // what a line is, not a value
    vtkDataArray* const other = what.GetArray(array->GetName());
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
        array->SetComponent(i, c,
                            other != nullptr ? array->GetComponent(i, c) - other->GetComponent(i, c)
                                             : std::nan(""));
  }
}

}  // namespace

const FrameEntry& frame_at(const Series& series, double time) {
  return *std::min_element(series.frames.begin(), series.frames.end(),
                           [&](const FrameEntry& a, const FrameEntry& b) {
                             return std::abs(a.time - time) < std::abs(b.time - time);
                           });
}

DrawnRun exaggerated(DrawnRun run, double factor) {
  const Frame start = run.read(run.series.frames.front());
  const auto read = [run, start, factor](const FrameEntry& entry) {
    Frame frame = run.read(entry);
    for (Part& part : frame.parts) {
      const Part& before = part_of(run.series, start, part.name);
      require_same_mesh(run.series, frame, part, before,
                        "--deformation compares with the first frame");
      move_away(*part.set, *before.set, factor);
    }
    return frame;
  };
  return {run.series, read};
}

DrawnRun difference(DrawnRun first, DrawnRun second) {
  constexpr double kSameTime = 1e-6;  // of the time; both are written with more digits
  const auto read = [first, second](const FrameEntry& entry) {
    Frame frame = first.read(entry);
    const FrameEntry& other_entry = frame_at(second.series, entry.time);
    if (std::abs(other_entry.time - entry.time) > kSameTime * std::max(entry.time, 1e-3))
      throw sim::InputError(
          {second.series.directory.string()},
          fmt::format("--difference: there is no frame at {}, the time of frame {} of {}; the "
                      "nearest is at {}",
                      moment_of(first.series, entry.time), entry.index,
                      first.series.directory.string(), moment_of(second.series, other_entry.time)));
    const Frame other = second.read(other_entry);
    for (Part& part : frame.parts) {
      const Part& there = part_of(second.series, other, part.name);
      require_same_unit(second.series, text_of(*part.set, "coordinates.unit"),
                        text_of(*there.set, "coordinates.unit"));
      require_same_mesh(first.series, frame, part, there, "--difference compares node by node");
      // As second minus first: the first one's arrays are taken from the second one's.
      vtkSmartPointer<vtkPointSet> result;
      result.TakeReference(there.set->NewInstance());
      result->DeepCopy(there.set);
      subtract(*result->GetPointData(), *part.set->GetPointData());
      subtract(*result->GetCellData(), *part.set->GetCellData());
      result->SetPoints(part.set->GetPoints());
      part.set = result;
    }
    return frame;
  };
  return {first.series, read};
}

}  // namespace articular::tools
