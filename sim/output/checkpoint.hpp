#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sim/base/append_file.hpp"
#include "sim/model/state.hpp"

namespace articular::sim {

/// A place to go on from: the state in full precision, and how far the files had grown.
struct Checkpoint {
  State state;
  FileExtent history, series, convergence;
};

/// Writes FOLDER/state.bin, whole or not at all; the one before becomes FOLDER/previous.bin. It
/// outlasts a power cut. @throws SystemError
void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                      const std::string& fingerprint);

/// The newest whole one. Where state.bin is damaged, the one before takes its place.
/// @param warn  told of one that is damaged, where the one before serves
/// @return nothing when there is none
/// @throws InputError when none is whole, or one belongs to another scenario
/// @throws SystemError when one is there and can't be read
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                          const std::string& fingerprint,
                                          const std::function<void(const std::string&)>& warn);

}  // namespace articular::sim
