#include "sim/output/provenance.hpp"

#include <fmt/format.h>
#include <gnu/libc-version.h>

#include "fem/solver/processor.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/hash.hpp"
#include "sim/base/version.hpp"

namespace articular::sim {
namespace {

#ifdef __clang__
constexpr const char* kCompiler = __VERSION__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

}  // namespace

Provenance provenance() {
  const fem::Processor processor = fem::processor();
  return {kVersion,
          kCompiler,
          ARTICULAR_FLAGS,
          processor.instruction_set,
          processor.blas_kernels,
          processor.blas_version,
          processor.cholmod_version,
          gnu_get_libc_version()};
}

std::vector<InputFile> input_files(const Scenario& scenario) {
  std::vector<InputFile> inputs;
  for (const std::filesystem::path& file : scenario.files) {
    const std::string bytes = file_bytes(file);
    const std::filesystem::path name = file.lexically_proximate(scenario.file.parent_path());
    inputs.push_back({name.string(), bytes.size(), fmt::format("{:016x}", hash_bytes(bytes))});
  }
  return inputs;
}

}  // namespace articular::sim
