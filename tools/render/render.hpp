#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/render/colour_scale.hpp"

namespace articular::tools {

struct RenderOptions {
  /// Folders of runs, or their .pvd; or one scenario file.
  std::vector<std::filesystem::path> runs;

  // What is drawn.
  std::string field;                      // "": von_mises, else contact_pressure, else any
  bool flat = false;                      // each element and face by its own value
  std::optional<int> frame;               // by number; none: the last
  bool all = false;                       // every frame
  std::vector<std::string> only, hidden;  // parts
  double deformation = 1;                 // motions since the first frame are drawn so large
  std::string clip;                       // "y<12mm": what is kept; "": all
  bool side_by_side = false;              // all runs in one picture
  bool difference = false;                // the second run minus the first one

  // From where.
  std::string focus;  // the body that fills the picture; "": all of them
  std::string view = "three-quarter";
  std::string up;  // axis, see view_axes()

  // How it looks.
  std::optional<AskedRange> range;
  std::string colour_map;  // "": see field_scale()
  std::string background = "white";
  std::map<std::string, double> opacity;  // of bodies
  bool mesh_edges = false;
  bool fibres = false;
  std::string size = "1600x1000";  // see page_of()
  std::optional<double> dpi;

  // Where it goes.
  std::filesystem::path movie;  // .ogv or .mp4, or without ending; "": none
  std::optional<double> speed;  // of the film: simulated by shown time; none: a frame every 1/25 s
  std::filesystem::path out;    // folder of the pictures; "": render/ in the run's folder
};

/// Draws frames of runs, or with a scenario file its set-up (see setup_picture.hpp), into
/// OUT/NAME_FIELD_VIEW_000123.png, and says on stdout what was written. All runs have one range of
/// colours and one scale of length. Every picture and movie appears whole or not at all.
/// @return 0
/// @throws InputError for a folder without frames, an unknown field, part, frame, view or movie
/// format, and for what does not go together;
///         SystemError when there is no display to be had, or a file can't be written
int render(const RenderOptions& options);

}  // namespace articular::tools
