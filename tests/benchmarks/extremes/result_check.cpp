#include "tests/benchmarks/extremes/result_check.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

#include <cmath>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "sim/mesh/frame_series.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::benchmarks {
namespace {

namespace fs = std::filesystem;

/// Contact that the mesh does not resolve has no pressure, and what is opposite nothing no gap.
bool may_be_blank(const std::string& name) {
  return name == "contact_pressure" || name == "contact_gap";
}

bool is_finite(vtkDataArray* array) {
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
      if (!std::isfinite(array->GetComponent(i, k))) return false;
  return true;
}

std::string invalid_fields(vtkDataSetAttributes* fields, const std::string& file) {
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    if (vtkDataArray* array = fields->GetArray(i);
        array && !may_be_blank(array->GetName()) && !is_finite(array))
      return file + ": " + array->GetName() + " is not finite";
  return {};
}

std::string invalid_frame(const fs::path& path) {
  const std::string file = path.filename().string();
  const vtkSmartPointer<vtkPointSet> set = sim::read_vtk_file(path);
  if (set->GetNumberOfPoints() == 0) return file + ": empty";
  if (!is_finite(set->GetPoints()->GetData())) return file + ": positions are not finite";
  const std::string points = invalid_fields(set->GetPointData(), file);
  return points.empty() ? invalid_fields(set->GetCellData(), file) : points;
}

std::string invalid_history(const fs::path& path) {
  std::ifstream in(path);
  std::string line, cell;
  if (!std::getline(in, line)) return "history.csv: missing";
  std::vector<std::string> columns;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) columns.push_back(cell);
  while (std::getline(in, line)) {
    line += ',';  // or an empty last cell would not be one
    std::size_t k = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ','); ++k) {
      if (k >= columns.size()) return "history.csv: a row is too long";
      // A place where nothing touches is empty, and a pressure that the mesh does not resolve;
      // elsewhere an empty cell is a NaN.
      const bool can_be_empty = columns[k].find(".center.") != std::string::npos ||
                                columns[k].find("_at.") != std::string::npos ||
                                columns[k].find("_pressure") != std::string::npos;
      if (cell.empty() ? !can_be_empty : !std::isfinite(std::stod(cell)))
        return "history.csv: " + columns[k] + " is not finite";
    }
    if (k != columns.size()) return "history.csv: a row is too short";
  }
  return {};
}

/// A number that is not finite is null in JSON.
std::string invalid_summary(const fs::path& path) {
  std::ifstream in(path);
  if (!in) return "summary.json: missing";
  const nlohmann::json summary = nlohmann::json::parse(in);
  for (const auto& [name, value] : summary.at("energy").items())
    if (value.is_null()) return "summary.json: energy." + name + " is not finite";
  for (const auto& [name, value] : summary.at("energy").at("end").items())
    if (value.is_null()) return "summary.json: energy.end." + name + " is not finite";
  return {};
}

std::string invalid_series(const fs::path& results) {
  std::set<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(results)) {
    if (entry.path().extension() != ".pvd") continue;
    for (const sim::SeriesEntry& part : sim::read_series(entry.path()))
      files.insert(results / part.file);
  }
  for (const fs::path& file : files)
    if (std::string broken = invalid_frame(file); !broken.empty()) return broken;
  return {};
}

}  // namespace

std::string what_is_invalid(const fs::path& results) {
  try {
    for (const std::string& broken :
         {invalid_summary(results / "summary.json"), invalid_history(results / "history.csv"),
          invalid_series(results)})
      if (!broken.empty()) return broken;
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace articular::benchmarks
