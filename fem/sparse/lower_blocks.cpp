#include "fem/sparse/lower_blocks.hpp"

#include <algorithm>
#include <cstdint>

namespace articular::fem {
namespace {

/// So many rows are worth waking a thread, and so many pieces are enough for one each.
constexpr int kFewestRows = 1024, kMostPieces = 16;

}  // namespace

void LowerBlocks::take(const BlockMatrix& A) {
  row_begin_.assign(1, 0);
  column_.clear();
  below_.clear();
  diagonal_.clear();
  for (int i = 0; i < A.num_blocks(); ++i) {
    int s = A.row_begin()[i];
    for (; A.column()[s] < i; ++s) {
      const Eigen::Map<const Mat3> block = A.block(s);
      if ((block.array() == 0).all()) continue;
      column_.push_back(A.column()[s]);
      below_.push_back(block);
    }
    diagonal_.push_back(Mat3(A.block(s)).selfadjointView<Eigen::Lower>());
    row_begin_.push_back(static_cast<int>(column_.size()));
  }
  divide();
}

void LowerBlocks::divide() {
  const int count = std::clamp(num_blocks() / kFewestRows, 1, kMostPieces);
  pieces_.resize(static_cast<std::size_t>(count));
  place_.resize(column_.size());
  std::vector<int> place(diagonal_.size(), -1);  // of a row in `rows` of a piece
  for (int p = 0; p < count; ++p) {
    Piece& piece = pieces_[static_cast<std::size_t>(p)];
    const auto bound = [&](std::int64_t q) { return static_cast<int>(q * num_blocks() / count); };
    piece.begin = bound(p);
    piece.end = bound(p + 1);
    piece.rows.clear();
    for (int k = row_begin_[piece.begin]; k < row_begin_[piece.end]; ++k) {
      const int j = column_[k];
      if (j >= piece.begin) continue;
      if (place[j] < 0) {
        place[j] = static_cast<int>(piece.rows.size());
        piece.rows.push_back(j);
      }
      place_[k] = place[j];
    }
    for (const int j : piece.rows) place[j] = -1;
    piece.addend.resize(piece.rows.size());
  }
}

void LowerBlocks::multiply_piece(Piece& piece, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  std::fill(piece.addend.begin(), piece.addend.end(), Vec3::Zero());
  for (int i = piece.begin; i < piece.end; ++i) {
    const Vec3 x_i = x.segment<3>(3 * Eigen::Index{i});
    Vec3 sum = diagonal_[i] * x_i;
    int k = row_begin_[i];
    for (; k < row_begin_[i + 1] && column_[k] < piece.begin; ++k) {
      sum += below_[k] * x.segment<3>(3 * Eigen::Index{column_[k]});
      piece.addend[place_[k]] += below_[k].transpose() * x_i;
    }
    for (; k < row_begin_[i + 1]; ++k) {
      const Eigen::Index j = 3 * Eigen::Index{column_[k]};
      sum += below_[k] * x.segment<3>(j);
      y.segment<3>(j) += below_[k].transpose() * x_i;
    }
    y.segment<3>(3 * Eigen::Index{i}) = sum;  // the first to write row i: later rows add to it
  }
}

void LowerBlocks::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y, ThreadPool& pool) {
  pool.run(static_cast<int>(pieces_.size()),
           [&](int p, int) { multiply_piece(pieces_[static_cast<std::size_t>(p)], x, y); });
  for (const Piece& piece : pieces_)
    for (std::size_t k = 0; k < piece.rows.size(); ++k)
      y.segment<3>(3 * Eigen::Index{piece.rows[k]}) += piece.addend[k];
}

}  // namespace articular::fem
