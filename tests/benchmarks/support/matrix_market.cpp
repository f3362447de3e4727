#include "tests/benchmarks/support/matrix_market.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <system_error>

namespace articular::benchmarks {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Entries of a sparse matrix, whose number stands at the file's begin: it is filled in at the end.
class EntryFile {
 public:
  EntryFile(const std::filesystem::path& path, const char* symmetry, int rows, int columns)
      : path_(path), rows_(rows), columns_(columns), file_(std::fopen(path.c_str(), "w")) {
    if (!file_) fail();
    std::fprintf(file_.get(), "%%%%MatrixMarket matrix coordinate real %s\n", symmetry);
    sizes_ = std::ftell(file_.get());
    write_sizes();
  }
  ~EntryFile() = default;
  EntryFile(const EntryFile&) = delete;
  EntryFile& operator=(const EntryFile&) = delete;

  /// Rows and columns count from 0.
  void add(int row, int column, double value) {
    std::fprintf(file_.get(), "%d %d %.17g\n", row + 1, column + 1, value);
    ++entries_;
  }
  void close() {
    std::fseek(file_.get(), sizes_, SEEK_SET);
    write_sizes();
    if (std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0) fail();
  }

 private:
  void write_sizes() {
    std::fprintf(file_.get(), "%d %d %-20lld\n", rows_, columns_, static_cast<long long>(entries_));
  }
  [[noreturn]] void fail() const {
    throw std::system_error(errno, std::generic_category(), "cannot write " + path_.string());
  }

  std::filesystem::path path_;
  int rows_ = 0, columns_ = 0;
  std::int64_t entries_ = 0;
  long sizes_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace

void write_matrix(const std::filesystem::path& path, const fem::BlockMatrix& A) {
  const int n = 3 * A.num_blocks();
  EntryFile file(path, "symmetric", n, n);
  for (int i = 0; i < A.num_blocks(); ++i)
    for (int s = A.row_begin()[static_cast<std::size_t>(i)];
         s < A.row_begin()[static_cast<std::size_t>(i) + 1]; ++s) {
      const int j = A.column()[static_cast<std::size_t>(s)];
      for (int b = 0; b < 3; ++b)
        for (int a = 0; a < 3; ++a)
          if (3 * i + a >= 3 * j + b) file.add(3 * i + a, 3 * j + b, A.block(s)(a, b));
    }
  file.close();
}

void write_matrix(const std::filesystem::path& path, const Eigen::MatrixXd& A) {
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "w"));
  if (file) {
    std::fprintf(file.get(), "%%%%MatrixMarket matrix array real general\n%lld %lld\n",
                 static_cast<long long>(A.rows()), static_cast<long long>(A.cols()));
    for (const double value : A.reshaped()) std::fprintf(file.get(), "%.17g\n", value);
  }
  if (!file || std::fflush(file.get()) != 0 || std::ferror(file.get()) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
}

void write_gradients(const std::filesystem::path& path, std::span<const fem::PressureTerm> terms) {
  int columns = 0;
  for (const fem::PressureTerm& term : terms) columns += term.G->num_pressures();
  EntryFile file(path, "general", 3 * terms.front().G->num_nodes(), columns);
  int first = 0;
  for (const fem::PressureTerm& term : terms) {
    const fem::PressureGradient& G = *term.G;
    for (int i = 0; i < G.num_nodes(); ++i)
      for (int s = G.row_begin()[static_cast<std::size_t>(i)];
           s < G.row_begin()[static_cast<std::size_t>(i) + 1]; ++s)
        for (int a = 0; a < 3; ++a)
          file.add(3 * i + a, first + G.column()[static_cast<std::size_t>(s)], G.block(s)[a]);
    first += G.num_pressures();
  }
  file.close();
}

void write_compliances(const std::filesystem::path& path,
                       std::span<const fem::PressureTerm> terms) {
  int size = 0;
  for (const fem::PressureTerm& term : terms) size += term.pressure->size();
  EntryFile file(path, "symmetric", size, size);
  int first = 0;
  for (const fem::PressureTerm& term : terms) {
    const fem::SymmetricMatrix& C = term.pressure->compliance();
    for (int j = 0; j < C.size(); ++j)
      for (int s = C.begin[static_cast<std::size_t>(j)];
           s < C.begin[static_cast<std::size_t>(j) + 1]; ++s)
        file.add(first + j, first + C.row[static_cast<std::size_t>(s)],
                 C.value[static_cast<std::size_t>(s)] / term.scale);
    first += C.size();
  }
  file.close();
}

}  // namespace articular::benchmarks
