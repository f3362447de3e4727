#include "tools/report/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/render/render_series.hpp"
#include "tools/report/page_scene.hpp"

namespace articular::tools {

std::vector<std::size_t> spread_frames(std::size_t count, double fitting) {
  const std::size_t last = count - 1;
  const double most = std::clamp(fitting - 1, 1.0, std::max(1.0, static_cast<double>(last)));
  const std::size_t intervals = std::min(last, static_cast<std::size_t>(most));
  std::vector<std::size_t> chosen{0};
  for (std::size_t k = 1; k <= intervals; ++k)
    chosen.push_back((2 * k * last + intervals) / (2 * intervals));  // rounded
  return chosen;
}

Json run_scene(const std::filesystem::path& pvd, double room) {
  const Series series = open_series(pvd);
  PageScene first;
  first.add(read_frame(series, series.frames.front()));
  const std::vector<std::size_t> chosen =
      spread_frames(series.frames.size(), room / std::max(1.0, first.bytes_a_frame()));

  PageScene scene;
  Json moments = Json::array();
  std::string length_unit = "mm";
  for (const std::size_t i : chosen) {
    const Frame frame = read_frame(series, series.frames[i]);
    scene.add(frame);
    moments.push_back(moment_of(series, frame.time));
    for (const Part& part : frame.parts)
      if (const std::string unit = text_of(*part.set, "coordinates.unit"); !unit.empty())
        length_unit = unit;
  }
  Json json = scene.json(series.summary.directions);
  json["moments"] = moments;
  json["length_unit"] = length_unit;
  json["remarks"] = scene.remarks();
  if (chosen.size() < series.frames.size())
    json["remarks"].push_back(fmt::format("{} of {} frames are shown, to keep this page small",
                                          chosen.size(), series.frames.size()));
  return json;
}

}  // namespace articular::tools
