// The jaw whose closing muscles are tissue, in scenarios/mandible/.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/contact/contact_summary.hpp"
#include "sim/step/stepper.hpp"
#include "tests/scenarios/scenario_results.hpp"

namespace articular::muscles_test {

using sim::Vec3;

Vec3 vector(const ScenarioResults& results, const std::string& name, const std::string& unit) {
  const auto last = [&](const char* axis) {
    return results.last(name + "." + axis + " [" + unit + "]");
  };
  return {last("x"), last("y"), last("z")};
}

struct OneMuscle {
  std::string name;
  double least_pull, most_pull;  // of that of the lines
};
class MuscleOfTissue : public testing::TestWithParam<OneMuscle> {};
INSTANTIATE_TEST_SUITE_P(Jaw, MuscleOfTissue,
                         testing::Values(OneMuscle{"masseter", 0.95, 1.1},
                                         OneMuscle{"medial_pterygoid", 0.75, 0.9},
                                         OneMuscle{"lateral_pterygoid", 0.9, 1}),
                         [](const auto& muscle) { return muscle.param.name; });

// It pulls both bones together about as the lines do. It bulges and straightens, so its fibres are
// shorter in the middle: the more so where it is bent, and where a longer tendon makes fibres
// short.
TEST_P(MuscleOfTissue, PullsBothBonesTogetherAlongTheLines) {
  const auto run = [](const std::string& model) {
    return run_scenario(
        "mandible/one-muscle.toml",
        {"integrator.step=0.5 s", "choice.muscle=" + GetParam().name, "choice.model=" + model});
  };
  const ScenarioResults tissue = run("tissue"), lines = run("lines");
  const Vec3 on_skull = vector(tissue, "skull.force", "N"),
             on_mandible = vector(tissue, "mandible.force", "N"),
             of_lines = vector(lines, "mandible.force", "N");
  EXPECT_LT((on_skull + on_mandible).norm(), 1e-4 * on_skull.norm());  // the balance of statics
  EXPECT_GT(on_mandible.norm(), GetParam().least_pull * of_lines.norm());
  EXPECT_LT(on_mandible.norm(), GetParam().most_pull * of_lines.norm());
  EXPECT_GT(on_mandible.normalized().dot(of_lines.normalized()), std::cos(0.2));  // 11 degrees
}

double volume(const Tetrahedra& tets, const Positions& x) {  // [m³]
  double sum = 0;
  for (const auto& tet : tets.colwise()) {
    const Vec3 x0 = x.col(tet(0)), a = x.col(tet(1)) - x0, b = x.col(tet(2)) - x0,
               c = x.col(tet(3)) - x0;
    sum += a.cross(b).dot(c) / 6;
  }
  return sum;
}

std::string name_of(const sim::Model& model, std::size_t tissue) {
  return model.bodies[static_cast<std::size_t>(model.tissues[tissue].body)].name;
}
std::size_t tissue_named(const sim::Model& model, const std::string& name) {
  std::size_t tissue = 0;
  while (name_of(model, tissue) != name) ++tissue;
  return tissue;
}

/// The deepest that muscles get into others and into themselves, mean around a node, by the height
/// of their elements.
struct Depths {
  double in_others = 0, in_themselves = 0;
};
Depths deepest_of_muscles(const sim::Model& model, const sim::Moment& now) {
  Depths deepest;
  for (const sim::ContactSummary& contact :
       sim::contact_summaries(model, now.contact, now.configuration)) {
    const sim::ContactModel pair = model.contacts[contact.contact];
    for (const int body : {pair.a, pair.b}) {
      const sim::BodyModel& side = model.bodies[static_cast<std::size_t>(body)];
      double& depth = pair.a == pair.b ? deepest.in_themselves : deepest.in_others;
      if (side.tissue >= 0) depth = std::max(depth, contact.max_depth / side.collider->size);
    }
  }
  return deepest;
}

struct Clench {
  std::string name;
  std::vector<std::string> choices;
  std::size_t num_tissues;
  double duration = 0.036;  // [s], until it presses bone or its other part
};
class JawWithMuscles : public testing::TestWithParam<Clench> {};
INSTANTIATE_TEST_SUITE_P(Clench, JawWithMuscles,
                         testing::Values(Clench{"MasseterAndTemporalis", {}, 6},
                                         Clench{"MedialPterygoid",
                                                {"choice.masseter=lines", "choice.temporalis=lines",
                                                 "choice.medial_pterygoid=tissue"},
                                                2,
                                                0.06},
                                         Clench{"LateralPterygoid",
                                                {"choice.masseter=lines", "choice.temporalis=lines",
                                                 "choice.lateral_pterygoid=tissue",
                                                 "curve.protruders.time=['0 s', '0.02 s']",
                                                 "curve.protruders.value=[0, 0.3]"},
                                                2}),
                         [](const auto& clench) { return clench.param.name; });

// Left and right clench alike, teeth on teeth. They keep their volume, and fibres stay at lengths
// that they have in people. Nothing is in another by a hundredth of an element.
TEST_P(JawWithMuscles, MusclesClenchAsTissueDoesAndAreMirrorImages) {
  std::vector<std::string> settings = {"duration=" + std::to_string(GetParam().duration) + " s",
                                       "curve.closers.time=['0 s', '0.02 s']",
                                       "curve.closers.value=[0, 0.3]"};
  settings.insert(settings.end(), GetParam().choices.begin(), GetParam().choices.end());
  const sim::Scenario scenario = shipped_scenario("mandible/muscles.toml", settings);
  const sim::Model model = sim::build_model(scenario);
  sim::Stepper stepper(model, sim::step_settings(scenario));
  sim::State state = stepper.initial();
  while (state.t < GetParam().duration - 1e-4) stepper.step(state, state.t + 3e-3);
  ASSERT_EQ(model.tissues.size(), GetParam().num_tissues);
  for (std::size_t t = 0; t < model.tissues.size(); ++t) {
    SCOPED_TRACE(name_of(model, t));
    const sim::Tissue& tissue = model.tissues[t];
    const Positions& x = stepper.now().tissues[t].x;
    EXPECT_NEAR(volume(tissue.elements.tets(), x) / volume(tissue.elements.tets(), tissue.X), 1,
                0.01);
    EXPECT_GT(tissue.elements.volume_ratio(x).minCoeff(), 1.0 / 3);
    const Eigen::VectorXd stretch = tissue.elements.fibre_stretch(x);
    EXPECT_LT(stretch.mean(), 0.99);  // it has contracted
    EXPECT_GT(stretch.minCoeff(), 0.5);
    EXPECT_LT(stretch.maxCoeff(), 1.6);
  }
  const Depths deepest = deepest_of_muscles(model, stepper.now());
  EXPECT_GT(deepest.in_others, 0);  // they press
  EXPECT_LT(deepest.in_others, 0.01);
  EXPECT_LT(deepest.in_themselves, 0.03);  // a crease of 0.3 mm² at the edge of the deep masseter
  std::size_t pairs = 0;
  for (std::size_t left = 0; left < model.tissues.size(); ++left) {
    const std::string name = name_of(model, left);
    if (!name.ends_with("_left")) continue;
    ++pairs;
    SCOPED_TRACE(name);
    const Positions
        a = stepper.now().tissues[left].x,
        b = stepper.now().tissues[tissue_named(model, name.substr(0, name.size() - 4) + "right")].x;
    EXPECT_LT((a.row(0) + b.row(0)).cwiseAbs().maxCoeff(), 0.02e-3);  // [m]
    EXPECT_LT((a.bottomRows(2) - b.bottomRows(2)).cwiseAbs().maxCoeff(), 0.02e-3);
  }
  EXPECT_EQ(2 * pairs, model.tissues.size());
}

}  // namespace articular::muscles_test
