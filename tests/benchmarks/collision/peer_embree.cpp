// Embree's bounding volume hierarchies over boxes as "user geometry", and its rtcCollide.
#include <embree3/rtcore.h>

#include <stdexcept>
#include <string>

#include "tests/benchmarks/collision/element_boxes.hpp"
#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {
namespace {

// A tree is either made again each frame, by the quickest of Embree's builders, or keeps its
// topology and gets new boxes.
enum class Update { Rebuild, Refit };

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Scene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

void write_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& boxes = *static_cast<const std::vector<Box>*>(arguments->geometryUserPtr);
  const Box& box = boxes[arguments->primID];
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = box.min[0];
  bounds.lower_y = box.min[1];
  bounds.lower_z = box.min[2];
  bounds.upper_x = box.max[0];
  bounds.upper_y = box.max[1];
  bounds.upper_z = box.max[2];
}

/// The tree over one set of boxes, which must stay where it is.
class BoxScene {
 public:
  BoxScene(RTCDevice device, std::vector<Box>& boxes, Update update)
      : scene_(rtcNewScene(device)), geometry_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER)) {
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry_, &boxes);
    rtcSetGeometryBoundsFunction(geometry_, write_bounds, nullptr);
    rtcSetGeometryBuildQuality(
        geometry_, update == Update::Refit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_.get(), geometry_);
    rtcReleaseGeometry(geometry_);  // the scene keeps it
  }

  void commit() {
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_.get());
  }
  RTCScene scene() const { return scene_.get(); }

 private:
  Scene scene_;
  RTCGeometry geometry_;
};

class Embree final : public BroadPhase {
 public:
  explicit Embree(Update update) : update_(update), device_(rtcNewDevice("threads=1")) {
    if (!device_)
      throw std::runtime_error("Embree has no device here: error " +
                               std::to_string(rtcGetDeviceError(nullptr)));
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, &bytes_);
  }

  void update(std::span<const MeshView> bodies) override {
    boxes_.resize(bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) boxes_[k].update(bodies[k]);
    if (scenes_.empty())
      for (ElementBoxes& boxes : boxes_) {
        scenes_.emplace_back(device_.get(), boxes.faces, update_);
        scenes_.emplace_back(device_.get(), boxes.tets, update_);
      }
    for (BoxScene& scene : scenes_) scene.commit();
  }

  void find(std::size_t faces_of, std::size_t tets_of, Candidates& candidates) override {
    Query query{boxes_[faces_of].faces, boxes_[tets_of].tets, candidates};
    rtcCollide(scenes_[2 * faces_of].scene(), scenes_[2 * tets_of + 1].scene(), take, &query);
  }

  std::optional<std::size_t> bytes() const override {
    std::size_t bytes = static_cast<std::size_t>(bytes_);
    for (const ElementBoxes& boxes : boxes_) bytes += boxes.bytes();
    return bytes;
  }

 private:
  struct Query {
    const std::vector<Box>& faces;
    const std::vector<Box>& tets;
    Candidates& candidates;
  };

  /// All pairs of two leaves, which hold a few boxes each.
  static void take(void* user, RTCCollision* collisions, unsigned count) {
    Query& query = *static_cast<Query*>(user);
    for (unsigned i = 0; i < count; ++i) {
      const unsigned face = collisions[i].primID0, tet = collisions[i].primID1;
      if (overlap(query.faces[face], query.tets[tet]))
        query.candidates.add(static_cast<int>(face), static_cast<int>(tet));
    }
  }

  static bool count_bytes(void* user, ssize_t bytes, bool) {
    *static_cast<std::ptrdiff_t*>(user) += bytes;
    return true;
  }

  Update update_;
  std::ptrdiff_t bytes_ = 0;  // outlives the device, which counts what it releases
  Device device_;
  std::vector<ElementBoxes> boxes_;
  std::vector<BoxScene> scenes_;  // faces, tetrahedra of each body
};

}  // namespace

std::unique_ptr<BroadPhase> embree_rebuilt() { return std::make_unique<Embree>(Update::Rebuild); }
std::unique_ptr<BroadPhase> embree_refitted() { return std::make_unique<Embree>(Update::Refit); }

}  // namespace articular::benchmarks
