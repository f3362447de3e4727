#include "tools/run/line_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/lines/muscle_law.hpp"
#include "sim/mesh/chord_depth.hpp"
#include "sim/mesh/triangle_tree.hpp"
#include "sim/mesh/winding_number.hpp"
#include "tools/run/rounded.hpp"

namespace articular::tools {
namespace {

constexpr double kShallow = 0.02;  // of the distance of a line's ends: too little to tell

/// From the first point of a line to the last.
Vec3 direction(const sim::Line& line, const sim::Configuration& now) {
  return (now.position(line.path.back()) - now.position(line.path.front())).normalized();
}

/// What a line can run through: closed surfaces of rigid and fixed bodies, at the start.
struct Solid {
  int body = 0;
  Positions X;  // [m]
  sim::TriangleTree tree;
};

std::vector<Solid> solids_of(const sim::Model& model) {
  std::vector<Solid> solids;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const sim::BodyModel& body = model.bodies[b];
    if (body.rigid < 0 || !sim::is_closed(body.triangles)) continue;
    Positions X = start_positions(model, body);
    sim::TriangleTree tree(X, body.triangles);
    solids.push_back({static_cast<int>(b), std::move(X), std::move(tree)});
  }
  return solids;
}

bool wraps(const sim::Line& line, const sim::Model& model, int body) {
  return std::any_of(line.wrap.bodies.begin(), line.wrap.bodies.end(), [&](int wrapped) {
    const int rigid = model.wrap_bodies[static_cast<std::size_t>(wrapped)].rigid;
    return model.rigid_bodies[static_cast<std::size_t>(rigid)].body == body;
  });
}

/// How deep a line runs through a solid, where it is deeper than at both of its ends [m]; else 0.
double depth_through(const Solid& solid, const Triangles& triangles,
                     const std::vector<Vec3>& points) {
  double depth = 0, at_ends = 0;
  for (const Vec3& end : {points.front(), points.back()})
    at_ends = std::max(at_ends, sim::depth_inside(solid.X, triangles, solid.tree, end));
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    depth =
        std::max(depth, sim::chord_depth(solid.X, triangles, solid.tree, points[i], points[i + 1]));
  return depth - at_ends > kShallow * (points.back() - points.front()).norm() ? depth : 0;
}

/// Bodies that a line runs through and doesn't wrap around.
std::string pierced(const sim::Line& line, const sim::Moment& start,
                    const std::vector<Solid>& solids) {
  std::vector<Vec3> points;
  points.reserve(line.path.size());
  for (const sim::WeightedPoint& point : line.path)
    points.push_back(start.configuration.position(point));
  std::string text;
  for (const Solid& solid : solids) {
    if (wraps(line, start.model, solid.body)) continue;
    const sim::BodyModel& body = start.model.bodies[static_cast<std::size_t>(solid.body)];
    if (const double depth = depth_through(solid, body.triangles, points); depth > 0)
      text += fmt::format(", {:.1f} mm deep through `{}`", 1e3 * depth, body.name);
  }
  return text;
}

/// Bodies that a line touches at the start.
std::string wraps_of(const sim::Line& line, const sim::Model& model, const sim::LinePath& path) {
  std::string text;
  for (std::size_t k = 0; k < line.wrap.bodies.size(); ++k) {
    std::size_t edges = 0;
    for (const sim::WrappedString& string : path.strings)
      for (const sim::EdgeCrossing& crossing : string.crossings)
        edges += crossing.surface == static_cast<int>(k) ? 1 : 0;
    const int rigid = model.wrap_bodies[static_cast<std::size_t>(line.wrap.bodies[k])].rigid;
    const int body = model.rigid_bodies[static_cast<std::size_t>(rigid)].body;
    text += fmt::format(", {} `{}`", edges > 0 ? "around" : "free of",
                        model.bodies[static_cast<std::size_t>(body)].name);
  }
  return text;
}

std::string line_row(const sim::Line& line, const sim::Moment& start,
                     const std::vector<Solid>& solids, const std::string& rest) {
  const Vec3 d = direction(line, start.configuration).unaryExpr([](double value) {
    return rounded(value, 0.01);
  });
  const auto l = static_cast<std::size_t>(&line - start.model.lines.data());
  return fmt::format("  {:<28} {:>8.2f}  ({:5.2f} {:5.2f} {:5.2f})  {:>9.4g}  {}{}{}\n", line.name,
                     1e3 * line.start_length, d.x(), d.y(), d.z(), start.lines[l].tension, rest,
                     wraps_of(line, start.model, start.paths[l]), pierced(line, start, solids));
}

std::string line_head(const std::string& what, const std::string& rest) {
  return fmt::format("  {:<28} {:>8}  {:<19}  {:>9}  {}\n", what, "mm", "direction", "N at start",
                     rest);
}

std::string beyond_path(const sim::Muscle& muscle) {
  const double length = sim::length_beyond(muscle, 0);
  return length > 0 ? fmt::format(", of which {:.2f} mm lie beyond the path", 1e3 * length) : "";
}

std::string muscles(const sim::Model& model, const sim::Moment& start,
                    const std::vector<Solid>& solids) {
  std::string text = line_head("muscle", "largest active force, optimal length");
  for (const sim::MuscleModel& muscle : model.muscles)
    text +=
        muscle.line < 0
            ? fmt::format("  {:<28} the fibres of `{}`\n", muscle.given.name, muscle.given.tissue)
            : line_row(model.lines[static_cast<std::size_t>(muscle.line)], start, solids,
                       fmt::format("{:.4g} N, {:.2f} mm{}", muscle.given.max_force,
                                   1e3 * muscle.optimal_length, beyond_path(muscle.given)));
  return text;
}

std::string ligaments(const sim::Model& model, const sim::Moment& start,
                      const std::vector<Solid>& solids) {
  std::string text = line_head("ligament", "slack length, strain at the start");
  for (const sim::LigamentModel& ligament : model.ligaments) {
    const sim::Line& line = model.lines[static_cast<std::size_t>(ligament.line)];
    text += line_row(line, start, solids,
                     fmt::format("{:.2f} mm, {:+.2f} %", 1e3 * ligament.slack_length,
                                 100 * (line.start_length / ligament.slack_length - 1)));
  }
  return text;
}

std::string boluses(const sim::Model& model, const sim::Moment& start,
                    const std::vector<Solid>& solids) {
  std::string text = line_head("bolus", "height, when it is put in, largest force");
  for (const sim::BolusModel& bolus : model.boluses) {
    const std::vector<double>& force = bolus.given.force.value;
    text += line_row(
        model.lines[static_cast<std::size_t>(bolus.line)], start, solids,
        fmt::format("{}, {:.3g} s, {:.4g} N",
                    bolus.given.height ? fmt::format("{:.2f} mm", 1e3 * *bolus.given.height)
                                       : "what is between its points",
                    bolus.given.from, *std::max_element(force.begin(), force.end())));
  }
  return text;
}

}  // namespace

std::string line_table(const sim::Model& model, const sim::Moment& start) {
  const std::vector<Solid> solids = solids_of(model);
  std::string text;
  if (!model.muscles.empty()) text += "\n" + muscles(model, start, solids);
  if (!model.ligaments.empty()) text += "\n" + ligaments(model, start, solids);
  if (!model.boluses.empty()) text += "\n" + boluses(model, start, solids);
  return text;
}

}  // namespace articular::tools
