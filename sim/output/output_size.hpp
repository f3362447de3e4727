#pragma once

#include <filesystem>

#include "sim/model/model.hpp"

namespace articular::sim {

/// What a run will write, estimated before it: frames to a few hundredths, rows as if with full
/// digits. What is written once (bodies that stay) is left out.
struct OutputSize {
  double num_frames;
  double frame_bytes;  // of all bodies together
  double num_rows;     // of the history
  double row_bytes;

  double total_bytes() const { return num_frames * frame_bytes + num_rows * row_bytes; }
};

OutputSize estimated_output(const Scenario& scenario, const Model& model);

/// @param folder  an existing one
/// @throws InputError when the disk has not so much free
void refuse_more_than_fits(const OutputSize& size, const std::filesystem::path& folder);

}  // namespace articular::sim
