#include "tools/render/render_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "tools/render/render.hpp"
#include "tools/shipped/shipped_scenarios.hpp"

namespace articular::tools {
namespace {

/// "skull=0.3" into the map; what is wrong with it, or "".
std::string add_opacity(const std::string& text, std::map<std::string, double>& opacity) {
  const auto sign = text.rfind('=');
  char* rest = nullptr;
  const double value = sign == std::string::npos ? 0 : std::strtod(text.c_str() + sign + 1, &rest);
  if (rest == nullptr || *rest != '\0' || sign == 0 || sign + 1 == text.size())
    return "expected BODY=NUMBER, e.g. skull=0.3, not `" + text + "`";
  opacity[text.substr(0, sign)] = value;
  return "";
}

void add_contents(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--field", options.field,
                  "What colours the tissue [von_mises]; activation, force or length colour "
                  "muscles and ligaments")
      ->type_name(
          "von_mises|contact_pressure|displacement|velocity|contact_force|volume_ratio|strain_"
          "energy_density|fibre_stretch|activation|force|length");
  command.add_flag("--flat", options.flat,
                   "Colour each element or face by its own value [means at nodes]");
  CLI::Option* const frame =
      command.add_option("--frame", options.frame, "Number of the frame to draw [the last]");
  command.add_flag("--all", options.all, "Draw every frame")->excludes(frame);
  command
      .add_option("--only", options.only,
                  "Draw these parts alone, e.g. disc_left,disc_right, or the surface that a body "
                  "touches with, skull:contact")
      ->delimiter(',')
      ->type_name("PART,...");
  command.add_option("--hide", options.hidden, "Leave these parts out, e.g. skull,lines")
      ->delimiter(',')
      ->type_name("PART,...");
  command
      .add_option("--clip", options.clip,
                  "Keep one side of a plane across an axis, e.g. \"y<12mm\"")
      ->type_name("PLANE");
  command.add_option("--deformation", options.deformation,
                     "Draw motions since the first frame so many times as large [1]");
  command.add_flag("--side-by-side", options.side_by_side,
                   "Draw two to four runs in one picture, at the times of the first");
  command.add_flag("--difference", options.difference,
                   "Of two runs with the same meshes draw the second one's field minus the first "
                   "one's");
}

void add_eye(CLI::App& command, RenderOptions& options) {
  command.add_option("--focus", options.focus, "Body that shall fill every picture [all of them]")
      ->type_name("BODY");
  command.add_option("--view", options.view, "Where the picture is taken from [three-quarter]")
      ->type_name("front|back|left|right|top|bottom|three-quarter");
  command.add_option("--up", options.up,
                     "Upward axis: z (y posterior) or y (z anterior) [as output.directions of the "
                     "scenario, else z]");
}

void add_look(CLI::App& command, RenderOptions& options) {
  command
      .add_option_function<std::vector<std::string>>(
          "--range",
          [&options](const std::vector<std::string>& ends) {
            options.range = {ends.at(0), ends.at(1)};
          },
          "Ends of the colours, with their unit, e.g. 0 \"2 MPa\" [from the values in all frames "
          "of "
          "all runs]")
      ->expected(2)
      ->type_name("LOW HIGH");
  command
      .add_option("--colour-map", options.colour_map,
                  "Colours of the field [viridis; blue-red for values on both sides of rest]")
      ->type_name("viridis|magma|cividis|blue-red");
  command.add_option("--background", options.background,
                     "white, black, transparent, or a colour by name [white]");
  command
      .add_option_function<std::vector<std::string>>(
          "--opacity",
          [&options](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
              if (const std::string wrong = add_opacity(text, options.opacity); !wrong.empty())
                throw CLI::ValidationError("--opacity", wrong);
          },
          "How opaque bodies are, above 0 to 1, e.g. skull=0.2,mandible=1 [bones 0.3 where a "
          "field is drawn]")
      ->delimiter(',')
      ->type_name("BODY=NUMBER,...");
  command.add_flag("--mesh-edges", options.mesh_edges, "Draw the edges of meshes");
  command.add_flag("--fibres", options.fibres,
                   "Draw fibres on the surface of tissue that has them");
  command
      .add_option("--size", options.size,
                  "Size in pixels, or in print with mm, e.g. 170x110mm [1600x1000]")
      ->type_name("WxH");
  command.add_option("--dpi", options.dpi,
                     "Pixels an inch in print: text is then 8 points high there [300 with mm]");
}

void add_files(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--movie", options.movie,
                  "Write a film: .mp4 with ffmpeg, or .ogv; without an ending .mp4 if ffmpeg is "
                  "installed")
      ->type_name("FILE");
  command.add_option("--speed", options.speed,
                     "Simulated time by time of the film, e.g. 0.1 for slow motion [25 frames a "
                     "second]");
  command
      .add_option("--out", options.out,
                  "Folder for the pictures [DIR/render; of a scenario or of several runs together "
                  "the working folder]")
      ->type_name("DIR");
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& command =
      *app.add_subcommand("render", "Draw frames of runs, or the set-up of a scenario");
  command
      .add_option(
          "run", options->runs,
          "Folders of runs (or .pvd files): pictures or a film of their frames, with one "
          "scale for all. A scenario (.toml, or the name of a shipped one): bodies, attached "
          "nodes, ends of muscles and ligaments before any run")
      ->required()
      ->type_name("DIR|SCENARIO");
  add_contents(command, *options);
  add_eye(command, *options);
  add_look(command, *options);
  add_files(command, *options);
  command.callback([options, &exit_code] {
    std::error_code error;
    for (auto& run : options->runs) {
      if (!std::filesystem::exists(run, error)) run = shipped_file(run).value_or(run);
      if (run.extension() == ".toml" && std::filesystem::exists(run, error))
        run = find_file_for("run", run);
    }
    exit_code = render(*options);
  });
}

}  // namespace articular::tools
