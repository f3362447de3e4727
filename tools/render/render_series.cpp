#include "tools/render/render_series.hpp"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "sim/base/error.hpp"
#include "sim/mesh/vtk_files.hpp"
#include "tools/render/nearest.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

fs::path series_file(const fs::path& run) {
  if (run.extension() == ".pvd") return run;
  if (!fs::is_directory(run))
    throw sim::InputError({run.string()}, "no such folder; expected the folder of a run");
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().extension() == ".pvd") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  if (found.empty())
    throw sim::InputError({run.string()}, "no .pvd in this folder; expected the folder of a run");
  if (found.size() > 1)
    throw sim::InputError({run.string()}, "several .pvd in this folder; give one of them, e.g. " +
                                              found.front().string());
  return found.front();
}

PartKind kind_of(const sim::SeriesEntry& entry) {
  if (fs::path(entry.file).extension() == ".vtu") return PartKind::Tissue;
  return entry.part == "lines" ? PartKind::Lines : PartKind::Bone;
}

/// Fields that have a meaning as one number a point.
void add_fields(vtkDataSetAttributes& data, std::set<std::string>& fields) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* const array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    if (array->GetNumberOfComponents() == 1 || array->GetNumberOfComponents() == 3)
      fields.insert(array->GetName());
  }
}

std::string default_field(const std::set<std::string>& fields) {
  for (const char* const preferred : {"von_mises", "contact_pressure"})
    if (fields.contains(preferred)) return preferred;
  return fields.empty() ? "" : *fields.begin();
}

/// The 99.5th percentile of the distances from rest that are not 0: one peak at a corner of the
/// mesh must not take all colours for itself.
double high_percentile(std::vector<double> values, double rest) {
  for (double& value : values) value = std::abs(value - rest);
  std::erase(values, 0.0);
  if (values.empty()) return 0;
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

double magnitude(vtkDataArray& array, vtkIdType i) {
  if (array.GetNumberOfComponents() == 1) return array.GetComponent(i, 0);
  double sum = 0;
  for (int k = 0; k < array.GetNumberOfComponents(); ++k)
    sum += array.GetComponent(i, k) * array.GetComponent(i, k);
  return std::sqrt(sum);
}

bool same_points(vtkPointSet& a, vtkPointSet& b) {
  if (a.GetNumberOfPoints() != b.GetNumberOfPoints()) return false;
  for (vtkIdType i = 0; i < a.GetNumberOfPoints(); ++i) {
    Vec3 p, q;
    a.GetPoint(i, p.data());
    b.GetPoint(i, q.data());
    if (p != q) return false;
  }
  return true;
}

/// What the survey keeps of the first frame.
struct FirstFrame {
  std::map<std::string, vtkSmartPointer<vtkPointSet>> bones;
  std::set<std::string> tissue_fields, bone_fields;
};

FirstFrame look_at_first(const Frame& frame) {
  FirstFrame first;
  for (const Part& part : frame.parts) {
    if (part.kind == PartKind::Lines) continue;
    auto& fields = part.kind == PartKind::Tissue ? first.tissue_fields : first.bone_fields;
    add_fields(*part.set->GetPointData(), fields);
    add_fields(*part.set->GetCellData(), fields);
    if (part.kind == PartKind::Bone) first.bones[part.name] = part.set;
  }
  return first;
}

void check_focus(const Series& series, const std::string& focus) {
  if (focus.empty()) return;
  std::set<std::string> names;
  for (const sim::SeriesEntry& part : series.frames.front().parts) names.insert(part.part);
  if (!names.contains(focus))
    throw sim::InputError({series.directory.string()}, unknown_name("part", focus, names));
}

void check_only(const fs::path& file, const std::vector<std::string>& only,
                const std::vector<sim::SeriesEntry>& entries) {
  std::set<std::string> names;
  for (const sim::SeriesEntry& entry : entries) names.insert(entry.part);
  for (const std::string& name : only)
    if (!names.contains(name))
      throw sim::InputError({file.string()}, "--only: " + unknown_name("part", name, names));
}

void add_values(const Part& part, Survey& survey) {
  std::vector<double> values = nodal_values(*part.set, survey.field);
  if (values.empty()) return;
  // What is blank must not stretch the scale.
  std::replace_if(
      values.begin(), values.end(), [](double value) { return std::isnan(value); },
      rest_value(survey.field));
  const bool is_first = survey.coloured.empty();
  survey.coloured.insert(part.name);
  if (is_first) survey.unit = unit_of(*part.set, survey.field);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  survey.lowest = is_first ? *low : std::min(survey.lowest, *low);
  survey.highest = is_first ? *high : std::max(survey.highest, *high);
  survey.high_percentile =
      std::max(survey.high_percentile, high_percentile(values, rest_value(survey.field)));
}

/// As the run's summary says, if there is one.
std::optional<double> whole_load(const fs::path& run) {
  std::ifstream in(run / "summary.json");
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  const auto settings = summary.is_object() ? summary.find("settings") : summary.end();
  if (settings == summary.end() || !settings->is_object() ||
      settings->value("analysis", nlohmann::json()) != "static")
    return std::nullopt;
  const auto duration = settings->value("duration_s", nlohmann::json());
  return duration.is_number() ? std::optional(duration.get<double>()) : std::nullopt;
}

}  // namespace

std::string moment_of(const Series& series, double time) {
  return series.whole_load ? fmt::format("load {:.4g} %", 100 * time / *series.whole_load)
                           : fmt::format("t = {:.1f} ms", 1e3 * time);
}

Series open_series(const fs::path& run, const std::vector<std::string>& only) {
  const fs::path file = series_file(run);
  Series series{file.stem().string(), file.parent_path(), {}, whole_load(file.parent_path())};
  std::map<int, FrameEntry> frames;
  std::vector<sim::SeriesEntry> entries = sim::read_series(file);
  check_only(file, only, entries);
  const auto is_drawn = [&](const sim::SeriesEntry& entry) {
    if (only.empty()) return !sim::is_contact_surface(entry);  // its body is drawn
    return std::find(only.begin(), only.end(), entry.part) != only.end();
  };
  for (sim::SeriesEntry& entry : entries) {
    if (!is_drawn(entry)) continue;
    FrameEntry& frame = frames[entry.index];
    frame.index = entry.index;
    frame.time = entry.time;
    frame.parts.push_back(std::move(entry));
  }
  for (auto& [index, frame] : frames) series.frames.push_back(std::move(frame));
  if (series.frames.empty()) throw sim::InputError({file.string()}, "no frames in this series");
  return series;
}

Frame read_frame(const Series& series, const FrameEntry& entry) {
  Frame frame{entry.index, entry.time, {}};
  for (const sim::SeriesEntry& part : entry.parts) {
    const fs::path file = series.directory / part.file;
    if (!fs::exists(file))
      throw sim::InputError({file.string()}, "this frame is listed in the .pvd but not there");
    frame.parts.push_back({part.part, kind_of(part), sim::read_vtk_file(file)});
  }
  return frame;
}

std::string unit_of(vtkPointSet& set, const std::string& field) {
  auto* const unit =
      vtkStringArray::SafeDownCast(set.GetFieldData()->GetAbstractArray((field + ".unit").c_str()));
  return unit != nullptr && unit->GetNumberOfValues() > 0 ? unit->GetValue(0) : "";
}

std::vector<double> nodal_values(vtkPointSet& set, const std::string& field) {
  const vtkIdType num_points = set.GetNumberOfPoints();
  std::vector<double> values;
  if (vtkDataArray* const array = set.GetPointData()->GetArray(field.c_str())) {
    for (vtkIdType i = 0; i < num_points; ++i) values.push_back(magnitude(*array, i));
  } else if (vtkDataArray* const cells = set.GetCellData()->GetArray(field.c_str())) {
    values.assign(static_cast<std::size_t>(num_points), 0.0);
    std::vector<int> count(values.size(), 0);
    vtkNew<vtkIdList> nodes;
    for (vtkIdType e = 0; e < set.GetNumberOfCells(); ++e) {
      set.GetCellPoints(e, nodes);
      const double value = magnitude(*cells, e);
      for (vtkIdType a = 0; a < nodes->GetNumberOfIds(); ++a) {
        const auto node = static_cast<std::size_t>(nodes->GetId(a));
        values[node] += value;
        ++count[node];
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i) values[i] /= std::max(count[i], 1);
  }
  return values;
}

void ViewFit::add(const Vec3& p) {
  const double r = p.dot(axes_.right), u = p.dot(axes_.up), w = p.dot(axes_.to_eye);
  left_ = std::max(left_, -r + borders_.left * w);
  right_ = std::max(right_, r + borders_.right * w);
  bottom_ = std::max(bottom_, -u + borders_.bottom * w);
  top_ = std::max(top_, u + borders_.top * w);
  back_ = std::min(back_, w);
  low_ = low_.cwiseMin(p);
  high_ = high_.cwiseMax(p);
}

void add_points(vtkPointSet& set, ViewFit& fit) {
  for (vtkIdType i = 0; i < set.GetNumberOfPoints(); ++i) {
    Vec3 p;
    set.GetPoint(i, p.data());
    fit.add(p);
  }
}

Vec3 ViewFit::eye() const {
  // Two opposite borders together: left_ + right_ <= (t_left + t_right) c·to_eye; the tighter pair
  // decides, in the other direction the scene stands in the middle.
  const double w = std::max((left_ + right_) / (borders_.left + borders_.right),
                            (bottom_ + top_) / (borders_.bottom + borders_.top));
  const double r = 0.5 * ((right_ - borders_.right * w) + (borders_.left * w - left_));
  const double u = 0.5 * ((top_ - borders_.top * w) + (borders_.bottom * w - bottom_));
  return r * axes_.right + u * axes_.up + w * axes_.to_eye;
}

double ViewFit::depth() const { return eye().dot(axes_.to_eye) - back_; }

double rest_value(const std::string& field) {
  return field.ends_with("_ratio") || field.ends_with("stretch") ? 1 : 0;
}

Survey survey(const Series& series, const std::string& field, const std::string& focus,
              ViewFit& fit) {
  check_focus(series, focus);
  Survey result;
  FirstFrame first;
  for (const FrameEntry& entry : series.frames) {
    const Frame frame = read_frame(series, entry);
    if (&entry == &series.frames.front()) {
      first = look_at_first(frame);
      result.fields = first.tissue_fields.empty() ? first.bone_fields : first.tissue_fields;
      result.field = field.empty() ? default_field(result.fields) : field;
      if (!result.field.empty() && !result.fields.contains(result.field))
        throw sim::InputError({series.directory.string()},
                              unknown_name("field", result.field, result.fields));
      for (const auto& [name, set] : first.bones) result.fixed_bones.insert(name);
    }
    const bool tissue_only = first.tissue_fields.contains(result.field);
    for (const Part& part : frame.parts) {
      if (focus.empty() || part.name == focus) add_points(*part.set, fit);
      if (part.kind == PartKind::Bone && result.fixed_bones.contains(part.name) &&
          !same_points(*part.set, *first.bones.at(part.name)))
        result.fixed_bones.erase(part.name);
      const bool can_carry =
          part.kind == PartKind::Tissue || (part.kind == PartKind::Bone && !tissue_only);
      if (can_carry && !result.field.empty()) add_values(part, result);
    }
  }
  return result;
}

}  // namespace articular::tools
