#pragma once

#include <cholmod.h>
#include <omp.h>

#include <memory>
#include <new>
#include <stdexcept>
#include <string>

/// CHOLMOD's objects with owners, and how many threads there are; for sources, and no other header.
namespace articular::fem {

class CholmodCommon {
 public:
  CholmodCommon() {
    cholmod_start(&common_);
    common_.print = 0;
  }
  ~CholmodCommon() { cholmod_finish(&common_); }
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;

  cholmod_common* get() { return &common_; }
  cholmod_common* operator->() { return &common_; }

  /// Turns CHOLMOD's status into an exception.
  void check() const {
    if (common_.status >= CHOLMOD_OK) return;
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status == CHOLMOD_TOO_LARGE) {
      throw std::length_error("the Cholesky factor has more than 2^31 - 1 entries");
    }
    throw std::logic_error("CHOLMOD status " + std::to_string(common_.status));
  }

 private:
  cholmod_common common_{};
};

struct CholmodFree {
  cholmod_common* common;
  void operator()(cholmod_factor* p) const { cholmod_free_factor(&p, common); }
};
template <class T>
using CholmodHandle = std::unique_ptr<T, CholmodFree>;

/// CHOLMOD asks OpenMP for four threads for its copying loops whatever it is told; on a machine
/// with fewer free cores their spinning doubles the time. While this lives, a
/// parallel region of the calling thread has one thread.
class OneThread {
 public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_ = omp_get_max_active_levels();
};

}  // namespace articular::fem
