#include "sim/output/frame_writer.hpp"

#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <system_error>

#include "sim/base/atomic_file.hpp"
#include "sim/base/error.hpp"
#include "sim/mesh/vtk_files.hpp"

namespace articular::sim {
namespace {

constexpr const char* kFrames = "frames";  // folder beside the .pvd

void add_text(vtkPointSet& set, const std::string& name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(text);
  set.GetFieldData()->AddArray(array);
}

/// Muscles and ligaments as polylines, a point of its own for every point of every path.
vtkSmartPointer<vtkPointSet> make_lines(const std::vector<Positions>& paths, double unit) {
  Eigen::Index num_points = 0;
  for (const Positions& path : paths) num_points += path.cols();
  Positions x(3, num_points);
  vtkNew<vtkCellArray> lines;
  lines->Use32BitStorage();
  Eigen::Index point = 0;
  for (const Positions& path : paths) {
    lines->InsertNextCell(static_cast<int>(path.cols()));
    for (Eigen::Index a = 0; a < path.cols(); ++a) {
      x.col(point) = path.col(a);
      lines->InsertCellPoint(point++);
    }
  }
  vtkSmartPointer<vtkPointSet> set = make_surface(x, unit, Triangles(3, 0));
  vtkPolyData::SafeDownCast(set)->SetLines(lines);
  return set;
}

/// The door of every frame.
void require_finite(const std::string& body, const std::vector<Field>& fields) {
  for (const Field& field : fields)
    if (!field.may_be_blank && !field.values.allFinite())
      throw SimulationError("the simulation cannot go on: " + field.name + " of `" + body +
                            "` is not finite; results are valid until the frame before");
}

}  // namespace

FrameWriter::FrameWriter(std::filesystem::path directory, std::string name, LengthUnit unit,
                         FrameThread thread)
    : directory_(std::move(directory)),
      name_(std::move(name)),
      unit_(std::move(unit)),
      thread_(thread) {
  const std::filesystem::path frames = directory_ / kFrames;
  make_folders(frames);
  for (const std::filesystem::path& folder : {directory_, frames})
    if (::access(folder.c_str(), W_OK) != 0)
      throw SystemError(folder.string() +
                        ": the folder can't be written: " + std::system_category().message(errno));
}

std::filesystem::path FrameWriter::series_file() const { return directory_ / (name_ + ".pvd"); }

void FrameWriter::resume_at(const FileExtent& series) {
  wait();
  pending_.clear();
  series_.emplace(series_file(), series);
}

void FrameWriter::add_field(vtkPointSet& set, vtkDataSetAttributes& target,
                            const Field& field) const {
  double scale = 1;
  std::string unit = field.unit;
  if ((field.name == "displacement" || field.name == "contact_gap") && field.unit == "m") {
    scale = 1 / unit_.metres;
    unit = unit_.name;
  } else if (field.name == "velocity" && field.unit == "m/s") {
    scale = 1 / unit_.metres;
    unit = unit_.name + "/s";
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(static_cast<int>(field.values.rows()));
  array->SetNumberOfTuples(field.values.cols());
  Eigen::Map<Eigen::MatrixXd>(array->GetPointer(0), field.values.rows(), field.values.cols()) =
      scale * field.values;
  target.AddArray(array);
  add_text(set, field.name + ".unit", unit);
}

void FrameWriter::add_fields(const std::string& body, vtkPointSet& set,
                             const std::vector<Field>& point_fields,
                             const std::vector<Field>& cell_fields) const {
  require_finite(body, point_fields);
  require_finite(body, cell_fields);
  for (const Field& field : point_fields) {
    assert(field.values.cols() == set.GetNumberOfPoints());
    add_field(set, *set.GetPointData(), field);
  }
  for (const Field& field : cell_fields) {
    assert(field.values.cols() == set.GetNumberOfCells());
    add_field(set, *set.GetCellData(), field);
  }
}

void FrameWriter::write_part(const std::string& part, const std::string& name,
                             const std::string& ending, vtkPointSet& set, int index, double time) {
  if (name.empty() || name.find('/') != std::string::npos || name.front() == '.')
    throw InputError("body name `" + name + "` can't be the name of a file");
  const std::string file = std::string(kFrames) + "/" + frame_file_name(name, index, ending);
  if (std::any_of(pending_.begin(), pending_.end(),
                  [&](const Part& other) { return other.entry.file == file; }))
    throw InputError("two results would be called " + file + ": rename a body");
  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  set.GetFieldData()->AddArray(time_value);
  add_text(set, "coordinates.unit", unit_.name);
  // To compress the frames of a jaw took a quarter of its run, and made them two thirds as large.
  const auto write = [path = directory_ / file, kept = vtkSmartPointer<vtkPointSet>(&set)] {
    write_vtk_file(path, *kept, Compressed::No, Durable::Later);
  };
  pending_.push_back({{time, index, part, file}, write});
}

void FrameWriter::write_tissue(const TissueFrame& frame, int index, double time) {
  const auto set = make_grid(frame.x, unit_.metres, frame.tets, Triangles(3, 0));
  add_fields(frame.body, *set, frame.point_fields, frame.cell_fields);
  write_part(frame.body, frame.body, ".vtu", *set, index, time);
}

void FrameWriter::write_rigid_body(const RigidBodyFrame& frame, int index, double time) {
  const auto set = make_surface(frame.x, unit_.metres, frame.triangles);
  add_fields(frame.body, *set, frame.point_fields, frame.cell_fields);
  write_part(frame.body, frame.body, ".vtp", *set, index, time);
}

void FrameWriter::repeat_rigid_body(const std::string& body, int first, int index, double time) {
  pending_.push_back(
      {{time, index, body, std::string(kFrames) + "/" + frame_file_name(body, first, ".vtp")}, {}});
}

void FrameWriter::write_contact_surface(const ContactSurfaceFrame& frame, int index, double time) {
  // Interior nodes have no place in a surface.
  std::vector<int> kept(frame.faces.data(), frame.faces.data() + frame.faces.size());
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  const Triangles faces = frame.faces.unaryExpr([&](int node) {
    return static_cast<int>(std::lower_bound(kept.begin(), kept.end(), node) - kept.begin());
  });
  std::vector<Field> point_fields = frame.point_fields;
  for (Field& field : point_fields) field.values = field.values(Eigen::all, kept).eval();
  const auto set = make_surface(frame.x(Eigen::all, kept), unit_.metres, faces);
  add_fields(frame.body, *set, point_fields, frame.cell_fields);
  write_part(contact_surface_part(frame.body), frame.body + "_contact", ".vtp", *set, index, time);
}

void FrameWriter::write_lines(const LinesFrame& frame, int index, double time) {
  const auto set = make_lines(frame.paths, unit_.metres);
  vtkNew<vtkStringArray> names;
  names->SetName("name");
  for (const std::string& name : frame.names) names->InsertNextValue(name);
  set->GetCellData()->AddArray(names);
  add_fields("lines", *set, {}, frame.cell_fields);
  write_part("lines", "lines", ".vtp", *set, index, time);
}

void FrameWriter::finish_frame([[maybe_unused]] int index, double time) {
  for (Part& part : pending_) {
    assert(part.entry.index == index);
    part.entry.time = time;
  }
  wait();
  std::vector<Part> frame = std::exchange(pending_, {});
  if (thread_ == FrameThread::Callers) {
    publish(frame);
    return;
  }
  const auto publish_it = [this, frame = std::move(frame)] { publish(frame); };
  try {
    on_its_way_ = std::async(std::launch::async, publish_it);
  } catch (const std::system_error&) {  // the system gives no more threads
    publish_it();
  }
}

void FrameWriter::publish(const std::vector<Part>& frame) {
  std::vector<SeriesEntry> entries;
  for (const Part& part : frame) {
    entries.push_back(part.entry);
    if (!part.write) continue;
    part.write();
    not_synced_.push_back(part.entry.file);
  }
  if (!series_) series_.emplace(series_file());
  series_->append(entries);
}

void FrameWriter::wait() {
  if (on_its_way_.valid()) on_its_way_.get();
}

FileExtent FrameWriter::series() {
  wait();
  return series_ ? series_->extent() : FileExtent{};
}

void FrameWriter::sync() {
  wait();
  for (const std::string& file : not_synced_) sync_file(directory_ / file);
  not_synced_.clear();
  sync_file(directory_ / kFrames);
  if (series_) series_->sync();
}

}  // namespace articular::sim
