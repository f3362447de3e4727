#pragma once

#include <random>

namespace articular::tools {

/// Numbers in [-1, 1], the same in every run and with every compiler: the engine is fixed by the
/// standard, and the distribution is written here.
class Random {
 public:
  double operator()() {
    constexpr double kLargest = 4294967295;  // 2³² − 1
    return 2 * (static_cast<double>(engine_()) / kLargest) - 1;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace articular::tools
