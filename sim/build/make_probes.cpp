#include "sim/build/make_probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include "sim/build/region.hpp"
#include "sim/build/weighted_points.hpp"
#include "sim/mesh/extent.hpp"
#include "sim/model/tied_bodies.hpp"

namespace articular::sim {
namespace {

/// Looks up what one probe observes.
struct Resolver {
  const Scenario& scenario;
  const Model& model;
  const std::vector<BodyGeometry>& geometry;
  const std::vector<collision::Surface>& surfaces;
  std::vector<std::string>& warnings;
  const Probe& probe;  // for messages

  const BodyModel& body(const std::string& name) const {
    return model.bodies[static_cast<std::size_t>(body_index(scenario, name))];
  }

  /// -1 where it names none: the world.
  int frame_called(const std::string& name) const { return name.empty() ? -1 : body(name).rigid; }

  PointInFrame place(const Anchor& anchor, const std::string& frame) const {
    return {anchored_point(anchor, body_index(scenario, anchor.body), model, surfaces, warnings),
            frame_called(frame)};
  }

  Observed operator()(const PointProbe& point) const {
    return ObservedPoint{place(point.anchor, point.frame)};
  }

  Observed operator()(const WayProbe& way) const {
    int before = 0;
    for (const Probe& other : scenario.probes) {
      if (&other == &probe) break;
      before += std::holds_alternative<WayProbe>(other.what) ? 1 : 0;
    }
    return ObservedWay{place(way.anchor, way.frame), before};
  }

  Observed operator()(const HelicalAxisProbe& axis) const {
    return ObservedHelicalAxis{body(axis.body).rigid, frame_called(axis.frame), axis.point};
  }

  Observed operator()(const AngleProbe& angle) const {
    return ObservedAngle{body(angle.body).rigid, angle.axis};
  }

  Observed operator()(const ContactsProbe& contacts) const {
    ObservedContacts observed;
    observed.sensor = contacts.sensor;
    for (const int p : probes_called(contacts.of)) {
      const Probe& part = scenario.probes[static_cast<std::size_t>(p)];
      const Resolver resolver{scenario, model, geometry, surfaces, warnings, part};
      observed.of.push_back(std::get<ObservedContact>(resolver(std::get<ContactProbe>(part.what))));
    }
    for (std::size_t k = 0; k < observed.of.size(); ++k)
      for (std::size_t j = 0; j < k; ++j)
        check_parts(contacts.of[j], observed.of[j], contacts.of[k], observed.of[k]);
    check_spot(observed.sensor.spot, observed.of);
    return observed;
  }

  /// A sum counts what passes between two bodies once, and as it acts on the same of them.
  void check_parts(const std::string& name, const ObservedContact& part, const std::string& other,
                   const ObservedContact& more) const {
    if (part.contact != more.contact) return;
    const auto refuse = [&](const char* what, const char* expected) {
      const ContactModel& pair = model.contacts[part.contact];
      const auto body_name = [&](int b) -> const std::string& {
        return model.bodies[static_cast<std::size_t>(b)].name;
      };
      throw InputError(
          probe.where,
          fmt::format("probe `{}`: `{}` and `{}` are both of `{}` and `{}`, {}; expected {}",
                      probe.name, name, other, body_name(pair.a), body_name(pair.b), what,
                      expected));
    };
    if (part.body != more.body)
      refuse("in opposite orders, so that their forces cancel",
             "`bodies` in the same order, and a `region` each");
    const BodyModel& body = model.bodies[static_cast<std::size_t>(part.body)];
    for (std::size_t f = 0; f < body.collider->face_area.size(); ++f)
      if (is_counted(part, f) && is_counted(more, f))
        refuse("and what passes through the same face counts twice",
               "one of them, or a `region` each that has no face of the other's");
  }

  static bool is_counted(const ObservedContact& part, std::size_t face) {
    return part.faces.empty() || part.faces[face] != 0;
  }

  Observed operator()(const ContactProbe& contact) const {
    const int first = body_index(scenario, contact.first),
              second = body_index(scenario, contact.second);
    ObservedContact observed;
    observed.body = first;
    observed.sensor = contact.sensor;
    const std::optional<ContactId> pair = model.contacts.between(first, second);
    if (!pair && first == second)
      throw InputError(probe.where,
                       fmt::format("probe `{}` observes contact of `{}` with itself, but it does "
                                   "not touch itself in this scene; expected two bodies, or a "
                                   "[[contact]] with self = \"{}\"",
                                   probe.name, contact.first, contact.first));
    if (!pair)
      throw InputError(probe.where,
                       fmt::format("probe `{}` observes contact of `{}` and `{}`, which do not "
                                   "touch in this scene: {}",
                                   probe.name, contact.first, contact.second,
                                   scenario.contact ? "[[contact]] names other pairs, or neither "
                                                      "of them moves"
                                                    : "contact = false"));
    observed.contact = *pair;
    if (contact.region) observed.faces = faces_in(*contact.region, contact.first);
    check_spot(observed.sensor.spot, {&observed, 1});
    return observed;
  }

  /// Side of a mean face, of that body of the two where it is smaller [m].
  double finest_face(const ContactModel& contact) const {
    const auto side = [&](int b) {
      const std::vector<double>& area =
          model.bodies[static_cast<std::size_t>(b)].collider->face_area;
      return std::sqrt(2 * std::reduce(area.begin(), area.end()) /
                       static_cast<double>(area.size()));
    };
    return std::min(side(contact.a), side(contact.b));
  }

  /// Of that body of the two where it is shorter [m].
  double shorter_extent(const ContactModel& contact) const {
    const auto length = [&](int b) {
      return extent(start_positions(model, model.bodies[static_cast<std::size_t>(b)]));
    };
    return std::min(length(contact.a), length(contact.b));
  }

  /// Faces resolve nothing finer than themselves, and smaller spots are very many to try. Over one
  /// far wider than the bodies hardly any pressure is left.
  void check_spot(double spot, std::span<const ObservedContact> contacts) const {
    constexpr double kOfFace = 0.25, kOfBody = 2;
    if (!(spot > 0)) return;
    double face = std::numeric_limits<double>::infinity(), body = 0;
    for (const ObservedContact& observed : contacts) {
      face = std::min(face, finest_face(model.contacts[observed.contact]));
      body = std::max(body, shorter_extent(model.contacts[observed.contact]));
    }
    const auto refuse = [&](const char* what, const char* expected, double length) {
      throw InputError(
          probe.where,
          fmt::format("spot of probe `{}` is {:.3g} mm wide, {}; expected {} {:.3g} mm", probe.name,
                      1e3 * spot, what, expected, 1e3 * length));
    };
    if (spot < kOfFace * face)
      refuse("less than a quarter of a face of the surfaces that touch", "at least",
             kOfFace * face);
    if (spot > kOfBody * body)
      refuse("more than twice the length of what touches", "at most", kOfBody * body);
  }

  int line_called(const std::string& name) const {
    const auto line = std::find_if(model.lines.begin(), model.lines.end(),
                                   [&](const Line& l) { return l.name == name; });
    return static_cast<int>(line - model.lines.begin());
  }

  Observed operator()(const LineProbe& named) const {
    for (std::size_t t = 0; t < model.tissues.size(); ++t)
      if (const int m = model.tissues[t].muscle;
          m >= 0 && model.muscles[static_cast<std::size_t>(m)].given.name == named.line)
        return ObservedFibres{static_cast<int>(t), m};
    const int index = line_called(named.line);
    const Line& line = model.lines[static_cast<std::size_t>(index)];
    if (line.muscle >= 0) return ObservedMuscle{index, line.muscle};
    if (line.bolus >= 0) return ObservedBolus{index, line.bolus};
    return ObservedLigament{index, line.ligament};
  }

  BodyAxis axis_of(const std::string& name, const Vec3& point, const Vec3& direction) const {
    const int rigid = body(name).rigid;
    const Pose& rest = model.rigid_bodies[static_cast<std::size_t>(rigid)].rest;
    return {rigid, point - rest.p, direction};
  }

  Observed operator()(const MomentArmProbe& arm) const {
    const int line = line_called(arm.line);
    if (!pulls_on(model, model.lines[static_cast<std::size_t>(line)], body(arm.body).rigid))
      throw InputError(
          probe.where,
          fmt::format(
              "[[probe]] `{}`: `{}` neither has a point on `{}` "
              "nor wraps around it: its arm about it is 0; expected a body that it pulls on",
              probe.name, arm.line, arm.body));
    return ObservedMomentArm{line, axis_of(arm.body, arm.point, arm.axis)};
  }

  Observed operator()(const MuscleMomentProbe& net) const {
    ObservedMuscleMoment observed{{}, axis_of(net.body, net.point, net.axis)};
    for (const std::string& muscle : net.muscles) observed.lines.push_back(line_called(muscle));
    return observed;
  }

  Observed operator()(const WrapProbe& wrap) const { return ObservedWrap{line_called(wrap.line)}; }

  Observed operator()(const EnergyProbe&) const { return ObservedEnergy{}; }

  Observed operator()(const ReactionProbe& reaction) const {
    return ObservedReaction{body(reaction.body).rigid};
  }

  Observed operator()(const SupportProbe& named) const {
    const auto support =
        std::find_if(model.supports.begin(), model.supports.end(),
                     [&](const SupportModel& s) { return s.name == named.support; });
    return ObservedSupport{static_cast<int>(support - model.supports.begin())};
  }

  Observed operator()(const AttachmentProbe& attachment) const {
    const int tissue = body(attachment.tissue).tissue, rigid = body(attachment.rigid).rigid;
    if (!is_tied_to(model.tissues[static_cast<std::size_t>(tissue)], rigid))
      throw InputError(probe.where,
                       fmt::format("[[probe]] `{}`: no node of `{}` is attached to `{}`",
                                   probe.name, attachment.tissue, attachment.rigid));
    return ObservedAttachment{tissue, rigid};
  }

  Observed operator()(const FibresProbe& fibres) const {
    return ObservedStretch{body(fibres.tissue).tissue};
  }

  Observed operator()(const VolumeProbe& volume) const {
    return ObservedVolume{body(volume.tissue).tissue};
  }

  Observed operator()(const SheetProbe& probed) const {
    for (std::size_t t = 0; t < model.tissues.size(); ++t) {
      const std::vector<SheetModel>& sheets = model.tissues[t].sheets;
      const auto sheet = std::ranges::find(sheets, probed.sheet, &SheetModel::name);
      if (sheet != sheets.end())
        return ObservedSheet{static_cast<int>(t), static_cast<int>(sheet - sheets.begin())};
    }
    throw InputError(probe.where,
                     fmt::format("[[probe]] `{}`: no sheet `{}`", probe.name, probed.sheet));
  }

  Observed operator()(const StressProbe& stress) const {
    const int tissue = body(stress.tissue).tissue;
    return ObservedStress{tissue, elements_in(stress.region, stress.tissue,
                                              model.tissues[static_cast<std::size_t>(tissue)])};
  }

  Observed operator()(const ExtentProbe& extent) const {
    return ObservedExtent{body(extent.tissue).tissue,
                          axis_of(extent.frame, extent.point, extent.direction)};
  }

  Observed operator()(const ShareProbe& share) const {
    return ObservedShare{probes_called(share.part), probes_called(share.whole), share.direction};
  }

  Observed operator()(const JointProbe& joint) const {
    const int proximal = body(joint.proximal.body).rigid, distal = body(joint.distal.body).rigid;
    const auto rest_of = [&](int rigid) {
      return model.rigid_bodies[static_cast<std::size_t>(rigid)].rest;
    };
    return ObservedJoint{
        proximal_frame(joint.proximal, joint.is_right, proximal, rest_of(proximal), probe.where),
        distal_frame(joint.distal, joint.is_right, distal, rest_of(distal), probe.where),
        joint.is_right};
  }

  /// By face of the collider: its middle, at the start, lies in the region.
  std::vector<char> faces_in(const Region& region, const std::string& name) const {
    const Collider& collider = *body(name).collider;
    if (region.set && body(name).tissue < 0)  // bones touch with a mesh that is made of theirs
      throw InputError(region.where,
                       fmt::format("[[probe]] `{}`: `{}` is a bone, whose contact has no sets; "
                                   "expected a box or a sphere",
                                   probe.name, name));
    const RegionTest test(region, body_index(scenario, name), model, geometry);
    std::vector<char> inside;
    for (const auto& face : collider.surface.faces.colwise())
      inside.push_back(test.contains_face(face, collider.X(Eigen::all, face).rowwise().mean()) ? 1
                                                                                               : 0);
    if (std::find(inside.begin(), inside.end(), 1) == inside.end())
      throw InputError(region.where,
                       fmt::format("[[probe]] `{}`: no face of `{}` has its middle in the region",
                                   probe.name, name));
    return inside;
  }

  /// Their middle, at the start, lies in the region; all without one.
  std::vector<int> elements_in(const std::optional<Region>& region, const std::string& name,
                               const Tissue& tissue) const {
    const auto& tets = tissue.elements.tets();
    std::optional<RegionTest> test;
    if (region) test.emplace(*region, body_index(scenario, name), model, geometry);
    std::vector<int> inside;
    for (int e = 0; e < static_cast<int>(tets.cols()); ++e)
      if (!test ||
          test->contains_element(tets.col(e), tissue.X(Eigen::all, tets.col(e)).rowwise().mean()))
        inside.push_back(e);
    if (inside.empty())
      throw InputError(
          region->where,
          fmt::format("[[probe]] `{}`: no element of `{}` has its middle in the region", probe.name,
                      name));
    return inside;
  }

  std::vector<int> probes_called(const std::vector<std::string>& names) const {
    std::vector<int> found;
    for (const std::string& name : names)
      for (std::size_t p = 0; p < scenario.probes.size(); ++p)
        if (scenario.probes[p].name == name) found.push_back(static_cast<int>(p));
    return found;
  }
};

}  // namespace

std::vector<ProbeModel> make_probes(const Scenario& scenario, const Model& model,
                                    const std::vector<BodyGeometry>& geometry,
                                    const std::vector<collision::Surface>& surfaces,
                                    std::vector<std::string>& warnings) {
  std::vector<ProbeModel> probes;
  for (const Probe& probe : scenario.probes)
    probes.push_back(
        {probe.name,
         std::visit(Resolver{scenario, model, geometry, surfaces, warnings, probe}, probe.what)});
  return probes;
}

}  // namespace articular::sim
