#include "sim/output/output_size.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/base/available_memory.hpp"
#include "sim/base/error.hpp"
#include "sim/output/probe_columns.hpp"

namespace articular::sim {
namespace {

// As frames.cpp writes them: doubles, indices of four bytes.
constexpr double kVector = 3 * 8.0;
constexpr double kTissueNode = 3 * kVector + 8;             // place, two vectors, pressure
constexpr double kTetrahedron = 4 * 4.0 + 5 + (6 + 3) * 8;  // corners, type and offset; fields
constexpr double kRigidNode = 2 * kVector;
constexpr double kSurfaceNode = 2 * kVector + 8;
constexpr double kTriangleBytes = 3 * 4.0 + 4;
constexpr double kContactFaceBytes = kTriangleBytes + 2 * 8;
constexpr double kLine = 2 * 3 * 8.0 + 4 * 8 + 16;
constexpr double kFile = 4e3;   // of XML about the arrays
constexpr double kNumber = 15;  // characters of "-1.23456789e-05,"

double bytes_of(const BodyModel& body, const Model& model, bool contact_surface) {
  const double velocity = model.is_static ? 0 : kVector;
  double bytes = kFile;
  if (body.tissue >= 0) {
    const Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
    bytes += (kTissueNode + velocity) * static_cast<double>(tissue.nodes.size()) +
             kTetrahedron * static_cast<double>(tissue.elements.num_elements());
  } else {
    const RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
    if (!rigid.unknown && !rigid.motion) return 0;  // written once
    bytes += (kRigidNode + velocity) * static_cast<double>(body.X.cols()) +
             kTriangleBytes * static_cast<double>(body.triangles.cols());
  }
  if (contact_surface && body.collider) {
    const auto faces = static_cast<double>(body.collider->surface.faces.cols());
    const double nodes = 2 + faces / 2;  // of a closed surface [Euler]
    bytes += kFile + kSurfaceNode * nodes + kContactFaceBytes * faces;
  }
  return bytes;
}

}  // namespace

OutputSize estimated_output(const Scenario& scenario, const Model& model) {
  OutputSize size{};
  size.num_frames = 1 + std::ceil(scenario.duration / scenario.output.interval);
  for (const BodyModel& body : model.bodies)
    size.frame_bytes += bytes_of(body, model, scenario.output.contact_surfaces);
  if (!model.lines.empty())
    size.frame_bytes += kFile + kLine * static_cast<double>(model.lines.size());
  if (!scenario.output.frames) size.frame_bytes = 0;
  double columns = 1;
  for (const ProbeModel& probe : model.probes)
    columns += static_cast<double>(column_names(probe, scenario.output.length_unit).size());
  size.num_rows = std::max(size.num_frames, scenario.duration / scenario.integrator.step);
  size.row_bytes = kNumber * columns;
  return size;
}

void refuse_more_than_fits(const OutputSize& size, const std::filesystem::path& folder) {
  std::error_code unknown;
  const double free = static_cast<double>(std::filesystem::space(folder, unknown).available);
  if (unknown || size.total_bytes() <= free) return;
  throw InputError({folder.string()},
                   fmt::format("{:.3g} frames of {} and {:.3g} rows of history would take {}, and "
                               "the disk has {} free: lengthen output.interval, or choose another "
                               "--out",
                               size.num_frames, size_text(size.frame_bytes), size.num_rows,
                               size_text(size.total_bytes()), size_text(free)));
}

}  // namespace articular::sim
