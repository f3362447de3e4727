#include "tools/run/scene_table.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "sim/loads/surface_load.hpp"
#include "sim/mesh/winding_number.hpp"
#include "sim/model/mass_properties.hpp"
#include "tools/mesh/mesh_quality.hpp"
#include "tools/run/line_table.hpp"
#include "tools/run/rounded.hpp"

namespace articular::tools {
namespace {

std::string in_mm(const Vec3& x) {
  const Vec3 mm = (1e3 * x).unaryExpr([](double value) { return rounded(value, 0.1); });
  return fmt::format("({:.1f} {:.1f} {:.1f})", mm.x(), mm.y(), mm.z());
}

std::string kind_of(const sim::Model& model, const sim::BodyModel& body) {
  if (body.tissue >= 0) return "tissue";
  const sim::RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
  return rigid.unknown ? (rigid.hold ? "rigid, held" : "rigid") : rigid.motion ? "driven" : "fixed";
}

std::string or_none(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string body_row(const sim::Model& model, const sim::BodyModel& body) {
  const Positions X = start_positions(model, body);
  std::string place = "-";
  if (X.cols() > 0) {
    const Vec3 low = X.rowwise().minCoeff(), high = X.rowwise().maxCoeff(), mm = 1e3 * (high - low);
    place = fmt::format("{:.1f} x {:.1f} x {:.1f} at {}", mm.x(), mm.y(), mm.z(),
                        in_mm(0.5 * (low + high)));
  }
  std::optional<double> cubic_metres, kilograms, angle;
  std::string elements = "-";
  if (body.tissue >= 0) {
    const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
    const Tetrahedra& tets = tissue.elements.tets();
    const std::vector<double>& volume = tissue.elements.rest_volume();
    cubic_metres = std::accumulate(volume.begin(), volume.end(), 0.0);
    kilograms = tissue.lumped_mass.sum();
    elements = fmt::format("{}", tets.cols());
    angle = 180;
    for (const auto& tet : tets.colwise()) angle = std::min(*angle, least_dihedral_deg(X, tet));
  } else {
    const sim::RigidBody& rigid = model.rigid_bodies[static_cast<std::size_t>(body.rigid)];
    if (sim::is_closed(body.triangles))
      cubic_metres = sim::solid_mass_properties(body.X, body.triangles, 1).mass;
    if (rigid.unknown) kilograms = rigid.mass.mass;
  }
  return fmt::format("  {:<20} {:<12} {:<44} {:>9} {:>9} {:>9} {:>6}\n", body.name,
                     kind_of(model, body), place,
                     or_none(cubic_metres ? std::optional(*cubic_metres * 1e6) : std::nullopt),
                     or_none(kilograms ? std::optional(*kilograms * 1e3) : std::nullopt), elements,
                     angle ? fmt::format("{:.1f}", *angle) : "-");
}

std::string bodies(const sim::Model& model) {
  std::string text = fmt::format("  {:<20} {:<12} {:<44} {:>9} {:>9} {:>9} {:>6}\n", "body", "kind",
                                 "box at its middle [mm]", "cm^3", "g", "elements", "angle");
  for (const sim::BodyModel& body : model.bodies) text += body_row(model, body);
  return text +
         "  g: of a rigid body with the tissue that it carries. angle: the least one between two "
         "faces of an element [deg]; below 10 is poor\n";
}

std::string attachments(const sim::Scenario& scenario, const sim::Model& model) {
  std::set<std::pair<std::string, std::string>> told;
  std::string text;
  for (const sim::Attachment& attachment : scenario.attachments) {
    if (!told.insert({attachment.body, attachment.to}).second) continue;
    const sim::BodyModel& body =
        model.bodies[static_cast<std::size_t>(sim::body_index(scenario, attachment.body))];
    const int rigid =
        model.bodies[static_cast<std::size_t>(sim::body_index(scenario, attachment.to))].rigid;
    const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(body.tissue)];
    Eigen::AlignedBox3d box;
    int count = 0;
    for (std::size_t i = 0; i < tissue.nodes.size(); ++i) {
      if (tissue.nodes[i].rigid != rigid) continue;
      box.extend(Vec3(tissue.X.col(static_cast<Eigen::Index>(i))));
      ++count;
    }
    text +=
        fmt::format("  {:<20} to {:<20} {} of {} nodes, between {} and {} mm\n", attachment.body,
                    attachment.to, count, tissue.nodes.size(), in_mm(box.min()), in_mm(box.max()));
  }
  return text;
}

std::string in_words(const Vec3& direction) {
  const Vec3 d = direction.unaryExpr([](double value) { return rounded(value, 0.01); });
  return fmt::format("({:.2f} {:.2f} {:.2f})", d.x(), d.y(), d.z());
}

std::string supports(const sim::Scenario& scenario, const sim::Model& model) {
  std::string text;
  for (std::size_t s = 0; s < model.supports.size(); ++s) {
    const sim::SupportModel& support = model.supports[s];
    const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(support.tissue)];
    Eigen::AlignedBox3d box;
    for (const sim::SupportModel::Node& node : support.nodes)
      box.extend(Vec3(tissue.X.col(node.node)));
    std::string axes;
    for (const auto& axis : scenario.supports[s].held.colwise())
      axes += (axes.empty() ? "" : ", ") + in_words(axis);
    if (support.motion) axes += ", driven";
    text += fmt::format(
        "  {:<20} {:<23} {} of {} nodes, between {} and {} mm, held along {}\n",
        scenario.supports[s].body, support.name.empty() ? "supported" : "by " + support.name,
        support.nodes.size(), tissue.nodes.size(), in_mm(box.min()), in_mm(box.max()), axes);
  }
  return text;
}

/// Area at the start, and the force there by a factor of 1.
std::string surface_loads(const sim::Model& model, const sim::Moment& start) {
  std::string text;
  for (const sim::SurfaceLoadModel& load : model.surface_loads) {
    const sim::Tissue& tissue = model.tissues[static_cast<std::size_t>(load.tissue)];
    sim::SurfaceLoadModel whole = load;
    whole.profile = {};
    Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * model.num_blocks);
    add_surface_force(whole, start.configuration, f);
    Vec3 force = Vec3::Zero();
    for (int block = 0; block < model.layout.num_free_nodes; ++block)
      force += f.segment<3>(3 * block);
    for (const sim::RigidBody& rigid : model.rigid_bodies) force += f.segment<3>(3 * rigid.block);
    if (const double unit = 1e-6 * force.norm(); unit > 0)
      force = force.unaryExpr([unit](double value) { return rounded(value, unit); }).eval();
    const double area = std::accumulate(load.area.begin(), load.area.end(), 0.0);
    const std::string name = model.bodies[static_cast<std::size_t>(tissue.body)].name;
    text += fmt::format(
        "  {:<20} {:<23} {} faces, {:.4g} mm^2, in all ({:.4g} {:.4g} {:.4g}) N at a factor of 1\n",
        name, std::holds_alternative<double>(load.stress) ? "under pressure" : "under traction",
        load.faces.size(), 1e6 * area, force.x(), force.y(), force.z());
  }
  return text;
}

std::string sheets(const sim::Model& model) {
  std::string text;
  for (const sim::Tissue& tissue : model.tissues)
    for (const sim::SheetModel& sheet : tissue.sheets)
      text += fmt::format("  {:<20} sheet {:<17} {} faces, {:.4g} mm^2\n",
                          model.bodies[static_cast<std::size_t>(tissue.body)].name, sheet.name,
                          sheet.fibres.faces().cols(), 1e6 * sheet.fibres.area().sum());
  return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string scene_table(const sim::Scenario& scenario, const sim::Model& model,
                        const sim::Stepper& start) {
  std::string text = bodies(model);
  if (!scenario.attachments.empty()) text += "\n" + attachments(scenario, model);
  if (!model.supports.empty()) text += "\n" + supports(scenario, model);
  text += sheets(model);
  if (!model.surface_loads.empty()) text += "\n" + surface_loads(model, start.now());
  return text + line_table(model, start.now());
}

}  // namespace articular::tools
