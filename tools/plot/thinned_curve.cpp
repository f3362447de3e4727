#include "tools/plot/thinned_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace articular::tools {

void ThinnedCurve::add(double x, double y) {
  Bucket one;
  if (!std::isnan(x) && !std::isnan(y)) {
    const Sample sample{rows_, {x, y}};
    one = {true, true, true, sample, sample, sample, sample, sample, sample};
  }
  if (rows_ % rows_a_bucket_ != 0) {
    buckets_.back() = joined(buckets_.back(), one);
  } else {
    if (buckets_.size() == kMostBuckets) halve();  // an even number: all stay full
    buckets_.push_back(one);
  }
  ++rows_;
}

ThinnedCurve::Bucket ThinnedCurve::joined(const Bucket& a, const Bucket& b) {
  Bucket both = a.has_points ? a : b;
  both.begins = a.begins;
  both.ends = b.ends;
  if (!a.has_points || !b.has_points) return both;
  both.last = b.last;
  if (b.least_x.point.x < a.least_x.point.x) both.least_x = b.least_x;
  if (b.most_x.point.x > a.most_x.point.x) both.most_x = b.most_x;
  if (b.least_y.point.y < a.least_y.point.y) both.least_y = b.least_y;
  if (b.most_y.point.y > a.most_y.point.y) both.most_y = b.most_y;
  return both;
}

void ThinnedCurve::halve() {
  for (std::size_t i = 0; i < buckets_.size() / 2; ++i)
    buckets_[i] = joined(buckets_[2 * i], buckets_[2 * i + 1]);
  buckets_.resize(buckets_.size() / 2);
  rows_a_bucket_ *= 2;
}

std::vector<std::vector<PlotPoint>> ThinnedCurve::pieces() const {
  std::vector<std::vector<PlotPoint>> pieces;
  bool is_open = false;  // whether the next point goes on with the last piece
  for (const Bucket& bucket : buckets_) {
    if (!bucket.begins) is_open = false;
    if (!bucket.has_points) continue;
    if (!is_open) pieces.emplace_back();
    std::array samples{bucket.first,   bucket.least_x, bucket.most_x,
                       bucket.least_y, bucket.most_y,  bucket.last};
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.row < b.row; });
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (i == 0 || samples[i].row != samples[i - 1].row) pieces.back().push_back(samples[i].point);
    is_open = bucket.ends;
  }
  return pieces;
}

}  // namespace articular::tools
