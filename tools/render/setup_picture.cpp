#include "tools/render/setup_picture.hpp"

#include <fmt/format.h>
#include <vtkImageData.h>

#include <algorithm>
#include <set>

#include "sim/base/error.hpp"
#include "sim/build/build_model.hpp"
#include "sim/model/configuration.hpp"
#include "tools/render/nearest.hpp"
#include "tools/render/picture.hpp"
#include "tools/render/picture_name.hpp"
#include "tools/render/render_scene.hpp"
#include "tools/render/setup_frame.hpp"
#include "tools/render/virtual_display.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

void refuse_frames(const RenderOptions& options) {
  if (options.all || options.frame || !options.movie.empty() || options.deformation != 1 ||
      !options.field.empty() || options.flat || options.range || !options.colour_map.empty() ||
      !options.only.empty() || !options.hidden.empty())
    throw sim::InputError({options.runs.front().string()},
                          "a scenario has no frames and no fields yet: expected none of --all, "
                          "--frame, --movie, --deformation, --field, --flat, --range, "
                          "--colour-map, --only, --hide; or the folder of a run");
}

void add_bodies(const Frame& frame, Marks& marks) {
  for (const Part& part : frame.parts) {
    if (part.kind == PartKind::Lines) continue;
    double box[6];
    part.set->GetBounds(box);
    marks.labels.push_back(
        {0.5 * Vec3(box[0] + box[1], box[2] + box[3], box[4] + box[5]), part.name});
  }
}

/// What a picture of a run surveys, of this one frame.
Survey survey_of(const Frame& frame, const std::string& unit, const std::string& focus,
                 const ViewAxes& axes) {
  Survey result;
  result.length_unit = unit;
  ViewBox everything(axes), seen(axes);
  for (const Part& part : frame.parts) {
    everything.add(*part.set);
    add_bounds(part, result);
    if (focus.empty() || part.name == focus) seen.add(*part.set);
    if (part.kind == PartKind::Lines) result.has_muscles = true;
  }
  result.size = seen.size();
  result.middle = seen.middle();
  result.diagonal = everything.size().norm();
  return result;
}

void require_known_parts(const RenderOptions& options, const Frame& frame) {
  std::set<std::string> names, bodies;
  for (const Part& part : frame.parts) {
    names.insert(part.name);
    if (part.kind != PartKind::Lines) bodies.insert(part.name);
  }
  check_opacity(options.opacity, bodies);
  const std::string& focus = options.focus;
  if (!focus.empty() && !names.contains(focus))
    throw sim::InputError({options.runs.front().string()},
                          "--focus: " + unknown_name("part", focus, names));
}

}  // namespace

int render_setup(const RenderOptions& options) {
  refuse_frames(options);
  const fs::path& file = options.runs.front();
  const sim::Scenario scenario = sim::read_scenario(file);
  const sim::Model model = sim::build_model(scenario);
  const double unit = scenario.output.length_unit.metres;
  sim::Configuration now;
  sim::read_state(model, sim::initial_state(model).data(), 0, now);
  const Frame frame = start_frame(model, now, unit);
  if (frame.parts.empty())
    throw sim::InputError({file.string()}, "no body of this scenario has a mesh to draw");
  require_known_parts(options, frame);

  Setting setting;
  setting.page = page_of(options.size, options.dpi);
  setting.look = {paper_of(options.background), options.mesh_edges, options.fibres, options.opacity,
                  std::nullopt};
  if (!options.clip.empty()) setting.look.clip = parse_clip(options.clip);
  std::copy(scenario.output.directions.begin(), scenario.output.directions.end(),
            setting.directions.begin());
  setting.axes = view_axes(options.view, options.up, setting.directions);
  setting.survey = survey_of(frame, scenario.output.length_unit.name, options.focus, setting.axes);
  if (setting.look.clip)
    require_kept(*setting.look.clip, setting.survey.everything, setting.survey.length_unit);

  Marks marks;
  add_bodies(frame, marks);
  marks.points = {attached_nodes(model, unit), supported_nodes(model, unit),
                  line_ends(model, now, unit)};
  marks.legend = std::string("red: attached nodes; ") +
                 (model.supports.empty() ? "" : "green: supported nodes; ") +
                 "blue: ends of muscles and ligaments";

  const fs::path folder = options.out.empty() ? fs::path(".") : options.out;
  make_folder(folder);
  const VirtualDisplay display;
  RenderScene scene(setting);
  scene.set_marks(std::move(marks));
  const Image image = scene.draw({{frame, scenario.title, "set-up", *setting.survey.middle}});
  const fs::path picture =
      (folder / (picture_name(scenario.name, "setup", options) + ".png")).lexically_normal();
  write_png(picture, *image, setting.page.dpi);
  fmt::print("wrote {}\n", picture.string());
  return 0;
}

}  // namespace articular::tools
