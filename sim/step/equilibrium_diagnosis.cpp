#include "sim/step/equilibrium_diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sim/contact/contact_overview.hpp"
#include "sim/model/tissue.hpp"

namespace articular::sim {
namespace {

/// The last iterations tell what does not settle; the first ones what has to close.
constexpr std::size_t kLastIterations = 100;
/// What changes so often goes to and fro: it opens, closes and opens again.
constexpr int kFlips = 3;
/// A motion is nearly free if the largest force carries it farther than so many elements.
constexpr double kElements = 10;
/// Where there are none [m].
constexpr double kWithoutElements = 1e-3;
constexpr std::size_t kMostTold = 3;

const std::string& body_name(const Model& model, int body) {
  return model.bodies[static_cast<std::size_t>(body)].name;
}

/// How often a contact or ligament changed.
struct Tally {
  SupportChange::Kind kind = SupportChange::Kind::Contact;
  ContactId index = 0;
  int flips = 0;       // it opened or closed as a whole, went slack or taut
  int iterations = 0;  // in which at least a node of it did
};

/// By flips, then by iterations.
std::vector<Tally> tallies_of(std::span<const ConvergenceRow> rows) {
  std::map<std::pair<SupportChange::Kind, ContactId>, Tally> sums;
  for (const ConvergenceRow& row : rows)
    for (const SupportChange& change : row.newton.changes) {
      Tally& tally = sums[{change.kind, change.index}];
      tally.kind = change.kind;
      tally.index = change.index;
      tally.flips += change.flips() ? 1 : 0;
      ++tally.iterations;
    }
  std::vector<Tally> tallies;
  tallies.reserve(sums.size());
  for (const auto& [what, tally] : sums) tallies.push_back(tally);
  std::stable_sort(tallies.begin(), tallies.end(), [](const Tally& a, const Tally& b) {
    return std::pair(a.flips, a.iterations) > std::pair(b.flips, b.iterations);
  });
  return tallies;
}

std::string what_flips(const Model& model, std::span<const ConvergenceRow> rows) {
  std::string words;
  std::size_t told = 0;
  for (const Tally& tally : tallies_of(rows)) {
    if (told == kMostTold) break;
    const std::string name = name_of(model, tally.kind, tally.index);
    const bool is_ligament = tally.kind == SupportChange::Kind::Ligament;
    std::string what;
    if (tally.flips >= kFlips)
      what = fmt::format("{} {} {} times", name,
                         is_ligament ? "went slack or taut" : "opened or closed", tally.flips);
    else if (tally.iterations >= kFlips)
      what = fmt::format("nodes of the {} opened or closed in {}", name, tally.iterations);
    else
      continue;
    words += (words.empty() ? "" : "; ") + what;
    ++told;
  }
  if (words.empty()) words = "no contact and no ligament goes to and fro";
  return fmt::format("\n  in the last {} iterations: {}", rows.size(), words);
}

/// [N/mm]
std::string in_newtons_per_mm(double stiffness) {
  return fmt::format("{:.2g} N/mm", 1e-3 * stiffness);
}

std::string softest_motion(const Model& model, const SoftMotion& softest, double largest_force) {
  std::string bodies;
  for (std::size_t i = 0; i < std::min(kMostTold, softest.bodies.size()); ++i) {
    const BodyMotion& motion = softest.bodies[i];
    bodies += fmt::format("{}`{}` by {:.2g}, a {}", i > 0 ? "; " : "",
                          body_name(model, motion.body), motion.distance, motion.words);
  }
  const double way = largest_force / softest.stiffness;
  return fmt::format(
      "\n  softest motion: {}; {} resist it{}", bodies, in_newtons_per_mm(softest.stiffness),
      std::isfinite(way)
          ? fmt::format(", so that the largest force, {:.2g} N, would carry it {:.3g} mm",
                        largest_force, 1e3 * way)
          : std::string());
}

/// Tissue that is tied to a body, and beside that pressed onto it: what is tied can't give way.
std::string tied_and_pressed(const Model& model) {
  std::string words;
  std::size_t told = 0;
  for (const ContactOverview& pair : contact_overviews(model)) {
    if (pair.num_close_faces == 0 || told == kMostTold) continue;
    const ContactModel contact = model.contacts[pair.contact];
    const auto [tissue, other] = model.bodies[static_cast<std::size_t>(contact.a)].tissue >= 0
                                     ? std::pair(contact.a, contact.b)
                                     : std::pair(contact.b, contact.a);
    words += fmt::format(
        "\n  `{}` is tied to `{}` at {} nodes, and {} faces beside them lie within half an element "
        "of it and may press on it: tie those too, or let the two not touch "
        "(`articular check --contact`)",
        body_name(model, tissue), body_name(model, other), pair.num_tied_nodes,
        pair.num_close_faces);
    ++told;
  }
  return words;
}

/// Whether it is tissue with nodes that are attached or supported.
bool is_held_tissue(const Model& model, int body) {
  const int t = model.bodies[static_cast<std::size_t>(body)].tissue;
  if (t < 0) return false;
  return is_tied(model.tissues[static_cast<std::size_t>(t)]) ||
         std::ranges::any_of(model.supports,
                             [t](const SupportModel& support) { return support.tissue == t; });
}

}  // namespace

EquilibriumDiagnosis diagnose_equilibrium(const Moment& now,
                                          const std::optional<SoftMotion>& softest,
                                          std::span<const ConvergenceRow> tries) {
  EquilibriumDiagnosis diagnosis;
  const Model& model = now.model;
  diagnosis.cause = fmt::format(" in {} iterations", tries.size());
  if (softest && !softest->bodies.empty()) {
    const double element =
        std::isfinite(model.trusted_motion) ? model.trusted_motion : kWithoutElements;
    diagnosis.is_nearly_free = now.largest_force > softest->stiffness * kElements * element;
    const BodyMotion& most = softest->bodies.front();
    if (diagnosis.is_nearly_free)
      diagnosis.cause += fmt::format("; body `{}` is nearly free to {}, against only {}",
                                     body_name(model, most.body), most.words,
                                     in_newtons_per_mm(softest->stiffness));
    diagnosis.details += softest_motion(model, *softest, now.largest_force);
  }
  const std::size_t last = std::min(kLastIterations, tries.size());
  diagnosis.details += what_flips(model, tries.last(last));
  diagnosis.details += tied_and_pressed(model);
  if (diagnosis.is_nearly_free && is_held_tissue(model, softest->bodies.front().body))
    diagnosis.details += fmt::format(
        "\n  to look at: the loads and their units; `{}` is tied, and these may be more than it "
        "can carry",
        body_name(model, softest->bodies.front().body));
  diagnosis.details +=
      diagnosis.is_nearly_free
          ? "\n  to add: a ligament, an attachment or `hold` that resists this motion; where it is "
            "contact that should, bring the bodies together first"
          : "\n  to try: smaller load steps (`integrator.step`) or more iterations in each "
            "(`integrator.max_iterations`)";
  return diagnosis;
}

}  // namespace articular::sim
