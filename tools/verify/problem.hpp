#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// What `articular verify` solves, and what has to come out.
namespace articular::tools {

/// One number of a problem, and what it has to be.
struct Finding {
  std::string quantity, unit;
  double expected = 0, got = 0;  // [unit]
  double scale = 1;              // [unit] that deviation and tolerance are relative to
  double tolerance = 0;          // [-]

  double deviation() const { return (got - expected) / scale; }
  /// Not if a number is missing (NaN).
  bool passed() const;
};

/// A finding relative to what is expected, which is not 0.
Finding relative(std::string quantity, std::string unit, double expected, double got,
                 double tolerance);
/// A finding that ought to be 0, relative to a scale.
Finding vanishing(std::string quantity, std::string unit, double got, double scale,
                  double tolerance);

/// Where problems are solved.
struct Laboratory {
  std::filesystem::path folder;  // of this problem alone
  std::function<bool()> is_to_stop;
};

struct Problem {
  std::string name;       // "group/problem"
  bool is_quick = false;  // solved within a second or two
  /// @throws sim::Interruption  when the laboratory asks to stop
  std::function<std::vector<Finding>(const Laboratory&)> solve;
};

}  // namespace articular::tools
