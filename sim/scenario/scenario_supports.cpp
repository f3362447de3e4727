// Rollers and planes of symmetry.
#include "sim/base/pose.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

/// Translations along axes of space that are turned; nodes have no rotation of their own.
Eigen::Matrix3Xd read_held_axes(const TableReader& table) {
  const Node& freedoms = table.at("freedoms");
  const std::array<bool, 6> named = read_freedoms(freedoms);
  Mat3 axes = Mat3::Identity();
  if (const Node* turned = table.find("turned"))
    axes = rotation_matrix(read_vector(*turned, kAngle));
  Eigen::Matrix3Xd held(3, 0);
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (!named[i]) continue;
    if (i >= 3)
      fail(freedoms, fmt::format("nodes of tissue have no rotation: expected translations, found "
                                 "\"{}\"",
                                 freedom_name(i)));
    held.conservativeResize(Eigen::NoChange, held.cols() + 1);
    held.rightCols<1>() = axes.col(static_cast<Eigen::Index>(i));
  }
  return held;
}

void append_supports(const Node& node, const Context& context, std::vector<Support>& supports) {
  const TableReader table(node, label(node, "support"),
                          {"name", "body", "region", "freedoms", "turned", "mirror"});
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Support support;
    support.where = node.where;
    if (const Node* name = table.find("name")) {
      support.name = read_name(*name) + side_suffix(table, side);
      check_new_name(*name, "support", support.name, supports);
    }
    const Body& body = read_body_reference(table.at("body"), here);
    if (body.kind != Body::Kind::Tissue)
      fail(table.at("body"),
           fmt::format("a support holds nodes of tissue, and body `{}` is none{}", body.name,
                       body.kind == Body::Kind::Rigid ? "; a rigid one has `hold`" : ""));
    support.body = body.name;
    support.region = read_region(table.at("region"), here);
    support.held = read_held_axes(table);
    for (auto axis : support.held.colwise()) axis = here.point(axis);
    supports.push_back(std::move(support));
  }
}

}  // namespace

std::vector<Support> read_supports(const TableReader& document, const Context& context) {
  std::vector<Support> supports;
  read_each(entries(document, "support"),
            [&](const Node& node) { append_supports(node, context, supports); });
  return supports;
}

}  // namespace articular::sim
