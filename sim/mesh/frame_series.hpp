#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace articular::sim {

/// One part (body, or the lines) of one frame, as listed in a .pvd.
struct SeriesEntry {
  double time;       // [s]
  int index;         // frame number; as in the file's name, or later for a part that stands still
  std::string part;  // name of the body, "lines", or contact_surface_part(body)
  std::string file;  // relative to the folder of the .pvd
};

/// What the contact surface of a body is called in a .pvd; no body is called like that.
std::string contact_surface_part(const std::string& body);
bool is_contact_surface(const SeriesEntry& entry);

/// The entries of a .pvd in its order. @throws InputError when it is missing or not understood
std::vector<SeriesEntry> read_series(const std::filesystem::path& pvd);

/// Writes a .pvd whole or not at all; the parts of a frame stand together. @throws SystemError
void write_series(const std::filesystem::path& pvd, const std::vector<SeriesEntry>& entries);

/// "condyle_left_000123.vtp"
std::string frame_file_name(const std::string& part, int index, const std::string& ending);

}  // namespace articular::sim
