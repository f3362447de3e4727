#pragma once

#include <cstddef>
#include <vector>

namespace articular::tools {

struct PlotPoint {
  double x = 0, y = 0;
  bool operator==(const PlotPoint&) const = default;
};

/// A curve of any number of rows in bounded memory. Rows are gathered in buckets of equal number;
/// of each bucket the first and the last point stay, and those with the least and the largest x and
/// y. So no extreme is lost, and what is lost lies within a two-thousandth of the rows: less than a
/// line is wide. Up to that many rows every point stays.
class ThinnedCurve {
 public:
  static constexpr std::size_t kMostBuckets = 4096;

  /// The point of the next row; where a coordinate is NaN there is none, and the curve has a gap.
  void add(double x, double y);

  /// What is to be drawn: points joined by lines, and gaps between the pieces. A gap is kept where
  /// it reaches to the end of a bucket; shorter ones are not to be seen.
  std::vector<std::vector<PlotPoint>> pieces() const;

 private:
  struct Sample {
    std::size_t row = 0;
    PlotPoint point;
  };
  struct Bucket {
    bool has_points = false;
    bool begins = false, ends = false;  // whether its first and its last row have a point
    Sample first, last, least_x, most_x, least_y, most_y;
  };
  static Bucket joined(const Bucket& a, const Bucket& b);
  void halve();

  std::vector<Bucket> buckets_;
  std::size_t rows_ = 0, rows_a_bucket_ = 1;
};

}  // namespace articular::tools
