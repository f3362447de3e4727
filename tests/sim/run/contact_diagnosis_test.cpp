// Which contact makes a step fail?
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/build/build_model.hpp"
#include "sim/run/contact_diagnosis.hpp"
#include "tests/sim/support/contact_scene.hpp"

namespace articular::sim::contact_diagnosis_test {

using Contacts = ContactTrial::Contacts;
using Outcome = ContactTrial::Outcome;

constexpr ContactId kSheetPlate = 0, kBlockPlate = 1, kBlockWall = 2;

/// A plate is driven through a sheet that nothing lets give way, and onto a block beside it, which
/// a wall stands next to.
Scenario plate_through_sheet(double way) {
  Scenario s = contact_scene(0.25);
  s.analysis = Scenario::Analysis::Static;
  s.output.interval = 0.25;
  s.duration = 1;
  s.bodies = {
      box_body("sheet", Body::Kind::Tissue, {0.01, 0.01, 0.002}, {0, 0, -0.001}, {3, 3, 1}),
      box_body("block", Body::Kind::Tissue, {0.01, 0.01, 0.02}, {0.011, 0, -0.0101}, {2, 2, 4}),
      box_body("plate", Body::Kind::Fixed, {0.03, 0.009, 0.002}, {0.005, 0, 0.0012}, {9, 3, 1}),
      box_body("wall", Body::Kind::Fixed, {0.002, 0.01, 0.02}, {0.0172, 0, -0.02}, {1, 2, 4}),
      stand("frame")};
  for (Body& body : s.bodies)
    if (body.material) body.material->element = TissueMaterial::Element::Plain;
  s.attachments = {attach("sheet", "frame", {-1, -1, -1}, {1, 1, 1}),
                   attach("block", "frame", {-1, -1, -1}, {1, 1, -0.02})};
  s.contacts = {{"sheet", "plate", {}}, {"block", "plate", {}}, {"block", "wall", {}}};
  s.loads = {shift("plate", 1, {0, 0, -way})};
  return s;
}

std::vector<ContactId> those(const ContactDiagnosis& found, Contacts which, Outcome outcome) {
  std::vector<ContactId> contacts;
  for (const ContactTrial& trial : found.trials)
    if (trial.contacts == which && trial.outcome == outcome) contacts.push_back(trial.contact);
  return contacts;
}

TEST(ContactDiagnosis, NamesTheOnePairOfThreeThatMakesAStepFail) {
  const Scenario scenario = plate_through_sheet(4e-3);
  const Model model = build_model(scenario);
  std::vector<std::string> progress;
  const ContactDiagnosis found = diagnose_contact(
      scenario, model,
      {.seconds = 60, .progress = [&](const std::string& what) { progress.push_back(what); }});
  EXPECT_NE(found.why.find("surfaces go through each other"), std::string::npos) << found.why;
  EXPECT_GT(found.reached, 0);
  EXPECT_LT(found.reached, 1);
  EXPECT_EQ(found.culprits, std::vector{kSheetPlate});
  ASSERT_EQ(found.trials.size(), 7U);
  EXPECT_EQ(progress.size(), 8U);
  EXPECT_EQ(those(found, Contacts::None, Outcome::Taken).size(), 1U);
  EXPECT_EQ(those(found, Contacts::Alone, Outcome::Failed), std::vector{kSheetPlate});
  EXPECT_EQ(those(found, Contacts::Alone, Outcome::Taken), (std::vector{kBlockPlate, kBlockWall}));
  EXPECT_EQ(those(found, Contacts::AllBut, Outcome::Taken), std::vector{kSheetPlate});
  EXPECT_EQ(those(found, Contacts::AllBut, Outcome::Failed),
            (std::vector{kBlockPlate, kBlockWall}));
}

TEST(ContactDiagnosis, ARunThatDoesNotFailHasNothingToTry) {
  const Scenario scenario = plate_through_sheet(3e-4);
  const ContactDiagnosis found = diagnose_contact(scenario, build_model(scenario), {});
  EXPECT_TRUE(found.ended);
  EXPECT_EQ(found.why, "");
  EXPECT_TRUE(found.trials.empty());
  EXPECT_EQ(found.reached, scenario.duration);
}

TEST(ContactDiagnosis, EndsWhenItsTimeIsOver) {
  const Scenario scenario = plate_through_sheet(4e-3);
  const ContactDiagnosis found =
      diagnose_contact(scenario, build_model(scenario), {.seconds = 1e-9});
  EXPECT_FALSE(found.ended);
  EXPECT_EQ(found.why, "");
  EXPECT_LT(found.reached, 1);
}

}  // namespace articular::sim::contact_diagnosis_test
