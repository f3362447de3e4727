#include "tools/run/portable_start.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "fem/solver/processor.hpp"
#include "sim/base/error.hpp"

namespace articular::tools {
namespace {

/// Is set while the program starts anew: it does so once.
constexpr const char* kStartedAnew = "ARTICULAR_STARTED_ANEW";

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// What the user has set for the C library stays, but for what is ours.
std::string wanted_tunables() {
  const std::string_view ours = fem::kPortableLibc;
  const std::string_view name = ours.substr(0, ours.find('=') + 1);
  std::istringstream given(variable(fem::kPortableLibcVariable));
  std::string wanted;
  for (std::string tunable; std::getline(given, tunable, ':');)
    if (!tunable.starts_with(name)) wanted += tunable + ":";
  return wanted + std::string(ours);
}

[[noreturn]] void start_anew() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string line{std::istreambuf_iterator<char>(in), {}};
  std::vector<char*> words;
  for (std::size_t at = 0; at < line.size(); at = line.find('\0', at) + 1)
    words.push_back(line.data() + at);
  words.push_back(nullptr);
  if (words.size() > 1) execv("/proc/self/exe", words.data());
  throw sim::SystemError("the program can't be started anew, as --reproducible needs it");
}

}  // namespace

void use_portable_arithmetic() {
  const std::string tunables = wanted_tunables();
  const bool is_told = variable(fem::kPortableBlasVariable) == fem::kPortableBlas &&
                       variable(fem::kPortableLibcVariable) == tunables;
  if (!is_told && std::getenv(kStartedAnew) == nullptr) {
    setenv(fem::kPortableBlasVariable, fem::kPortableBlas, 1);
    setenv(fem::kPortableLibcVariable, tunables.c_str(), 1);
    setenv(kStartedAnew, "1", 1);
    start_anew();
  }
  unsetenv(kStartedAnew);
  if (!is_told)
    throw sim::SystemError(fmt::format(
        "--reproducible needs {}={} and {}={} in the environment of the program, and can't set "
        "them",
        fem::kPortableBlasVariable, fem::kPortableBlas, fem::kPortableLibcVariable, tunables));
  if (const std::string kernels = fem::processor().blas_kernels; kernels != fem::kPortableBlas)
    throw sim::SystemError(
        fmt::format("--reproducible needs the kernels {} of OpenBLAS, and this one has {}",
                    fem::kPortableBlas, kernels));
  fem::use_portable_kernels();
}

}  // namespace articular::tools
