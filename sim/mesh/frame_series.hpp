#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/base/append_file.hpp"

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
/// @throws SystemError when it can't be read
std::vector<SeriesEntry> read_series(const std::filesystem::path& pvd);

/// A .pvd that grows by a frame at a time. Its file is whole XML after each.
class SeriesFile {
 public:
  /// A new one, in the place of one that may be there. @throws SystemError
  explicit SeriesFile(const std::filesystem::path& pvd);
  /// Goes on where it had that extent; what follows is cut.
  /// @throws InputError where it does not begin so, or a file that it lists is gone
  SeriesFile(const std::filesystem::path& pvd, const FileExtent& extent);

  /// The parts of one frame. @throws SystemError
  void append(const std::vector<SeriesEntry>& entries);
  void sync() { file_.sync(); }
  const FileExtent& extent() const { return file_.extent(); }

 private:
  AppendFile file_;
  std::map<std::string, std::size_t> part_number_;
};

/// "condyle_left_000123.vtp"
std::string frame_file_name(const std::string& part, int index, const std::string& ending);

}  // namespace articular::sim
