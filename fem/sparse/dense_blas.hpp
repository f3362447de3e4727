#pragma once

#include <cblas.h>

/// BLAS in either precision, for column-major dense blocks with a stride between columns. L is a
/// lower triangle.
namespace articular::fem::dense {

/// B ← B L⁻ᵀ, m rows and n columns.
inline void solve_from_right(int m, int n, const double* L, int ld_l, double* B, int ld_b) {
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m, n, 1, L, ld_l, B,
              ld_b);
}
inline void solve_from_right(int m, int n, const float* L, int ld_l, float* B, int ld_b) {
  cblas_strsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m, n, 1, L, ld_l, B,
              ld_b);
}

/// C ← β C + α A Bᵀ, with C of m rows and n columns, and k columns of A and B.
inline void add_product(int m, int n, int k, double alpha, const double* A, int ld_a,
                        const double* B, int ld_b, double beta, double* C, int ld_c) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, k, alpha, A, ld_a, B, ld_b, beta, C,
              ld_c);
}
inline void add_product(int m, int n, int k, float alpha, const float* A, int ld_a, const float* B,
                        int ld_b, float beta, float* C, int ld_c) {
  cblas_sgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, k, alpha, A, ld_a, B, ld_b, beta, C,
              ld_c);
}

/// x ← L⁻¹ x
inline void solve_lower(int n, const double* L, int ld, double* x) {
  cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, L, ld, x, 1);
}
inline void solve_lower(int n, const float* L, int ld, float* x) {
  cblas_strsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, L, ld, x, 1);
}

/// x ← L⁻ᵀ x
inline void solve_lower_transposed(int n, const double* L, int ld, double* x) {
  cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, L, ld, x, 1);
}
inline void solve_lower_transposed(int n, const float* L, int ld, float* x) {
  cblas_strsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, L, ld, x, 1);
}

/// y ← A x, m rows and n columns.
inline void multiply(int m, int n, const double* A, int ld, const double* x, double* y) {
  cblas_dgemv(CblasColMajor, CblasNoTrans, m, n, 1, A, ld, x, 1, 0, y, 1);
}
inline void multiply(int m, int n, const float* A, int ld, const float* x, float* y) {
  cblas_sgemv(CblasColMajor, CblasNoTrans, m, n, 1, A, ld, x, 1, 0, y, 1);
}

/// y ← y − Aᵀ x, with A of m rows and n columns.
inline void subtract_transposed(int m, int n, const double* A, int ld, const double* x, double* y) {
  cblas_dgemv(CblasColMajor, CblasTrans, m, n, -1, A, ld, x, 1, 1, y, 1);
}
inline void subtract_transposed(int m, int n, const float* A, int ld, const float* x, float* y) {
  cblas_sgemv(CblasColMajor, CblasTrans, m, n, -1, A, ld, x, 1, 1, y, 1);
}

}  // namespace articular::fem::dense
