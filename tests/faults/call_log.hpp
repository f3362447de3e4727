#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace articular::faults {

/// A call that changed a folder, or tried to, as the fault layer wrote it down. The place in the
/// log, from 1, is the number by which the layer makes it fail.
struct Call {
  enum class Kind : char {
    Failed = 'x',      // changed nothing
    Open = 'o',        // `path` as `handle`
    OpenEmpty = 'e',   // and what it held is gone
    Write = 'w',       // `data` at `offset` of `handle`
    Cut = 'c',         // `handle` is `offset` bytes long from then on
    Sync = 's',        // `handle`, a file or a folder
    Rename = 'r',      // `path` is `to`
    Remove = 'u',      // `path`
    MakeFolder = 'm',  // `path`
  };
  Kind kind = Kind::Failed;
  int handle = -1;  // of one open call
  std::uint64_t offset = 0;
  std::string path, to, data;
};

/// One line of numbers, then the texts.
std::string packed(const Call& call);

/// @throws std::runtime_error where the log ends within a call
std::vector<Call> read_calls(const std::filesystem::path& log);

}  // namespace articular::faults
