// Part of block_kernels.inl.hpp.
//
// Boxes of blocks and of faces, from positions.

#include "collision/blocks/block_kernels.hpp"

namespace articular::collision::ARTICULAR_INSTRUCTION_SET {
namespace {

inline float low_in(const BoxFrame& frame, double low, int axis) {
  return static_cast<float>((low - frame.half_margin - frame.origin[axis]) * frame.inverse_scale) -
         frame.slack;
}
inline float high_in(const BoxFrame& frame, double high, int axis) {
  return static_cast<float>((high + frame.half_margin - frame.origin[axis]) * frame.inverse_scale) +
         frame.slack;
}

void fit_blocks(const BoxFrame& frame, const BlockFit& fit) {
  for (int block = 0; block < fit.num_blocks; ++block) {
    Box4 box = Box4::at(fit.positions + 4 * fit.nodes[fit.begin[block]]);
    for (int i = fit.begin[block] + 1; i < fit.begin[block + 1]; ++i)
      box.include(fit.positions + 4 * fit.nodes[i]);
    double low[4], high[4];
    box.store(low, high);
    BoxGroup& group = fit.groups[block / kBlockSize];
    for (int axis = 0; axis < 3; ++axis) {
      group.low[axis][block % kBlockSize] = low_in(frame, low[axis], axis);
      group.high[axis][block % kBlockSize] = high_in(frame, high[axis], axis);
    }
  }
}

void fit_faces(const BoxFrame& frame, const FaceFit& fit) {
  const std::int32_t* node = fit.nodes;
  double* to = fit.corners;
  for (int first = 0; first < fit.num_faces; first += kBlockSize) {
    double corners[3][3][kBlockSize];
    for (int k = 0; k < 3; ++k)
      for (int lane = 0; lane < kBlockSize; ++lane) {
        const double* p = fit.positions + 4 * *node++;
        for (int axis = 0; axis < 3; ++axis) corners[k][axis][lane] = p[axis];
      }
    __builtin_memcpy(to, corners, sizeof(corners));
    to += 9 * kBlockSize;
    BoxGroup& group = fit.groups[first / kBlockSize];
    const int num = fit.num_faces - first < kBlockSize ? fit.num_faces - first : kBlockSize;
    for (int axis = 0; axis < 3; ++axis)
      for (int lane = 0; lane < num; ++lane) {
        const double p = corners[0][axis][lane], q = corners[1][axis][lane],
                     r = corners[2][axis][lane];
        const double low = p < q ? p : q, high = p > q ? p : q;
        group.low[axis][lane] = low_in(frame, low < r ? low : r, axis);
        group.high[axis][lane] = high_in(frame, high > r ? high : r, axis);
      }
  }
}

}  // namespace
}  // namespace articular::collision::ARTICULAR_INSTRUCTION_SET
