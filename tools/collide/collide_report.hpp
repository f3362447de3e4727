#pragma once

#include <span>
#include <string>

#include "tools/collide/collide_frames.hpp"

/// What `articular collide` writes.
namespace articular::tools {

/// {"bodies": [...], "frames": [...], "memory_bytes": n}, with times in seconds.
std::string to_json(std::span<const MeshSeries> bodies, const CollideFigures& figures);

/// The bodies, and a line a frame; of long series a summary.
std::string to_text(std::span<const MeshSeries> bodies, const CollideFigures& figures);

/// The table of pairs, frame by frame.
class PairTable {
 public:
  void add(std::span<const PairRow> rows);
  const std::string& csv() const { return csv_; }

 private:
  std::string csv_ = "frame,triangle_body,triangle_tet,triangle_face,tet_body,tet\n";
};

}  // namespace articular::tools
