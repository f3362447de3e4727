#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/base/types.hpp"
#include "sim/base/length_unit.hpp"
#include "sim/mesh/frame_series.hpp"

class vtkDataSetAttributes;
class vtkPointSet;

/// Frames for ParaView: .vtu, .vtp and a .pvd over them. Everything arrives in SI and is written
/// in the output's length unit (coordinates, displacement, velocity per second) and SI otherwise.
namespace articular::sim {

/// A named array over points or cells: `components` rows, one column a point or cell. A
/// `displacement` or `contact_gap` in "m" and a `velocity` in "m/s" are written in the output's
/// length unit, every other field as it is.
struct Field {
  std::string name;           // e.g. "contact_pressure"
  std::string unit;           // e.g. "Pa"; written as a field-data array "<name>.unit"
  Eigen::MatrixXd values;     // finite numbers
  bool may_be_blank = false;  // NaN: nothing is known there
};

struct TissueFrame {
  std::string body;
  const Positions& x;
  const Tetrahedra& tets;
  std::vector<Field> point_fields, cell_fields;
};

struct RigidBodyFrame {
  std::string body;
  const Positions& x;
  const Triangles& triangles;
  std::vector<Field> point_fields, cell_fields;
};

/// The surface that a body touches with.
struct ContactSurfaceFrame {
  std::string body;
  const Positions& x;  // of all nodes of the collider; those on no face are left out
  const Triangles& faces;
  std::vector<Field> point_fields, cell_fields;  // over x and over the faces
};

/// Muscles and ligaments: each a polyline; one value a line in each cell field.
struct LinesFrame {
  std::vector<std::string> names;
  std::vector<Positions> paths;
  std::vector<Field> cell_fields;  // activation, force, length, kind (0 muscle, 1 ligament)
};

/// Who writes the files of a frame.
enum class FrameThread { Callers, OfItsOwn };

/// Writes a time series into a folder: DIR/NAME.pvd and DIR/frames/BODY_000123.vtu etc. Every frame
/// file appears whole or not at all; after each frame the .pvd lists all frames so far.
///
/// With a thread of its own a frame is on its way while the caller goes on, and whatever comes next
/// waits for it: another finished frame, sync(), series(). What it could not write is thrown there.
class FrameWriter {
 public:
  /// @throws SystemError when the folder can't be made or written
  FrameWriter(std::filesystem::path directory, std::string name, LengthUnit unit,
              FrameThread thread = FrameThread::Callers);

  /// Resumes: keeps the frames that the .pvd listed when it had that extent, forgets those after.
  /// @throws InputError when they are not there any more
  void resume_at(const FileExtent& series);

  void write_tissue(const TissueFrame& frame, int index, double time);
  void write_rigid_body(const RigidBodyFrame& frame, int index, double time);
  /// A rigid body that stands still since frame `first`: that frame's file again.
  void repeat_rigid_body(const std::string& body, int first, int index, double time);
  /// As BODY_contact_000123.vtp.
  void write_contact_surface(const ContactSurfaceFrame& frame, int index, double time);
  void write_lines(const LinesFrame& frame, int index, double time);
  /// All parts of this frame are there: writes them and publishes the frame in the .pvd.
  /// @throws SystemError
  void finish_frame(int index, double time);

  /// All published frames outlast a power cut from now on. @throws SystemError
  void sync();
  /// Of the .pvd; of nothing before the first frame. @throws SystemError
  FileExtent series();

 private:
  struct Part {
    SeriesEntry entry;
    std::function<void()> write;  // empty: the file is there already
  };

  /// @param part  its name in the .pvd  @param name  of the file, without number and ending
  void write_part(const std::string& part, const std::string& name, const std::string& ending,
                  vtkPointSet& set, int index, double time);
  /// Parts in the order of the .pvd.
  void publish(const std::vector<Part>& frame);
  /// Until the frame that is on its way is published.
  void wait();
  std::filesystem::path series_file() const;
  void add_field(vtkPointSet& set, vtkDataSetAttributes& target, const Field& field) const;
  /// @throws SimulationError where a field is not finite
  void add_fields(const std::string& body, vtkPointSet& set, const std::vector<Field>& point_fields,
                  const std::vector<Field>& cell_fields) const;

  std::filesystem::path directory_;
  std::string name_;
  LengthUnit unit_;
  FrameThread thread_;
  std::vector<Part> pending_;
  std::optional<SeriesFile> series_;     // publish()'s until wait() is over, as is what follows
  std::vector<std::string> not_synced_;  // files
  std::future<void> on_its_way_;         // last: to destroy it waits for what uses the others
};

}  // namespace articular::sim
