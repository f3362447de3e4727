#include "sim/scenario/toml_override.hpp"

#include <gtest/gtest.h>

#include "fem/material/point_law.hpp"

#include "tests/sim/support/readable_line.hpp"
#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::toml_override_test {

class Overrides : public ScenarioTest {
 protected:
  const std::string scenario_ =
      kStart + "[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 -9.81 m/s^2\"\n" +
      "[[muscle]]\nname = \"m\"\n" +
      "path = [{ body = \"skull\", point = \"0 0 0 m\" }, { body = \"mandible\", point = \"0 0 1 "
      "m\" }]\n"
      "max_force = \"1 N\"\nexcitation = { time = [\"0 s\"], value = [0.5] }\n";
};

TEST_F(Overrides, ReplaceValuesByNameAndNumber) {
  const Scenario scenario =
      read(scenario_, {"duration=0.1 s", "body.disc_left.material.poisson_ratio=0.3",
                       "load.0.acceleration=0 0 -1 m/s^2", "muscle.m.excitation.value.0=0.75",
                       "muscle.m.path.1.point=0 0 2 m", "title = \"A b\"", "body.0.name=cranium",
                       "muscle.m.path.0.body=cranium", "body.\"disc_left\".density=2 g/cm^3"});
  EXPECT_EQ(scenario.duration, 0.1);
  const fem::AnyMaterial& law = *scenario.bodies[2].material->law;
  EXPECT_NEAR(fem::bulk_modulus(law) / fem::shear_modulus(law), 2 * 1.3 / (3 * 0.4), 1e-12);
  EXPECT_EQ(scenario.bodies[2].density, 2000);
  EXPECT_EQ(std::get<GravityLoad>(scenario.loads[0]).acceleration, Vec3(0, 0, -1));
  EXPECT_EQ(scenario.muscles[0].excitation.value[0], 0.75);
  EXPECT_EQ(scenario.muscles[0].path[1].point, Vec3(0, 0, 2));
  EXPECT_EQ(scenario.title, "A b");
  EXPECT_EQ(scenario.bodies[0].name, "cranium");
}

TEST_F(Overrides, CreateWhatWasAbsent) {
  const Scenario scenario = read(
      scenario_, {"integrator.step=0.5 ms", "contact=false", "body.skull.layer.thickness=1 mm",
                  "body.skull.layer.young_modulus=1 MPa", "body.skull.layer.poisson_ratio=0.4"});
  EXPECT_EQ(scenario.integrator.step, 0.5e-3);
  EXPECT_FALSE(scenario.contact);
  EXPECT_EQ(scenario.bodies[0].layer->thickness, 1e-3);
}

// TOML texts and keys may hold any character; a message is one line that a terminal shows.
TEST_F(Overrides, AreRefusedInOneReadableLineWhateverTheyHold) {
  for (const std::string text :
       {R"(body."a\u0001\n".density=1)", R"(muscle.m.max_force={"a\n\u0001" = 1})",
        R"(load.0.profile={ time = ["1 \n\u0001"], value = [1] })", "body.a\x01.density=1",
        "body.0.name.a\x01=1", R"(choice."a\n"="b")", R"(choice={"a\n" = "b\u0001"})",
        R"(body.0.when={"a\n\u0001" = "b"})", R"(body.0.material={law = "\n"})",
        R"(muscle_table=[{file = "\u0001\n"}])"}) {
    const std::string message = refusal(scenario_, {text});
    EXPECT_TRUE(is_readable_line(message)) << message;
  }
}

TEST_F(Overrides, TheLastOneCounts) {
  EXPECT_EQ(read(scenario_, {"duration=1 s", "duration=2 s"}).duration, 2);
}

TEST_F(Overrides, ErrorsNameTheOverride) {
  const auto with = [&](const std::string& text) { return refusal(scenario_, {text}); };
  EXPECT_EQ(
      with("body.disk_left.density=1 g/cm^3"),
      "--set body.disk_left.density=1 g/cm^3: no body `disk_left`; did you mean `disc_left`?");
  EXPECT_EQ(with("load.1.force=0 0 1 N"),
            "--set load.1.force=0 0 1 N: no load `1`; there is 1, numbered from 0");
  EXPECT_EQ(with("load.-1.force=0 0 1 N"),
            "--set load.-1.force=0 0 1 N: no load `-1`; there is 1, numbered from 0");
  EXPECT_EQ(with("probe.jaw.axis=[1, 0, 0]"),
            "--set probe.jaw.axis=[1, 0, 0]: the scenario has no [[probe]]");
  EXPECT_EQ(
      with("integratr.step=1 ms"),
      "--set integratr.step=1 ms: scenario: unknown key `integratr`; did you mean `integrator`?");
  EXPECT_EQ(with("duration=15 mm"),
            "--set duration=15 mm: `duration`: expected a time such as \"0.6 s\", found \"15 mm\" "
            "(a length)");
  EXPECT_EQ(with("duration=3"),
            "--set duration=3: `duration`: expected a quantity with its unit, such as \"0.6 s\", "
            "found the number 3");
  EXPECT_EQ(with("duration.x=1"),
            "--set duration.x=1: `duration` is a single value, it has no part `x`");
  EXPECT_EQ(with("duration"), "--set duration: expected PATH=VALUE, such as `duration=0.1 s`");
  EXPECT_EQ(with("=1"), "--set =1: expected PATH=VALUE with a path such as `integrator.step`");
  EXPECT_EQ(with("a..b=1"),
            "--set a..b=1: expected PATH=VALUE with a path such as `integrator.step`");
  EXPECT_EQ(with("title="), "--set title=: `title`: expected text, found an empty string");
}

}  // namespace articular::sim::toml_override_test
