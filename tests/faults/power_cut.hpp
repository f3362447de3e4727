#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <random>
#include <span>

#include "tests/faults/call_log.hpp"

namespace articular::faults {

/// Of what was done to a file or folder since its last fsync, what is on the disk after a power
/// cut.
enum class Survives {
  Nothing,
  All,
  Beginning,  // the first calls, any number of them
  Any,        // any of them: a disk may write in another order
  Torn,       // all, but of the last write to a file half, and then zeros
};

struct PowerCut {
  const char* name;
  Survives names;  // of files in a folder
  Survives data;   // in a file
};

/// A rename may be on the disk before what the file holds, or long after.
inline constexpr std::array kPowerCuts = {
    PowerCut{"nothing that was not synced", Survives::Nothing, Survives::Nothing},
    PowerCut{"names without data", Survives::All, Survives::Nothing},
    PowerCut{"data without names", Survives::Nothing, Survives::All},
    PowerCut{"a torn last write", Survives::All, Survives::Torn},
    PowerCut{"the beginning of each", Survives::Beginning, Survives::Beginning},
    PowerCut{"any of all", Survives::Any, Survives::Any},
};

/// Makes the folder as it may be after a power cut that came when these calls had been made.
/// @param before  the folder before them; all in it was synced
/// @param folder  its path in the calls
/// @param after   a folder that is not there yet
void cut_power(const std::filesystem::path& before, const std::filesystem::path& folder,
               std::span<const Call> calls, const PowerCut& cut, std::mt19937& random,
               const std::filesystem::path& after);

}  // namespace articular::faults
