#include "tests/benchmarks/collision/peer.hpp"

#include "tests/benchmarks/support/timing.hpp"

namespace articular::benchmarks {
namespace {

class WithNarrowTest final : public Peer {
 public:
  WithNarrowTest(std::unique_ptr<BroadPhase> broad_phase, NarrowTest test)
      : broad_phase_(std::move(broad_phase)), test_(test) {}

  void query(std::span<const MeshView> bodies, Found& found) override {
    narrow_seconds_ = 0;
    broad_phase_->update(bodies);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const std::size_t other = bodies.size() - 1 - k;
      pairs_.clear();
      Candidates candidates(bodies[k], bodies[other], pairs_);
      broad_phase_->find(k, other, candidates);
      const double start = cpu_seconds();
      test_(bodies[k], bodies[other], pairs_, found[k]);
      narrow_seconds_ += cpu_seconds() - start;
    }
  }
  double narrow_seconds() const override { return narrow_seconds_; }
  std::optional<std::size_t> bytes() const override {
    const std::optional<std::size_t> bytes = broad_phase_->bytes();
    if (!bytes) return {};
    return *bytes + pairs_.capacity() * sizeof(Penetration);
  }

 private:
  std::unique_ptr<BroadPhase> broad_phase_;
  NarrowTest test_;
  std::vector<Penetration> pairs_;
  double narrow_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Peer> with_narrow_test(std::unique_ptr<BroadPhase> broad_phase, NarrowTest test) {
  return std::make_unique<WithNarrowTest>(std::move(broad_phase), test);
}

}  // namespace articular::benchmarks
