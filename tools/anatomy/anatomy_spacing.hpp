#pragma once

#include <vector>

namespace articular::anatomy {

/// Where cells are smaller: `factor` times within `reach` of the middle, from twice that on no
/// more.
struct Focus {
  double middle, reach;  // from the middle of the line [mm]
  double factor;
};

/// An even number of cells along a line, of about a size, smaller at a focus.
class Spacing {
 public:
  /// All of one size.
  explicit Spacing(int cells) : cells_(cells) {}
  /// At least four. @param length, size  [mm]
  Spacing(double length, double size, const Focus& focus);

  int cells() const { return cells_; }
  /// Of a node that is the even one t, both from -1 to 1.
  double place(double t) const;

 private:
  int cells_;
  std::vector<double> even_;  // t at places that lie evenly from -1 to 1; empty: all do
};

}  // namespace articular::anatomy
