#include "sim/lines/line_path.hpp"

namespace articular::sim {
namespace {

/// What an edge's crossing is fixed to for the moment: a point of the rigid body. By the envelope
/// theorem the string's force is the derivative of its length all the same.
void set_point(const Model& model, const Configuration& configuration, int rigid, const Vec3& x,
               WeightedPoint& point) {
  const auto r = static_cast<std::size_t>(rigid);
  const Pose& pose = configuration.poses[r];
  point.nodes.assign(1, {model.rigid_bodies[r].block, rigid, pose.R.transpose() * (x - pose.p)});
  point.weights.assign(1, 1.0);
}

void place(const Model& model, const Line& line, const Configuration& configuration,
           std::vector<PlacedSurface>& surfaces) {
  surfaces.clear();
  for (const int b : line.wrap.bodies) {
    const WrapBody& body = model.wrap_bodies[static_cast<std::size_t>(b)];
    surfaces.push_back(body.at(configuration.poses[static_cast<std::size_t>(body.rigid)]));
  }
}

}  // namespace

void find_path(const Model& model, const Line& line, const Configuration& configuration,
               std::span<const std::vector<EdgeCrossing>> history, LinePath& path) {
  std::vector<PlacedSurface> surfaces;
  place(model, line, configuration, surfaces);
  path.strings.resize(line.wrap.strings.size());
  path.works.resize(path.strings.size());
  path.found = true;
  std::size_t count = 0;
  const auto next = [&]() -> WeightedPoint& {
    if (count == path.points.size()) path.points.emplace_back();
    return path.points[count++];
  };
  next() = line.path.front();
  for (std::size_t k = 0; k < path.strings.size(); ++k) {
    WrappedString& string = path.strings[k];
    string.from = line.wrap.strings[k].from;
    string.to = line.wrap.strings[k].to;
    string.from.x = configuration.position(line.path[k]);
    string.to.x = configuration.position(line.path[k + 1]);
    string.crossings = history[k];
    path.found = wrap(surfaces, string, path.works[k]) && path.found;
    for (std::size_t i = 0; i < string.crossings.size(); ++i) {
      const int b = line.wrap.bodies[static_cast<std::size_t>(string.crossings[i].surface)];
      set_point(model, configuration, model.wrap_bodies[static_cast<std::size_t>(b)].rigid,
                path.works[k].shape.P[i + 1], next());
    }
    next() = line.path[k + 1];
  }
  path.points.resize(count);
}

std::vector<WeightedPoint> path_from_start(const Model& model, const Line& line,
                                           const Configuration& configuration) {
  if (line.wrap.strings.empty()) return line.path;
  WrapHistory history;
  for (const WrappedString& string : line.wrap.strings) history.push_back(string.crossings);
  LinePath path;
  find_path(model, line, configuration, history, path);
  return path.points;
}

WrapHistory initial_wraps(const Model& model) {
  WrapHistory history;
  for (const Line& line : model.lines)
    for (const WrappedString& string : line.wrap.strings) history.push_back(string.crossings);
  return history;
}

void keep_wraps(const std::vector<LinePath>& paths, WrapHistory& history) {
  std::size_t k = 0;
  for (const LinePath& path : paths)
    for (const WrappedString& string : path.strings) history[k++] = string.crossings;
}

double contact_length(const LinePath& path) {
  double sum = 0;
  for (std::size_t k = 0; k < path.strings.size(); ++k) {
    const std::vector<EdgeCrossing>& c = path.strings[k].crossings;
    for (std::size_t i = 0; i + 1 < c.size(); ++i)
      if (c[i].surface == c[i + 1].surface) sum += path.works[k].shape.l[i + 1];
  }
  return sum;
}

}  // namespace articular::sim
