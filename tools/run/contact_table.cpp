#include "tools/run/contact_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/base/place_text.hpp"
#include "sim/contact/contact_overview.hpp"

namespace articular::tools {
namespace {

/// Of lengths of edges: the finer side then has nothing to lie on between the coarser one's nodes.
constexpr double kMuchCoarser = 3;

const std::string& name(const sim::Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)].name;
}

/// In steps of elements at the surface.
std::string how_near(const sim::Model& model, const sim::ContactOverview& overview) {
  const sim::ContactModel contact = model.contacts[overview.contact];
  if (!overview.can_move) return "never: neither moves";
  if (contact.a == contact.b) return "itself";
  if (!std::isfinite(overview.distance)) return "never: all is tied";
  const auto size = [&](int body) {
    return model.bodies[static_cast<std::size_t>(body)].collider->size;
  };
  const double element = std::min(size(contact.a), size(contact.b));
  const char* const words = overview.distance < 0.01 * element ? "touching"
                            : overview.distance < element      ? "near"
                                                               : "apart";
  return fmt::format("{}, {:.3g} mm", words, 1e3 * overview.distance);
}

std::string pair_row(const sim::Model& model, const sim::ContactOverview& overview) {
  const sim::ContactModel contact = model.contacts[overview.contact];
  return fmt::format("  {:<20} {:<20} {:<20} {:>11.4g} {:<9} {}\n", name(model, contact.a),
                     name(model, contact.b), name(model, contact.reversed ? contact.b : contact.a),
                     1e-9 * contact.mean_stiffness, contact.averaged ? "averaged" : "pointwise",
                     how_near(model, overview));
}

std::string tied_row(const sim::Model& model, const sim::ContactOverview& overview) {
  const sim::ContactModel contact = model.contacts[overview.contact];
  const bool a_is_tissue = model.bodies[static_cast<std::size_t>(contact.a)].tissue >= 0;
  return fmt::format(
      "  {:<20} to {:<20} {} nodes in {} faces, which don't touch it; {} faces may, {} of them lie "
      "within half an element of it\n",
      name(model, a_is_tissue ? contact.a : contact.b),
      name(model, a_is_tissue ? contact.b : contact.a), overview.num_tied_nodes,
      overview.num_tied_faces, overview.num_free_faces, overview.num_close_faces);
}

std::string surface_row(const sim::Model& model, const sim::SurfaceOverview& surface) {
  std::string flat = "-";
  if (surface.num_flat > 0) {
    flat =
        fmt::format("{}, the flattest at {}", surface.num_flat, sim::place_text(surface.flattest));
  }
  return fmt::format("  {:<20} {:>7} {:>9.3g} {:>9.3g}   {}\n", name(model, surface.body),
                     surface.num_faces, 1e3 * surface.edge, 1e3 * surface.height, flat);
}

std::string coarse_rows(const sim::Model& model, const std::vector<sim::ContactOverview>& pairs,
                        const std::vector<sim::SurfaceOverview>& surfaces) {
  const auto edge = [&](int body) {  // they come in the order of the bodies
    return std::lower_bound(surfaces.begin(), surfaces.end(), body,
                            [](const sim::SurfaceOverview& s, int b) { return s.body < b; })
        ->edge;
  };
  std::string text;
  for (const sim::ContactOverview& pair : pairs) {
    const sim::ContactModel contact = model.contacts[pair.contact];
    const double ratio = edge(contact.a) / edge(contact.b);
    if (std::max(ratio, 1 / ratio) < kMuchCoarser) continue;
    const bool a_is_coarse = ratio > 1;
    text +=
        fmt::format("  {} is {:.1f} times as coarse as {}, which it may touch\n",
                    name(model, a_is_coarse ? contact.a : contact.b), std::max(ratio, 1 / ratio),
                    name(model, a_is_coarse ? contact.b : contact.a));
  }
  return text;
}

}  // namespace

std::string contact_table(const sim::Model& model) {
  if (model.contacts.empty()) return "  no two bodies may touch\n";
  const std::vector<sim::ContactOverview> pairs = sim::contact_overviews(model);
  const std::vector<sim::SurfaceOverview> surfaces = sim::surface_overviews(model);
  std::string text = fmt::format("  {:<20} {:<20} {:<20} {:>11} {:<9} {}\n", "may touch", "",
                                 "non-mortar side", "N/mm^3", "depths", "at the start");
  for (const sim::ContactOverview& pair : pairs) text += pair_row(model, pair);
  if (const auto more = model.contacts.size() - std::ssize(pairs); more > 0)
    text += fmt::format("  and {} pairs that are farther from each other than an element\n", more);
  std::string tied;
  for (const sim::ContactOverview& pair : pairs)
    if (pair.num_tied_nodes > 0) tied += tied_row(model, pair);
  if (!tied.empty()) text += "\n  tied, and may touch\n" + tied;
  text += fmt::format("\n  {:<20} {:>7} {:>9} {:>9}   {}\n", "surface", "faces", "edge mm",
                      "height mm", "flat elements (height below 1/5 of an edge)");
  for (const sim::SurfaceOverview& surface : surfaces) text += surface_row(model, surface);
  return text + coarse_rows(model, pairs, surfaces);
}

}  // namespace articular::tools
