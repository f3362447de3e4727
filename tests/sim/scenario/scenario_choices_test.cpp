// [choice] and `when`: which entries are there.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::scenario_choices_test {

class ScenarioChoices : public ScenarioTest {
 protected:
  std::vector<std::string> names(const std::vector<std::string>& overrides = {}) const {
    std::vector<std::string> result;
    for (const Body& body : read(kText, overrides).bodies)
      result.push_back(body.name + (body.kind == Body::Kind::Tissue ? " tissue" : ""));
    return result;
  }

  const std::string kText = R"(duration = "1 s"
[choice]
disc = "tissue"
side = "left"
[[body]]
name = "skull"
kind = "fixed"
[[body]]
name = "disc"
kind = "tissue"
mesh = { file = "disc.vtu" }
density = "1100 kg/m^3"
material = { law = "linear", young_modulus = "5 MPa", poisson_ratio = 0.4 }
when = { disc = ["tissue", "coarse"] }
[[body]]
name = "disc"
kind = "rigid"
mesh = { file = "disc.vtu" }
density = "1200 kg/m^3"
when = { disc = "rigid" }
[[body]]
name = "stand"
kind = "fixed"
when = { disc = "rigid", side = ["left", "right"] }
[[attach]]
body = "disc"
to = "skull"
region = {}
when = { disc = "tissue" }
[[load]]
kind = "gravity"
acceleration = "0 0 -1 m/s^2"
when = { side = "right" }
)";
};

TEST_F(ScenarioChoices, AnEntryIsThereWhereEachChoiceHasOneOfItsWords) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(), (Names{"skull", "disc tissue"}));
  EXPECT_EQ(names({"choice.disc=rigid"}), (Names{"skull", "disc", "stand"}));
  EXPECT_EQ(names({"choice.disc=coarse"}), (Names{"skull", "disc tissue"}));
  EXPECT_EQ(names({"choice.disc=off"}), Names{"skull"});  // which no `when` mentions
  EXPECT_EQ(names({"\"choice\".disc = rigid"}), (Names{"skull", "disc", "stand"}));
  EXPECT_EQ(names({"choice = { disc = \"rigid\", side = \"left\" }"}),
            (Names{"skull", "disc", "stand"}));
  EXPECT_EQ(read(kText).attachments.size(), 1U);
  EXPECT_TRUE(read(kText, {"choice.disc=coarse"}).attachments.empty());
  EXPECT_TRUE(read(kText).loads.empty());
  EXPECT_EQ(read(kText, {"choice.side=right"}).loads.size(), 1U);
}

// How near two names are takes time by the product of their lengths: hours, for these.
TEST_F(ScenarioChoices, NamesOfAMillionLettersAreRefusedAtOnce) {
  const std::string name(1 << 20, 'x');
  std::string text = kText;
  text.insert(text.find("disc = "), name + "y = \"a\"\n");
  const std::string message = refusal(text + "[[body]]\nwhen = { " + name + " = \"a\" }\n");
  EXPECT_NE(message.find("there is no choice"), std::string::npos) << message.substr(0, 200);
}

// A reference to it says so, and where it stands.
TEST_F(ScenarioChoices, WhoNamesWhatIsLeftOutIsToldWhere) {
  const std::string text = std::string(kText) + R"([[probe]]
name = "held"
kind = "reaction"
body = "stand"
[[ligament]]
name = "cord"
path = [{ body = "skull", point = "0 0 0 m" }, { body = "disc", point = "0 0 0.1 m" }]
stiffness = "1 N/mm"
mirror = "x"
when = { side = "right" }
[[probe]]
name = "pulled"
kind = "line"
line = "LINE"
)";
  const auto line_of = [&](const std::string& words) {
    return ":" +
           std::to_string(1 + std::count(text.begin(),
                                         text.begin() + static_cast<long>(text.find(words)), '\n'));
  };
  const std::string stand = refusal(text);
  EXPECT_NE(stand.find("no body is called `stand`; the one of "), std::string::npos) << stand;
  EXPECT_NE(stand.find(line_of("[[body]]\nname = \"stand\"") + " is left out by its `when`"),
            std::string::npos)
      << stand;
  for (const std::string line : {"cord", "cord_left"}) {
    std::string probed = text;
    probed.replace(probed.find("body = \"stand\""), 14, "body = \"skull\"");
    probed.replace(probed.find("LINE"), 4, line);
    const std::string cord = refusal(probed);
    EXPECT_NE(cord.find(line_of("[[ligament]]") + " is left out by its `when`"), std::string::npos)
        << cord;
  }
}

// What is left out is as if it were not written: to overrides, to checkpoints, to the record.
TEST_F(ScenarioChoices, NobodyElseSeesWhatIsLeftOut) {
  const Scenario rigid = read(kText, {"body.disc.density=1300 kg/m^3", " choice.disc = rigid"});
  EXPECT_EQ(rigid.bodies[1].kind, Body::Kind::Rigid);
  EXPECT_EQ(rigid.bodies[1].density, 1300);
  EXPECT_NE(refusal(kText, {"load.0.acceleration=0 0 0 m/s^2"}), "");
  EXPECT_NE(rigid.settings_json.find("\"disc\": \"rigid\""), std::string::npos)
      << rigid.settings_json;
  EXPECT_EQ(rigid.content.find("when"), std::string::npos);
  EXPECT_NE(read(kText).content, rigid.content);
}

}  // namespace articular::sim::scenario_choices_test
