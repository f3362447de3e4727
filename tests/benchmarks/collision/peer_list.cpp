// The one place that knows which packages were there when this was configured.
#include "tests/benchmarks/collision/peer_list.hpp"

namespace articular::benchmarks {
namespace {

PeerEntry broad(std::string name, std::unique_ptr<BroadPhase> (*make)()) {
  return {std::move(name), [make](std::span<const MeshView>) { return with_narrow_test(make()); }};
}

}  // namespace

std::vector<PeerEntry> all_peers() {
  std::vector<PeerEntry> peers;
  peers.push_back({"block tree", block_tree_peer});
  peers.push_back({"article's algorithm", article_peer});
  peers.push_back(broad("spatial hash", spatial_hash));
#ifdef ARTICULAR_HAS_CGAL
  peers.push_back(broad("CGAL box_intersection_d", cgal_box_intersection));
#endif
#ifdef ARTICULAR_HAS_EMBREE
  peers.push_back(broad("Embree, rebuilt", embree_rebuilt));
  peers.push_back(broad("Embree, refitted", embree_refitted));
  peers.push_back({"Embree, refitted, scalar narrow test", [](std::span<const MeshView>) {
                     return with_narrow_test(embree_refitted(), scalar_narrow_test);
                   }});
#endif
#ifdef ARTICULAR_HAS_FCL
  peers.push_back(broad("FCL AABB tree, refitted", fcl_refitted));
#endif
  return peers;
}

std::vector<std::string> missing_packages() {
  std::vector<std::string> missing;
#ifndef ARTICULAR_HAS_CGAL
  missing.emplace_back("libcgal-dev");
#endif
#ifndef ARTICULAR_HAS_EMBREE
  missing.emplace_back("libembree-dev");
#endif
#ifndef ARTICULAR_HAS_FCL
  missing.emplace_back("libfcl-dev");
#endif
  return missing;
}

}  // namespace articular::benchmarks
