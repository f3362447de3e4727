#include "tools/render/survey.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"
#include "tools/render/nearest.hpp"

namespace articular::tools {
namespace {

/// 99.5th of the distances from rest that are not 0: one peak at a corner of the mesh must not take
/// all colours for itself.
double percentile_of(std::vector<double> values, double rest) {
  for (double& value : values) value = std::abs(value - rest);
  std::erase(values, 0.0);
  if (values.empty()) return 0;
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// Of all parts of one kind.
std::set<std::string> fields_of_kind(const Frame& frame, PartKind kind) {
  std::set<std::string> fields;
  for (const Part& part : frame.parts)
    if (part.kind == kind) fields.merge(fields_of(*part.set));
  return fields;
}

std::string default_field(const std::set<std::string>& fields) {
  for (const char* const preferred : {"von_mises", "contact_pressure"})
    if (fields.contains(preferred)) return preferred;
  return fields.empty() ? "" : *fields.begin();
}

/// The field of this frame, and whose it is.
void choose_field(const Series& series, const Frame& frame, const Colouring& colouring,
                  Survey& result) {
  std::set<std::string> fields = fields_of_kind(frame, PartKind::Tissue);
  if (fields.empty()) fields = fields_of_kind(frame, PartKind::Bone);
  std::set<std::string> of_lines = fields_of_kind(frame, PartKind::Lines);
  of_lines.erase("kind");
  result.field = colouring.field.empty() ? default_field(fields) : colouring.field;
  result.of_lines = !fields.contains(result.field) && of_lines.contains(result.field);
  result.each_cell_alone = colouring.each_cell_alone;
  result.is_difference = colouring.is_difference;
  result.rest = colouring.is_difference ? 0 : rest_value(result.field);
  if (result.field.empty() || result.of_lines || fields.contains(result.field)) return;
  fields.merge(of_lines);
  throw sim::InputError({series.directory.string()}, unknown_name("field", result.field, fields));
}

void check_focus(const Series& series, const std::string& focus) {
  if (focus.empty()) return;
  std::set<std::string> names;
  for (const sim::SeriesEntry& part : series.frames.front().parts) names.insert(part.part);
  if (!names.contains(focus))
    throw sim::InputError({series.directory.string()}, unknown_name("part", focus, names));
}

void add_lines(const Part& lines, Survey& result) {
  vtkDataArray* const kind = lines.set->GetCellData()->GetArray("kind");
  vtkDataArray* const force = lines.set->GetCellData()->GetArray("force");
  for (vtkIdType e = 0; kind != nullptr && e < kind->GetNumberOfTuples(); ++e) {
    if (kind->GetComponent(e, 0) < 0.5)
      result.has_muscles = true;
    else if (force != nullptr)
      result.highest_tension =
          std::max(result.highest_tension.value_or(0), force->GetComponent(e, 0));
  }
}

void add_values(const Part& part, Survey& result) {
  std::vector<double> values = drawn_values(part, result).numbers;
  if (values.empty()) return;
  const bool is_first = result.coloured.empty();
  result.coloured.insert(part.name);
  if (is_first) result.unit = text_of(*part.set, result.field + ".unit");
  for (double& value : values)
    if (std::isnan(value)) {  // must not stretch the scale
      result.has_blank = true;
      value = result.rest;
    }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  result.lowest = is_first ? *low : std::min(result.lowest, *low);
  result.highest = is_first ? *high : std::max(result.highest, *high);
  // A line has one value, which is no peak of a mesh.
  const double high_end =
      result.of_lines ? std::max(std::abs(*low - result.rest), std::abs(*high - result.rest))
                      : percentile_of(values, result.rest);
  result.high_percentile = std::max(result.high_percentile, high_end);
}

}  // namespace

DrawnRun as_written(Series series) {
  const auto read = [series](const FrameEntry& entry) { return read_frame(series, entry); };
  return {std::move(series), read};
}

FieldValues drawn_values(const Part& part, const Survey& survey) {
  if (survey.field.empty() || (part.kind == PartKind::Lines) != survey.of_lines) return {};
  const bool is_surface = part.kind == PartKind::Bone;  // faces, of contact surfaces among them
  if (survey.each_cell_alone || is_surface || survey.of_lines) {
    FieldValues values = cell_values(*part.set, survey.field);
    if (!values.numbers.empty() || survey.each_cell_alone) return values;
  }
  return smooth_values(*part.set, survey.field);
}

void add_bounds(const Part& part, Survey& survey) {
  if (part.set->GetNumberOfPoints() == 0) return;
  const double* const b = part.set->GetBounds();
  survey.everything.extend(Vec3(b[0], b[2], b[4])).extend(Vec3(b[1], b[3], b[5]));
}

Vec3 middle_of(const Frame& frame, const ViewAxes& axes, const std::string& focus) {
  ViewBox box(axes);
  for (const Part& part : frame.parts)
    if (focus.empty() || part.name == focus) box.add(*part.set);
  return box.middle();
}

void require_same_unit(const Series& series, const std::string& expected,
                       const std::string& found) {
  if (found != expected)
    throw sim::InputError({series.directory.string()},
                          fmt::format("its lengths are in {}, and those beside it in {}: expected "
                                      "runs with the same `output.length_unit`",
                                      found, expected));
}

Survey survey(const std::vector<DrawnRun>& runs, const Colouring& colouring,
              const std::string& focus, const ViewAxes& axes) {
  Survey result;
  ViewBox everything(axes);
  bool is_of_tissue = false;
  std::string seen_unit;
  for (const DrawnRun& run : runs) {
    check_focus(run.series, focus);
    for (const FrameEntry& entry : run.series.frames) {
      const Frame frame = run.read(entry);
      if (&entry == &run.series.frames.front()) {
        choose_field(run.series, frame, colouring, result);
        is_of_tissue = fields_of_kind(frame, PartKind::Tissue).contains(result.field);
      }
      ViewBox seen(axes);
      for (const Part& part : frame.parts) {
        if (const std::string unit = text_of(*part.set, "coordinates.unit"); !unit.empty()) {
          if (seen_unit.empty()) seen_unit = unit;
          require_same_unit(run.series, seen_unit, unit);
        }
        everything.add(*part.set);
        add_bounds(part, result);
        if (part.name == focus) seen.add(*part.set);
        if (part.kind == PartKind::Lines) add_lines(part, result);
        if (!is_of_tissue || part.kind == PartKind::Tissue) add_values(part, result);
      }
      if (!focus.empty()) result.size = result.size.cwiseMax(seen.size());
    }
  }
  if (colouring.each_cell_alone && result.coloured.empty() && !result.field.empty())
    throw sim::InputError("--flat: " + result.field +
                          " has values at nodes only; expected a field of elements or faces");
  if (!seen_unit.empty()) result.length_unit = seen_unit;
  if (everything.is_empty()) throw sim::InputError("the parts to draw have no points");
  result.diagonal = everything.size().norm();
  if (focus.empty()) {
    result.size = everything.size();
    result.middle = everything.middle();
  }
  return result;
}

}  // namespace articular::tools
