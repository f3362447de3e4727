// CGAL's box intersection: Zomorodian, Edelsbrunner. Fast Software for Box Intersections. 2002.
#include <CGAL/box_intersection_d.h>

#include "tests/benchmarks/collision/element_boxes.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

// Below this number of boxes CGAL sorts and scans them instead of dividing further. Measured: its
// default of 10 takes three times as long, 4000 one and a half times.
constexpr std::ptrdiff_t kCutoff = 1000;

using CgalBox =
    CGAL::Box_intersection_d::Box_with_info_d<float, 3, int,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

/// CGAL sorts pointers: the boxes themselves stay, in the order of the elements.
struct BoxList {
  std::vector<CgalBox> boxes;
  std::vector<const CgalBox*> sorted;

  void fill(const std::vector<Box>& from, const Box& region) {
    boxes.clear();
    for (std::size_t i = 0; i < from.size(); ++i)
      if (overlap(from[i], region)) {
        Eigen::Array4f min = from[i].min, max = from[i].max;  // CGAL's pointers are not const
        boxes.emplace_back(min.data(), max.data(), static_cast<int>(i));
      }
    sorted.clear();
    for (const CgalBox& box : boxes) sorted.push_back(&box);
  }
};

class CgalBoxIntersection final : public BroadPhase {
 public:
  void update(std::span<const MeshView> bodies) override {
    boxes_.resize(bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) boxes_[k].update(bodies[k]);
  }

  void find(std::size_t faces_of, std::size_t tets_of, Candidates& candidates) override {
    Box region;
    region.min = boxes_[faces_of].bounds.min.max(boxes_[tets_of].bounds.min);
    region.max = boxes_[faces_of].bounds.max.min(boxes_[tets_of].bounds.max);
    faces_.fill(boxes_[faces_of].faces, region);
    tets_.fill(boxes_[tets_of].tets, region);
    CGAL::box_intersection_d(
        faces_.sorted.begin(), faces_.sorted.end(), tets_.sorted.begin(), tets_.sorted.end(),
        [&](const CgalBox* face, const CgalBox* tet) { candidates.add(face->info(), tet->info()); },
        kCutoff, CGAL::Box_intersection_d::CLOSED);
  }

 private:
  std::vector<ElementBoxes> boxes_;
  BoxList faces_, tets_;
};

}  // namespace

std::unique_ptr<BroadPhase> cgal_box_intersection() {
  return std::make_unique<CgalBoxIntersection>();
}

}  // namespace articular::benchmarks
