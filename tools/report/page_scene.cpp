#include "tools/report/page_scene.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.hpp"
#include "tools/plot/axis_unit.hpp"
#include "tools/render/colour_map.hpp"
#include "tools/render/field_values.hpp"
#include "tools/render/view.hpp"
#include "tools/report/rigid_pose.hpp"

namespace articular::tools {
namespace {

/// Of a bone: more are seen by nobody, and every phone has to draw them.
constexpr vtkIdType kMostTriangles = 60000;

std::string hex_colour(const Rgb& colour) {
  std::string text = "#";
  for (const double channel : colour) text += fmt::format("{:02x}", std::lround(255 * channel));
  return text;
}

Json colours_json(const ColourMap& map) {
  Json json = Json::array();
  for (const Rgb& colour : map) json.push_back(hex_colour(colour));
  return json;
}

/// Where the 3D view may be looked at from; the first is the one that it begins with.
Json views_json(const Directions& directions) {
  Json json = Json::object();
  for (const char* const name :
       {"three-quarter", "front", "back", "left", "right", "top", "bottom"}) {
    const ViewAxes axes = view_axes(name, "", directions);
    json[name] = {{"up", {axes.up.x(), axes.up.y(), axes.up.z()}},
                  {"to_eye", {axes.to_eye.x(), axes.to_eye.y(), axes.to_eye.z()}}};
  }
  return json;
}

std::vector<double> as_planes(const Positions& x) {
  std::vector<double> numbers;
  for (int k = 0; k < 3; ++k)
    for (Eigen::Index i = 0; i < x.cols(); ++i) numbers.push_back(x(k, i));
  return numbers;
}

void append(const std::vector<double>& numbers, std::vector<double>& all) {
  all.insert(all.end(), numbers.begin(), numbers.end());
}

/// In its own words where that is no unit we know.
ShownUnit shown_unit_of(const std::string& unit, double largest) {
  try {
    return shown_unit(axis_unit(unit == "1" ? "-" : unit), largest);  // frames call no unit 1
  } catch (const std::invalid_argument&) {
    return {1, unit};
  } catch (const sim::InputError&) {
    return {1, unit};
  }
}

std::vector<vtkIdType> all_points(vtkPointSet& set) {
  std::vector<vtkIdType> points(static_cast<std::size_t>(set.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<vtkIdType>(i);
  return points;
}

}  // namespace

PageScene::BodyRecord& PageScene::record_of(const Part& part) {
  for (BodyRecord& record : bodies_)
    if (record.name == part.name) return record;
  BodyRecord record;
  record.name = part.name;
  record.is_tissue = part.kind == PartKind::Tissue;
  record.skin = page_skin(*part.set);
  record.num_points = part.set->GetNumberOfPoints();
  if (!record.is_tissue) {
    record.start = positions_at(*part.set, all_points(*part.set));
    record.shape = positions_at(*part.set, record.skin.nodes);
    const auto count = static_cast<vtkIdType>(record.skin.corners.size() / 3);
    if (count > kMostTriangles) {
      const auto simple = simplified_surface(*part.set, kMostTriangles);
      record.skin = page_skin(*simple);
      record.shape = positions_at(*simple, record.skin.nodes);
      remarks_.push_back(fmt::format("{} is drawn with {} of its {} triangles", part.name,
                                     record.skin.corners.size() / 3, count));
    }
  }
  return bodies_.emplace_back(std::move(record));
}

void PageScene::add(const Frame& frame) {
  for (const Part& part : frame.parts) {
    if (part.kind == PartKind::Lines) {
      add_lines(part);
      continue;
    }
    BodyRecord& record = record_of(part);
    if (part.set->GetNumberOfPoints() != record.num_points)
      throw sim::InputError(fmt::format("frame {}: `{}` has {} points, and {} in the first frame",
                                        frame.index, part.name, part.set->GetNumberOfPoints(),
                                        record.num_points));
    if (record.is_tissue)
      add_tissue(part, record);
    else if (record.num_points > 0)
      add_bone(part, record);
  }
}

void PageScene::add_field(const Part& part, const std::string& field, Fields& fields,
                          const std::vector<vtkIdType>* nodes) {
  const FieldValues values =
      nodes != nullptr ? smooth_values(*part.set, field) : cell_values(*part.set, field);
  if (values.numbers.empty()) return;
  fields_[field] = {text_of(*part.set, field + ".unit"), nodes == nullptr};
  std::vector<double>& all = fields[field];
  if (nodes == nullptr) return append(values.numbers, all);
  for (const vtkIdType node : *nodes) all.push_back(values.numbers[static_cast<std::size_t>(node)]);
}

void PageScene::add_tissue(const Part& part, BodyRecord& record) {
  append(as_planes(positions_at(*part.set, record.skin.nodes)), record.positions);
  for (const std::string& field : fields_of(*part.set))
    add_field(part, field, record.fields, &record.skin.nodes);
}

void PageScene::add_bone(const Part& part, BodyRecord& record) {
  const auto pose = rigid_pose(record.start, positions_at(*part.set, all_points(*part.set)));
  record.poses.insert(record.poses.end(), pose.begin(), pose.end());
}

void PageScene::add_lines(const Part& part) {
  vtkCellData& cells = *part.set->GetCellData();
  if (lines_.names.empty()) {
    auto* const names = vtkStringArray::SafeDownCast(cells.GetAbstractArray("name"));
    vtkDataArray* const kinds = cells.GetArray("kind");
    for (vtkIdType i = 0; i < part.set->GetNumberOfCells(); ++i) {
      lines_.names.push_back(names != nullptr ? names->GetValue(i) : "");
      lines_.is_muscle.push_back(kinds != nullptr && kinds->GetComponent(i, 0) == 0);
    }
  }
  vtkNew<vtkIdList> points;
  for (vtkIdType i = 0; i < part.set->GetNumberOfCells(); ++i) {
    part.set->GetCellPoints(i, points);
    lines_.counts.push_back(static_cast<std::uint32_t>(points->GetNumberOfIds()));
    for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k) {
      double x[3];
      part.set->GetPoint(points->GetId(k), x);
      lines_.points.insert(lines_.points.end(), x, x + 3);
    }
  }
  for (const char* const field : {"activation", "force", "length"})
    add_field(part, field, lines_.fields, nullptr);
}

double PageScene::bytes_a_frame() const {
  constexpr double kBase64 = 4.0 / 3, kZlib = 0.8;  // of what changes from frame to frame
  std::size_t numbers = 0;
  for (const BodyRecord& record : bodies_)
    if (record.is_tissue) numbers += record.skin.nodes.size() * (3 + record.fields.size());
  return 2 * kBase64 * kZlib * static_cast<double>(numbers);
}

Json PageScene::body_json(const BodyRecord& record) const {
  Json json = {{"name", record.name}, {"kind", record.is_tissue ? "tissue" : "bone"}};
  const std::size_t num_nodes = record.skin.nodes.size();
  json["triangles"] = packed_integers(record.skin.corners, 4, 1);
  json["points"] = record.is_tissue ? quantised(record.positions, 3 * num_nodes)
                                    : quantised(as_planes(record.shape), 0);
  if (!record.is_tissue) json["poses"] = packed_doubles(record.poses);
  json["fields"] = Json::object();
  for (const auto& [field, values] : record.fields)
    json["fields"][field] = quantised(values, num_nodes);
  return json;
}

Json PageScene::lines_json() const {
  Json json = {{"names", lines_.names},
               {"is_muscle", lines_.is_muscle},
               {"counts", packed_integers(lines_.counts, 4, lines_.names.size())},
               {"points", quantised(lines_.points, 0)},
               {"fields", Json::object()}};
  for (const auto& [field, values] : lines_.fields)
    json["fields"][field] = quantised(values, lines_.names.size());
  return json;
}

Json PageScene::fields_json() const {
  Json json = Json::array();
  for (const auto& [field, info] : fields_) {
    double largest = 0;
    for (const BodyRecord& record : bodies_)
      if (const auto it = record.fields.find(field); it != record.fields.end())
        largest = std::max(largest, largest_size(it->second));
    if (const auto it = lines_.fields.find(field); it != lines_.fields.end())
      largest = std::max(largest, largest_size(it->second));
    const ShownUnit shown = shown_unit_of(info.unit, largest);
    json.push_back({{"name", field},
                    {"is_of_lines", info.is_of_lines},
                    {"unit", shown.text},
                    {"factor", shown.factor},
                    {"rest", rest_value(field)}});
  }
  return json;
}

Json PageScene::json(const Directions& directions) const {
  Json json = {{"bodies", Json::array()}};
  for (const BodyRecord& record : bodies_)
    if (!record.skin.corners.empty()) json["bodies"].push_back(body_json(record));
  json["lines"] = lines_json();
  json["fields"] = fields_json();
  json["colour_maps"] = {{"viridis", colours_json(colour_maps().at("viridis"))},
                         {"blue-red", colours_json(colour_maps().at("blue-red"))}};
  json["directions"] = directions;
  json["views"] = views_json(directions);
  return json;
}

}  // namespace articular::tools
