#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/scenario/scenario.hpp"

namespace articular::sim {

/// What the last bits of results depend on, beside all inputs.
struct Provenance {
  std::string version;                        // of articular
  std::string compiler, flags;                // of the library
  std::string instruction_set, blas_kernels;  // on this machine, see fem::Processor
  std::string blas_version, cholmod_version, libc_version;
};

Provenance provenance();

/// A file that a scenario names, as it is now.
struct InputFile {
  std::string name;  // from the scenario's folder
  std::uint64_t bytes = 0;
  std::string hash;  // FNV-1a of all bytes, 64 bits, in hexadecimal
};

/// First the scenario's own.
std::vector<InputFile> input_files(const Scenario& scenario);

}  // namespace articular::sim
