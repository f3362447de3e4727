// Rollers, planes of symmetry, grips.
#include "sim/base/pose.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

/// Translations along axes of space that are turned; nodes have no rotation of their own.
void read_held_axes(const TableReader& table, Support& support) {
  const Node& freedoms = table.at("freedoms");
  const std::array<bool, 6> named = read_freedoms(freedoms);
  const Mat3 axes = rotation_matrix(read_turn(table, "turned"));
  Eigen::Matrix3Xd& held = support.held;
  held.resize(3, 0);
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (!named[i]) continue;
    if (i >= 3)
      fail(freedoms, fmt::format("nodes of tissue have no rotation: expected translations, found "
                                 "\"{}\"",
                                 freedom_name(i)));
    held.conservativeResize(Eigen::NoChange, held.cols() + 1);
    held.rightCols<1>() = axes.col(static_cast<Eigen::Index>(i));
    support.freedoms.push_back(static_cast<int>(i));
  }
}

void append_supports(const Node& node, const Context& context, std::vector<Support>& supports) {
  const TableReader table(node, support_keys(), label(node, "support"));
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
    read_held_axes(table, support);
    for (auto axis : support.held.colwise()) axis = here.point(axis);
    supports.push_back(std::move(support));
  }
}

}  // namespace

const KeyTable& support_keys() {
  static const KeyTable kTable{
      "[[support]]",
      {{"name", {form::Text{"name"}}, kNone, "for a probe of its reaction, or a motion"},
       {"body", {form::Text{"name of a tissue"}}, kRequired, "the tissue"},
       {"region", {form::Table{region_keys}}, kRequired, "its nodes that are held; `{}`: all"},
       {"freedoms", {list_of_freedoms()}, kRequired, "translations that are held"},
       {"turned",
        {form::Vector{kAngle}},
        standard("0 0 0 rad"),
        "turns the axes by a rotation vector"},
       mirror_key()}};
  return kTable;
}

std::vector<Support> read_supports(const TableReader& document, const Context& context) {
  std::vector<Support> supports;
  read_each(entries(document, "support"),
            [&](const Node& node) { append_supports(node, context, supports); });
  return supports;
}

const Support& read_support_reference(const Node& node, const Context& context,
                                      const std::vector<Support>& supports) {
  const std::string name = context.name(read_text(node));
  std::vector<std::string> names;
  for (const Support& support : supports) {
    if (support.name.empty()) continue;
    if (support.name == name) return support;
    names.push_back(support.name);
  }
  fail(node,
       fmt::format("no [[support]] has the name `{}`{}", one_line(name), suggestion(name, names)));
}

}  // namespace articular::sim
