#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "sim/output/history.hpp"
#include "tests/sim/support/scene.hpp"

namespace articular::sim {

/// What a run's probes say now, by the names of the columns.
class Probes {
 public:
  explicit Probes(const Simulation& run) : history_(run.model, {}) {
    history_.record(run.state, run.stepper);
  }
  double operator()(const std::string& name) const {
    const auto& names = history_.columns();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::out_of_range(name);
    return history_.last().at(static_cast<std::size_t>(found - names.begin()));
  }
  Vec3 vec3(const std::string& what, const std::string& unit) const {
    const auto along = [&](const char* axis) {
      return (*this)(what + "." + axis + " [" + unit + "]");
    };
    return {along("x"), along("y"), along("z")};
  }

 private:
  History history_;
};

}  // namespace articular::sim
