#include "sim/scenario/muscle_table.hpp"

#include <gtest/gtest.h>

#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::muscle_table_test {

class MuscleTable : public ScenarioTest {
 protected:
  static constexpr const char* kHeader =
      "id,muscle,side,body_upper,ux_mm,uy_mm,uz_mm,body_lower,lx_mm,ly_mm,lz_mm,length_mm,max_"
      "force_N,"
      "optimal_length_mm,max_over_opt_length,tendon_ratio\n";
  static constexpr const char* kRows =
      "lat,\"anterior "
      "temporalis\",left,skull,58.311,-8.838,144.003,mandible,37.592,7.875,57.659,90.35,158.0,"
      "75.54,1.2698,0.5\r\n"
      "rat,anterior "
      "temporalis,right,skull,-58.311,-8.838,144.003,mandible,-37.592,7.875,57.659,90.35,158.0,"
      "75.54,1.2698,0.5\n"
      "\n"
      "lgh, \"geniohyoid, \"\"deep\"\"\" ,left,mandible,2,-20,3,hyoid,4,5,6,30,38.8,,1.5,0\n";
  const std::string scenario_ = kStart + R"([[muscle_table]]
file = "muscles.csv"
bodies = { hyoid = "skull" }
max_velocity = "6 1/s"
excitation = { "anterior temporalis" = { time = ["0 s"], value = [0.25] } }
)";
};

TEST_F(MuscleTable, RowsBecomeMuscles) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario scenario = read(scenario_);
  ASSERT_EQ(scenario.muscles.size(), 3U);
  const Muscle& muscle = scenario.muscles[0];
  EXPECT_EQ(muscle.name, "lat");
  EXPECT_EQ(muscle.path[0].body, "skull");
  EXPECT_TRUE(muscle.path[0].point.isApprox(Vec3(58.311e-3, -8.838e-3, 144.003e-3)));
  EXPECT_EQ(muscle.path[1].body, "mandible");
  EXPECT_TRUE(muscle.path[1].point.isApprox(Vec3(37.592e-3, 7.875e-3, 57.659e-3)));
  EXPECT_EQ(muscle.max_force, 158);
  EXPECT_DOUBLE_EQ(muscle.optimal_length.value(), 75.54e-3);
  EXPECT_EQ(muscle.max_length_ratio, 1.2698);
  EXPECT_EQ(muscle.tendon_ratio, 0.5);
  EXPECT_EQ(muscle.max_velocity, 6);
  EXPECT_EQ(muscle.activation_time, 15e-3);
  EXPECT_EQ(muscle.excitation.value, std::vector<double>{0.25});
  EXPECT_EQ(muscle.where.line, 2);
  EXPECT_EQ(muscle.where.file, (folder_ / "muscles.csv").string());
  EXPECT_EQ(scenario.muscles[1].excitation.value, std::vector<double>{0.25});
  EXPECT_EQ(scenario.muscles[2].path[1].body, "skull");
  EXPECT_FALSE(scenario.muscles[2].optimal_length);
  EXPECT_TRUE(scenario.muscles[2].excitation.time.empty());
}

TEST_F(MuscleTable, LeavesOutMusclesThatAreNamed) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario scenario = read(scenario_, {"muscle_table.0.leave_out=['anterior temporalis']",
                                             "muscle_table.0.excitation={}"});
  ASSERT_EQ(scenario.muscles.size(), 1U);
  EXPECT_EQ(scenario.muscles[0].name, "lgh");
  EXPECT_EQ(
      refusal(scenario_, {"muscle_table.0.leave_out=['anterior temporali']"}),
      "--set muscle_table.0.leave_out=['anterior temporali']: `leave_out[0]`: the muscle table "
      "has no muscle or row `anterior temporali`; did you mean `anterior temporalis`?");
}

TEST_F(MuscleTable, IsNotLeftEmpty) {
  write("muscles.csv", std::string(kHeader) + kRows);
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.leave_out=['lat','rat','lgh']"}),
            "--set muscle_table.0.leave_out=['lat','rat','lgh']: `leave_out`: leaves none of the "
            "table's muscles");
}

TEST_F(MuscleTable, TakesOnlyMusclesThatAreNamed) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario scenario =
      read(scenario_, {"muscle_table.0.only=['anterior temporalis']",
                       "muscle_table.0.leave_out=['lat']", "muscle_table.0.bodies={}"});
  ASSERT_EQ(scenario.muscles.size(), 1U);
  EXPECT_EQ(scenario.muscles[0].name, "rat");
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.only=['lgg']"}),
            "--set muscle_table.0.only=['lgg']: `only[0]`: the muscle table has no muscle or row "
            "`lgg`; did you mean `lgh`?");
}

// One side of a muscle is a row, by its id.
TEST_F(MuscleTable, OneSideCanDiffer) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario one =
      read(scenario_, {"muscle_table.0.excitation={rat={time=['0 s'],value=[0.5]}}"});
  EXPECT_TRUE(one.muscles[0].excitation.time.empty());
  EXPECT_EQ(one.muscles[1].excitation.value, std::vector<double>{0.5});
  const Scenario without = read(scenario_, {"muscle_table.0.leave_out=['lat']"});
  ASSERT_EQ(without.muscles.size(), 2U);
  EXPECT_EQ(without.muscles[0].name, "rat");
  EXPECT_EQ(without.muscles[0].excitation.value, std::vector<double>{0.25});
}

TEST_F(MuscleTable, OptimalLengthsCanBeShifted) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario one = read(scenario_, {"muscle_table.0.optimal_length={lat='80 mm'}"});
  EXPECT_DOUBLE_EQ(one.muscles[0].optimal_length.value(), 80e-3);
  EXPECT_DOUBLE_EQ(one.muscles[1].optimal_length.value(), 75.54e-3);
  const Scenario both =
      read(scenario_, {"muscle_table.0.optimal_length={\"anterior temporalis\"='8 cm'}"});
  EXPECT_DOUBLE_EQ(both.muscles[0].optimal_length.value(), 80e-3);
  EXPECT_DOUBLE_EQ(both.muscles[1].optimal_length.value(), 80e-3);
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.optimal_length={lat='0 mm'}"}),
            "--set muscle_table.0.optimal_length={lat='0 mm'}: `lat` must be positive, found \"0 "
            "mm\"");
  EXPECT_EQ(
      refusal(kStart + "[[muscle_table]]\nfile = \"muscles.csv\"\nforce_length = false\n"
                       "bodies = { hyoid = \"skull\" }\n",
              {"muscle_table.0.optimal_length={lat='8 cm'}"}),
      "--set muscle_table.0.optimal_length={lat='8 cm'}: [[muscle_table]]: `optimal_length` "
      "does not belong here: with force_length = false the force depends on activation alone");
}

// Lengths of the table are those of its points, before these are placed.
TEST_F(MuscleTable, OptimalLengthsGrowWithTheGeometry) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario scenario = read(
      scenario_, {"muscle_table.0.place={scale=2}", "muscle_table.0.optimal_length={rat='80 mm'}"});
  EXPECT_DOUBLE_EQ(scenario.muscles[0].optimal_length.value(), 151.08e-3);
  EXPECT_DOUBLE_EQ(scenario.muscles[1].optimal_length.value(), 80e-3);
}

// x -> scale R (x - about) + about + translation: a quarter turn about z at (0, 0, 0) takes x to y.
TEST_F(MuscleTable, PointsArePlaced) {
  write("muscles.csv", std::string(kHeader) + kRows);
  const Scenario scenario =
      read(scenario_, {"muscle_table.0.place={rotation='0 0 90 deg', about='1 0 0 mm', scale=2, "
                       "translation='0 0 10 mm'}"});
  EXPECT_TRUE(scenario.muscles[2].path[0].point.isApprox(Vec3(41e-3, 2e-3, 16e-3), 1e-12));
}

TEST_F(MuscleTable, ErrorsNameTheLineOfTheTable) {
  const auto with = [&](const std::string& table) {
    write("muscles.csv", table);
    return refusal(scenario_);
  };
  const std::string header = kHeader, rows = kRows;
  EXPECT_EQ(with("id,muscle\n" + rows), "muscles.csv:1: column `body_upper` is missing");
  EXPECT_EQ(with(header), "muscles.csv: the muscle table has no rows");
  EXPECT_EQ(with(header + rows + "x,y\n"),
            "muscles.csv:6: expected 16 fields as in the first line, found 2");
  EXPECT_EQ(with(header + rows + "a,b,left,skull,1,2,3,mandible,4,5,wide,7,8,9,1.2,0\n"),
            "muscles.csv:6: column `lz_mm`: expected a number, found \"wide\"");
  EXPECT_EQ(with(header + rows + "a,b,left,skull,1,2,3,mandible,4,5,6,7,-8,9,1.2,0\n"),
            "muscles.csv:6: column `max_force_N` must be positive, found -8");
  EXPECT_EQ(with(header + rows + "a,b,left,skull,1,2,3,mandible,4,5,6,7,8,9,1.2,1\n"),
            "muscles.csv:6: column `tendon_ratio` must be at least 0 and less than 1, found 1");
  EXPECT_EQ(with(header + rows + "a,b,left,skull,1,2,3,mandible,4,5,6,7,8,0,1.2,0\n"),
            "muscles.csv:6: column `optimal_length_mm` must be positive, found 0");
  const auto with_column = [&](const std::string& column) {
    std::string renamed = header;
    return with(renamed.replace(renamed.find("length_mm,max_f"), 9, column) + rows);
  };
  EXPECT_EQ(with_column("optimal_length_mm"),
            "muscles.csv:1: column `optimal_length_mm` appears twice");
  std::string in_metres = header;
  EXPECT_EQ(
      with(in_metres.replace(in_metres.find("optimal_length_mm"), 17, "optimal_length_m") + rows),
      "muscles.csv:1: expected optimal lengths in millimetres, in a column "
      "`optimal_length_mm`, found `optimal_length_m`");
  EXPECT_EQ(with(header + rows + "lat,b,left,skull,1,2,3,mandible,4,5,6,7,8,9,1.2,0\n"),
            "muscles.csv:6: `id`: a second muscle is called `lat`, the first is at muscles.csv:2");
  EXPECT_EQ(with(header + rows + "a,b,left,skul,1,2,3,mandible,4,5,6,7,8,9,1.2,0\n"),
            "muscles.csv:6: the scenario has no body `skul` (`bodies = { skul = \"...\" }` of the "
            "[[muscle_table]] can rename it); did you mean `skull`?");
  EXPECT_EQ(with(header + rows + "\"a,b\n"), "muscles.csv:6: a quoted field has no closing `\"`");
  EXPECT_EQ(with("i\x1f" + header.substr(1) + rows),
            "muscles.csv:1: column `id` is missing; is it `i d`?");
}

TEST_F(MuscleTable, ErrorsOfTheScenarioNameItsLine) {
  EXPECT_EQ(refusal(scenario_),
            "jaw.toml:22:8: cannot read the muscle table muscles.csv: No such file or directory");
  write("muscles.csv", std::string(kHeader) + kRows);
  EXPECT_EQ(
      refusal(scenario_, {"muscle_table.0.excitation={geniohyoit={time=['0 s'],value=[1]}}"}),
      "--set muscle_table.0.excitation={geniohyoit={time=['0 s'],value=[1]}}: the muscle "
      "table has no "
      "muscle or row `geniohyoit`; expected one of `anterior temporalis`, `geniohyoid, \"deep\"`, "
      "`lat`, `rat`, `lgh`");
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.excitation.lgt={time=['0 s'],value=[1]}"}),
            "--set muscle_table.0.excitation.lgt={time=['0 s'],value=[1]}: the muscle table has no "
            "muscle "
            "or row `lgt`; did you mean `lat`?");
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.excitation.rat={time=['0 s'],value=[1]}"}),
            "--set muscle_table.0.excitation.rat={time=['0 s'],value=[1]}: row `rat` is one of the "
            "muscle `anterior temporalis`, and `excitation` names both: expected either the muscle "
            "or its rows");
  EXPECT_EQ(
      refusal(scenario_, {"muscle_table.0.optimal_length='8 cm'"}),
      "--set muscle_table.0.optimal_length='8 cm': `optimal_length`: expected a table by names "
      "of muscles or rows, found \"8 cm\"");
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.bodies.hyoid=skul"}),
            "--set muscle_table.0.bodies.hyoid=skul: `hyoid`: no body is called `skul`; did you "
            "mean `skull`?");
  EXPECT_EQ(refusal(scenario_, {"muscle_table.0.bodies.hyoit=skull"}),
            "--set muscle_table.0.bodies.hyoit=skull: the muscle table has no body `hyoit`; did "
            "you mean `hyoid`?");
}

}  // namespace articular::sim::muscle_table_test
