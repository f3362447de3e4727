#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace articular::tools {

struct RenderOptions {
  std::filesystem::path run;      // its folder, or the .pvd itself; or a scenario file
  std::string field;              // "": von_mises, else contact_pressure, else the first there is
  std::optional<int> frame;       // by number; none: the last
  bool all = false;               // every frame
  std::filesystem::path movie;    // .ogv or .mp4; "": none
  std::filesystem::path out;      // folder of the pictures; "": render/ in the run's folder
  std::string focus;              // the body that fills the picture; "": all of them
  std::vector<std::string> only;  // parts that are drawn; empty: all but contact surfaces
  std::string view = "three-quarter";
  std::string up =
      "z";  // axis; z: x left, y posterior (jaw). y: x left or medial, z anterior (knee)
  int width = 1600, height = 1000;  // [pixel]
};

/// Draws frames of a run, or with a scenario file its set-up (see setup_picture.hpp), into
/// OUT/NAME_000123.png, and says on stdout what was written. Every picture and movie appears whole
/// or not at all.
/// @return 0
/// @throws InputError for a folder without frames, an unknown field, part, frame, view or movie
/// format;
///         SystemError when there is no display to be had, or a file can't be written
int render(const RenderOptions& options);

/// Adds `render` to the program; when it is chosen, exit_code becomes what render() returns.
void add_render_command(CLI::App& app, int& exit_code);

}  // namespace articular::tools
