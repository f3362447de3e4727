#include "sim/build/twin_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/base/error.hpp"
#include "sim/base/place_text.hpp"

namespace articular::sim {
namespace {

bool are_equal(const Curve& a, const Curve& b) { return a.time == b.time && a.value == b.value; }

bool are_twins(const GravityLoad& a, const GravityLoad& b) {
  return a.acceleration == b.acceleration && are_equal(a.profile, b.profile);
}

bool are_equal(const NodeRef& a, const NodeRef& b) {
  return a.block == b.block && a.rigid == b.rigid && a.local == b.local;
}

bool are_twins(const SurfaceLoadModel& a, const SurfaceLoadModel& b) {
  const auto same_face = [](const auto& f, const auto& g) {
    return std::ranges::equal(f, g,
                              [](const NodeRef& m, const NodeRef& n) { return are_equal(m, n); });
  };
  return a.tissue == b.tissue && a.stress == b.stress && are_equal(a.profile, b.profile) &&
         std::ranges::equal(a.faces, b.faces, same_face);
}

/// Two bundles of one ligament may share one end, hardly both. A line pulls alike from either.
bool have_one_path(const std::vector<Anchor>& a, const std::vector<Anchor>& b) {
  const auto same = [](const Anchor& p, const Anchor& q) {
    return p.body == q.body && p.point == q.point && p.radius == q.radius;
  };
  return std::ranges::equal(a, b, same) ||
         std::equal(a.begin(), a.end(), b.rbegin(), b.rend(), same);
}

bool are_twins(const Ligament& a, const Ligament& b) {
  return have_one_path(a.path, b.path) && a.law == b.law && a.stiffness == b.stiffness &&
         a.slack_length == b.slack_length && a.slack_extension == b.slack_extension &&
         a.reference_strain == b.reference_strain;
}

bool are_twins(const Muscle& a, const Muscle& b) {
  return a.tissue.empty() && b.tissue.empty() && have_one_path(a.path, b.path) &&
         a.max_force == b.max_force;
}

/// On the same faces their fibres tell the same stretches of a tissue that is drawn out askew.
bool are_twins(const fem::FibreSheet& a, const fem::FibreSheet& b, const Positions& X) {
  constexpr double kSameStretch = 1e-6;
  if (a.faces().cols() != b.faces().cols() || a.faces() != b.faces()) return false;
  Mat3 askew = Mat3::Identity();
  askew.row(0) << 1.1, 0.2, 0.3;
  askew.row(1) << 0, 1.2, 0.4;
  askew(2, 2) = 1.3;
  const Positions x = askew * X;
  return (a.stretch(x) - b.stretch(x)).cwiseAbs().maxCoeff() < kSameStretch;
}

class TwinDoubts {
 public:
  /// Looks for an equal one before each.
  template <class Entries, class Same, class Words>
  void look_at(const Entries& entries, const Same& same, const Words& words) {
    for (std::size_t k = 1; k < entries.size(); ++k)
      for (std::size_t i = 0; i < k; ++i)
        if (same(entries[i], entries[k])) {
          lines_.push_back(words(entries[i], entries[k]));
          break;
        }
  }
  std::vector<std::string> lines() && { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

template <class Kind>
std::vector<const Kind*> loads_of(const Scenario& scenario) {
  std::vector<const Kind*> loads;
  for (const Load& load : scenario.loads)
    if (const auto* const found = std::get_if<Kind>(&load)) loads.push_back(found);
  return loads;
}

void look_at_loads(const Scenario& scenario, const Model& model, TwinDoubts& doubts) {
  doubts.look_at(
      loads_of<GravityLoad>(scenario), [](auto* a, auto* b) { return are_twins(*a, *b); },
      [](auto* a, auto* b) {
        return prefix(b->where) + fmt::format("the same gravity is there already, at {}: both act",
                                              place_text(a->where));
      });
  struct SurfaceTwin {
    const SurfaceLoad* given;
    const SurfaceLoadModel* made;
  };
  std::vector<SurfaceTwin> surfaces;
  for (const SurfaceLoad* load : loads_of<SurfaceLoad>(scenario))
    surfaces.push_back({load, &model.surface_loads[surfaces.size()]});
  doubts.look_at(
      surfaces,
      [](const SurfaceTwin& a, const SurfaceTwin& b) { return are_twins(*a.made, *b.made); },
      [](const SurfaceTwin& a, const SurfaceTwin& b) {
        return prefix(b.given->where) + fmt::format(
                                            "the same load on the same faces of `{}` is "
                                            "there already, at {}: both act",
                                            b.given->at.tissue, place_text(a.given->where));
      });
}

template <class Lines>
void look_at_lines(const Lines& lines, const char* kind, TwinDoubts& doubts) {
  doubts.look_at(
      lines, [](const auto& a, const auto& b) { return are_twins(a, b); },
      [kind](const auto& a, const auto& b) {
        return prefix(b.where) + fmt::format("{} `{}` is the same as `{}`, at {}: both pull", kind,
                                             b.name, a.name, place_text(a.where));
      });
}

void look_at_sheets(const Scenario& scenario, const Model& model, TwinDoubts& doubts) {
  const auto given = [&](const SheetModel& sheet) -> const Sheet& {
    return *std::ranges::find(scenario.sheets, sheet.name, &Sheet::name);
  };
  for (const Tissue& tissue : model.tissues)
    doubts.look_at(
        tissue.sheets,
        [&](const SheetModel& a, const SheetModel& b) {
          return are_twins(a.fibres, b.fibres, tissue.X);
        },
        [&](const SheetModel& a, const SheetModel& b) {
          return prefix(given(b).where) +
                 fmt::format(
                     "sheet `{}` lies on the same faces as `{}`, at {}, with the same "
                     "fibres: both pull",
                     b.name, a.name, place_text(given(a).where));
        });
}

}  // namespace

std::vector<std::string> twin_doubts(const Scenario& scenario, const Model& model) {
  TwinDoubts doubts;
  look_at_loads(scenario, model, doubts);
  look_at_lines(scenario.ligaments, "ligament", doubts);
  look_at_lines(scenario.muscles, "muscle", doubts);
  look_at_sheets(scenario, model, doubts);
  return std::move(doubts).lines();
}

}  // namespace articular::sim
