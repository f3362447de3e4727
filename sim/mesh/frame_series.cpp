#include "sim/mesh/frame_series.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "sim/base/error.hpp"
#include "sim/base/file_bytes.hpp"
#include "sim/base/xml_text.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "sim/mesh/xml_events.hpp"

namespace articular::sim {
namespace {

/// The shortest text that reads back as the same number.
std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto [end, status] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

/// 123 from "frames/condyle_left_000123.vtp".
std::optional<int> index_in_name(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t underscore = stem.rfind('_');
  if (underscore == std::string::npos) return std::nullopt;
  return parse_integer(std::string_view(stem).substr(underscore + 1));
}

SeriesEntry entry(const std::string& pvd, const XmlAttributes& attributes) {
  const std::string file = attribute(attributes, "file"), time = attribute(attributes, "timestep");
  const std::optional<int> index = index_in_name(file);
  const std::optional<double> seconds = parse_number(time);
  if (!index)
    throw InputError({pvd}, "`" + one_line(file) + "` is not a frame PART_000123.vtu or .vtp");
  if (!seconds) throw InputError({pvd}, "timestep `" + one_line(time) + "` is not a number");
  return {*seconds, *index, attribute(attributes, "name"), file};
}

constexpr const char* kSeriesHead =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
    "  <Collection>\n";
constexpr const char* kSeriesTail = "  </Collection>\n</VTKFile>\n";

constexpr const char* kContactSurface = ":contact";  // bodies' names have no colon

}  // namespace

std::string contact_surface_part(const std::string& body) { return body + kContactSurface; }

bool is_contact_surface(const SeriesEntry& entry) { return entry.part.ends_with(kContactSurface); }

std::vector<SeriesEntry> read_series(const std::filesystem::path& pvd) {
  const std::string name = pvd.string();
  if (!std::filesystem::exists(pvd)) throw InputError({name}, "no such series of frames");
  const std::string text = file_bytes(pvd);
  std::vector<SeriesEntry> entries;
  bool has_collection = false;
  read_xml(name, ".pvd", text,
           {.start = [&](const std::string& element, const XmlAttributes& attributes, std::size_t) {
             if (element == "Collection") has_collection = true;
             if (element == "DataSet" && has_collection) entries.push_back(entry(name, attributes));
             return XmlNext::Continue;
           }});
  if (!has_collection) throw InputError({name}, "not readable as .pvd: it holds no <Collection>");
  // A part that stands still is listed in later frames with its first file: the frame's number is
  // that of its newest file.
  std::map<double, int> newest;
  for (const SeriesEntry& entry : entries) {
    int& index = newest.try_emplace(entry.time, entry.index).first->second;
    index = std::max(index, entry.index);
  }
  for (SeriesEntry& entry : entries) entry.index = newest.at(entry.time);
  return entries;
}

SeriesFile::SeriesFile(const std::filesystem::path& pvd) : file_(pvd) {
  file_.append(kSeriesHead, kSeriesTail);
}

SeriesFile::SeriesFile(const std::filesystem::path& pvd, const FileExtent& extent)
    : file_(pvd, extent) {
  file_.append("", kSeriesTail);
  for (const SeriesEntry& entry : read_series(pvd)) {
    part_number_.try_emplace(entry.part, part_number_.size());
    std::error_code gone;
    if (std::filesystem::file_size(pvd.parent_path() / entry.file, gone) == 0 || gone)
      throw InputError({pvd.string()}, "lists `" + entry.file +
                                           "`, which is gone or empty: put it back, or run "
                                           "without --resume");
  }
}

void SeriesFile::append(const std::vector<SeriesEntry>& entries) {
  // ParaView wants parts numbered, the same part by the same number in every frame.
  std::string text;
  for (const SeriesEntry& entry : entries) {
    const std::size_t number =
        part_number_.try_emplace(entry.part, part_number_.size()).first->second;
    text += "    <DataSet timestep=\"" + shortest(entry.time) + "\" part=\"" +
            std::to_string(number) + "\" name=\"" + xml_text(entry.part) + "\" file=\"" +
            xml_text(entry.file) + "\"/>\n";
  }
  file_.append(text, kSeriesTail);
}

std::string frame_file_name(const std::string& part, int index, const std::string& ending) {
  std::array<char, 16> digits{};
  std::snprintf(digits.data(), digits.size(), "_%06d", index);
  return part + digits.data() + ending;
}

}  // namespace articular::sim
