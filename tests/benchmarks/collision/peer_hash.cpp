// Uniform grid, hashed: Teschner, Heidelberger, Müller, Pomeranets, Gross. Optimized Spatial
// Hashing for Collision Detection of Deformable Objects. VMV 2003. The faces are put into the
// cells, as they are far fewer than the tetrahedra that then look into the cells.
#include <bit>
#include <cstdint>

#include "tests/benchmarks/collision/element_boxes.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

// Edge of a cell by mean edge of a face's box. Measured: 1.5 to 3 are the same within 5 %, 1 takes
// 20 % longer.
constexpr float kCellRatio = 2;

struct Cell {
  std::int32_t x, y, z;
};

struct CellInterval {
  Cell min, max;
};

/// A pair is found in the lowest cell that both are in: no repetition.
bool lowest_common(const Cell& a, const Cell& b, const Cell& cell) {
  return std::max(a.x, b.x) == cell.x && std::max(a.y, b.y) == cell.y &&
         std::max(a.z, b.z) == cell.z;
}

class SpatialHash final : public BroadPhase {
 public:
  void update(std::span<const MeshView> bodies) override {
    boxes_.resize(bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) boxes_[k].update(bodies[k]);
  }

  void find(std::size_t faces_of, std::size_t tets_of, Candidates& candidates) override {
    const std::vector<Box>& faces = boxes_[faces_of].faces;
    region_.min = boxes_[faces_of].bounds.min.max(boxes_[tets_of].bounds.min);
    region_.max = boxes_[faces_of].bounds.max.min(boxes_[tets_of].bounds.max);
    if (!(region_.min <= region_.max).all()) return;
    sort_into_cells(faces);
    const std::vector<Box>& tets = boxes_[tets_of].tets;
    for (std::size_t tet = 0; tet < tets.size(); ++tet)
      if (overlap(tets[tet], region_))
        look_into_cells(static_cast<int>(tet), tets[tet], faces, candidates);
  }

 private:
  CellInterval cells(const Box& box) const {
    // Clamping to the region keeps the order of coordinates: who shares a cell still does.
    const Eigen::Array4f min = (box.min.max(region_.min) - region_.min) * per_edge_;
    const Eigen::Array4f max = (box.max.min(region_.max) - region_.min) * per_edge_;
    const auto cell = [](const Eigen::Array4f& p) {
      return Cell{static_cast<std::int32_t>(p[0]), static_cast<std::int32_t>(p[1]),
                  static_cast<std::int32_t>(p[2])};
    };
    return {cell(min), cell(max)};
  }

  std::size_t slot(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return ((static_cast<std::uint32_t>(x) * 73856093U) ^
            (static_cast<std::uint32_t>(y) * 19349663U) ^
            (static_cast<std::uint32_t>(z) * 83492791U)) &
           mask_;
  }

  template <class Visit>
  void for_each_cell(const CellInterval& c, Visit&& visit) const {
    for (std::int32_t z = c.min.z; z <= c.max.z; ++z)
      for (std::int32_t y = c.min.y; y <= c.max.y; ++y)
        for (std::int32_t x = c.min.x; x <= c.max.x; ++x) visit(x, y, z);
  }

  /// Counting sort of (slot, face).
  void sort_into_cells(const std::vector<Box>& faces) {
    inside_.clear();
    float sum = 0;
    for (std::size_t face = 0; face < faces.size(); ++face)
      if (overlap(faces[face], region_)) {
        inside_.push_back({{}, static_cast<int>(face)});
        sum += (faces[face].max - faces[face].min).head<3>().sum();
      }
    per_edge_ = sum > 0 ? 3 * static_cast<float>(inside_.size()) / (kCellRatio * sum) : 0;
    mask_ = std::bit_ceil(4 * inside_.size() + 1) - 1;
    begin_.assign(mask_ + 2, 0);
    for (Inside& face : inside_) {
      face.cells = cells(faces[static_cast<std::size_t>(face.face)]);
      for_each_cell(face.cells, [&](auto x, auto y, auto z) { ++begin_[slot(x, y, z)]; });
    }
    std::uint32_t num_entries = 0;
    for (std::uint32_t& begin : begin_) begin = num_entries += begin;  // now the end of each slot
    entries_.resize(num_entries);
    for (const Inside& face : inside_)
      for_each_cell(face.cells, [&](auto x, auto y, auto z) {
        entries_[--begin_[slot(x, y, z)]] = {x, y, z, face.face};
      });
  }

  void look_into_cells(int tet, const Box& box, const std::vector<Box>& faces,
                       Candidates& candidates) const {
    const CellInterval own = cells(box);
    for_each_cell(own, [&](auto x, auto y, auto z) {
      const std::size_t here = slot(x, y, z);
      for (std::uint32_t i = begin_[here]; i < begin_[here + 1]; ++i) {
        const Entry& entry = entries_[i];
        if (entry.x != x || entry.y != y || entry.z != z) continue;  // other cells of this slot
        const Box& face = faces[static_cast<std::size_t>(entry.face)];
        if (overlap(face, box) && lowest_common(cells(face).min, own.min, {x, y, z}))
          candidates.add(entry.face, tet);
      }
    });
  }

  struct Inside {
    CellInterval cells;
    int face;
  };
  struct Entry {
    std::int32_t x, y, z;
    int face;
  };

  std::vector<ElementBoxes> boxes_;
  Box region_;          // that both bodies reach into
  float per_edge_ = 0;  // cells per metre
  std::size_t mask_ = 0;
  std::vector<Inside> inside_;
  std::vector<std::uint32_t> begin_;  // per slot: its first entry
  std::vector<Entry> entries_;
};

}  // namespace

std::unique_ptr<BroadPhase> spatial_hash() { return std::make_unique<SpatialHash>(); }

}  // namespace articular::benchmarks
