#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/benchmarks/collision/peer.hpp"

namespace articular::benchmarks {

struct PeerEntry {
  std::string name;
  std::function<std::unique_ptr<Peer>(std::span<const MeshView>)> make;
};

/// All that is installed here.
std::vector<PeerEntry> all_peers();

/// Debian packages of the peers that are not.
std::vector<std::string> missing_packages();

}  // namespace articular::benchmarks
