// Values of parameters as overrides of a scenario.
#include "tools/fit/parameter_text.hpp"

#include <gtest/gtest.h>

#include "tools/fit/fit_report.hpp"

namespace articular::tools::parameter_text_test {

FitParameter parameter(const std::string& name, const std::string& path, const std::string& unit) {
  FitParameter p;
  p.name = name;
  p.path = path;
  p.unit = unit;
  return p;
}

TEST(ParameterText, StandsInBracesWithASum) {
  Fit fit;
  fit.parameters = {parameter("up", "", "mm"),
                    parameter("strain", "ligament.a.reference_strain", ""),
                    parameter("slack", "ligament.b.slack_length", "mm")};
  const FitRun run{"run",
                   {{"ligament.a.path.0.point=\"-8 {up + 8} { up-2.5 } mm\"",
                     "body.x={ \"mesh\" = 1 }", "load.0.force=\"{up} 0 0 N\""},
                    {},
                    {},
                    false}};
  EXPECT_EQ(overrides_of(fit, run, Eigen::Vector3d(1.5, 0.02, 30.25)),
            (std::vector<std::string>{"ligament.a.path.0.point=\"-8 9.5 -1 mm\"",
                                      "body.x={ \"mesh\" = 1 }", "load.0.force=\"1.5 0 0 N\"",
                                      "ligament.a.reference_strain=0.02",
                                      "ligament.b.slack_length=\"30.25 mm\""}));
}

// The others would change what is run beside the parameters.
TEST(ParameterText, OfAFitIsWhatHasAParameterAndWhatAllRunsHave) {
  Fit fit;
  fit.parameters = {parameter("up", "", "mm"), parameter("strain", "ligament.a.strain", "")};
  const auto run = [](const char* name, const char* own) {
    return FitRun{name, {{"body.a.mass=\"1 kg\"", own, "body.b.at=\"{up} mm\""}, {}, {}, false}};
  };
  fit.runs = {run("long", "duration=\"9 s\""), run("short", "duration=\"1 s\"")};
  FitResult result;
  result.parameters = Eigen::Vector2d(2, 0.5);
  EXPECT_EQ(fitted_overrides(fit, result),
            "body.a.mass=\"1 kg\"\nbody.b.at=\"2 mm\"\nligament.a.strain=0.5\n");
}

}  // namespace articular::tools::parameter_text_test
