// `articular report` as a user starts it: what lands in the page, and what is said of bad input.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "tests/tools/report/reported_run.hpp"
#include "tests/tools/report/unpacked.hpp"

namespace articular::tools::report_test {

namespace fs = std::filesystem;

/// A run that each test has a copy of.
class Report : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    finished_ = std::make_unique<TemporaryFolder>();
    const ProgramResult run = run_block(*finished_);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  static void TearDownTestSuite() { finished_.reset(); }
  void SetUp() override {
    fs::copy(*finished_ / "block", folder_ / "block", fs::copy_options::recursive);
    fs::copy(*finished_ / "block.toml", folder_ / "block.toml");
  }

  nlohmann::json data() {
    const ProgramResult report = run_program(folder_, "report block");
    EXPECT_EQ(report.exit_code, 0) << report.err;
    return data_of(folder_ / "block/report.html");
  }

  static std::unique_ptr<TemporaryFolder> finished_;
  TemporaryFolder folder_;
};

std::unique_ptr<TemporaryFolder> Report::finished_;

TEST_F(Report, IsOnePageBesideTheResults) {
  const ProgramResult report = run_program(folder_, "report block");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.out.find("wrote block/report.html ("), 0U) << report.out;
  EXPECT_EQ(report.err, "");
  const std::string html = content(folder_ / "block/report.html");
  for (const char* const from_elsewhere :
       {"src=\"", "href=\"http", "@import", "@PAGE_", "@ARTICULAR_"})
    EXPECT_EQ(html.find(from_elsewhere), std::string::npos) << from_elsewhere;
  EXPECT_LT(html.size(), 1'500'000U);
}

TEST_F(Report, GoesWhereAsked) {
  EXPECT_EQ(run_program(folder_, "report block -o page.html").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "page.html"));
  EXPECT_FALSE(fs::exists(folder_ / "block/report.html"));
  EXPECT_EQ(run_program(folder_, "report block -o nowhere/page.html").exit_code, 4);
  const ProgramResult pdf = run_program(folder_, "report block -o page.pdf");
  EXPECT_EQ(pdf.exit_code, 2);
  EXPECT_NE(pdf.err.find("page.pdf: a report is a web page: expected"), std::string::npos)
      << pdf.err;
}

TEST_F(Report, HoldsTheSummaryAndAllProbes) {
  const nlohmann::json page = data();
  EXPECT_EQ(page["summary"]["outcome"], "finished");
  EXPECT_EQ(page["title"], "A block <pulled> & </script> pressed");
  const nlohmann::json& history = page["history"];
  const std::string rows = content(folder_ / "block/history.csv");
  const auto count = static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n')) - 1;
  EXPECT_EQ(history["rows"], count);
  const auto column = [&](const std::string& name) {
    for (const nlohmann::json& one : history["columns"])
      if (one["name"] == name) return one;
    ADD_FAILURE() << name;
    return nlohmann::json();
  };
  const nlohmann::json z = column("middle.position.z");
  EXPECT_EQ(z["unit"], "mm");
  const std::vector<double> times = unpacked_doubles(history["axes"][z["axis"].get<std::size_t>()]),
                            values = unpacked_doubles(z["values"]);
  ASSERT_EQ(times.size(), count);
  ASSERT_EQ(values.size(), count);
  EXPECT_NEAR(times.back(), 0.04, 1e-9);
  EXPECT_LT(values.back(), values.front() - 0.1);
}

TEST_F(Report, ShowsEveryFrameInThreeDimensions) {
  const nlohmann::json scene = data()["scene"];
  EXPECT_EQ(scene["moments"].size(), 5U);
  EXPECT_EQ(scene["moments"][4], "t = 40.0 ms");
  ASSERT_EQ(scene["bodies"].size(), 3U);
  EXPECT_EQ(scene["lines"]["names"][0], "puller");
  EXPECT_EQ(scene["directions"][2], "superior");
  for (const nlohmann::json& body : scene["bodies"]) {
    if (body["name"] != "plate") continue;
    // The plate goes down by 1 mm: its last pose is no turn, and that shift.
    const std::vector<double> poses = unpacked_doubles(body["poses"]);
    ASSERT_EQ(poses.size(), 5U * 12);
    EXPECT_NEAR(poses[4 * 12 + 0], 1, 1e-6);
    EXPECT_NEAR(poses[4 * 12 + 11], -1, 1e-6);
  }
}

// Exact values are beside the point: they are within a step of those of the frame, and these are
// tested where they are made.
TEST_F(Report, FieldsHaveTheirUnitsAndReachAsInTheFrames) {
  const nlohmann::json scene = data()["scene"];
  const auto block =
      std::find_if(scene["bodies"].begin(), scene["bodies"].end(),
                   [](const nlohmann::json& body) { return body["name"] == "block"; });
  EXPECT_EQ((*block)["fields"]["von_mises"]["low"], 0);
  EXPECT_GT((*block)["fields"]["von_mises"]["high"], 1000);
  for (const nlohmann::json& field : scene["fields"]) {
    if (field["name"] == "von_mises") {
      EXPECT_EQ(field["unit"], "kPa");
      EXPECT_EQ(field["factor"], 1e-3);
    }
    if (field["name"] == "activation") {
      EXPECT_EQ(field["unit"], "");
      EXPECT_TRUE(field["is_of_lines"]);
    }
  }
}

TEST_F(Report, HasPicturesThatLieInTheFolder) {
  fs::create_directories(folder_ / "block/plot");
  folder_.file("block/plot/all.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  folder_.file("block/plot/huge.png", std::string(2'000'000, 'x'));
  const nlohmann::json page = data();
  ASSERT_EQ(page["pictures"].size(), 1U);
  EXPECT_EQ(page["pictures"][0]["name"], "plot/all.svg");
  EXPECT_EQ(page["remarks"][0], "plot/huge.png is left out, to keep this page small");
}

TEST_F(Report, LeavesOutPicturesOfEarlierResults) {
  fs::create_directories(folder_ / "block/plot");
  for (const char* name : {"block/plot/new.svg", "block/plot/old.svg"})
    folder_.file(name, "<svg xmlns='http://www.w3.org/2000/svg'/>");
  fs::last_write_time(
      folder_ / "block/plot/old.svg",
      fs::last_write_time(folder_ / "block/summary.json") - std::chrono::seconds(1));
  const nlohmann::json page = data();
  ASSERT_EQ(page["pictures"].size(), 1U);
  EXPECT_EQ(page["pictures"][0]["name"], "plot/new.svg");
  EXPECT_EQ(page["remarks"][0], "plot/old.svg is left out: it was drawn of earlier results");
}

TEST_F(Report, HasErrorBarsWhereTheyAreThere) {
  EXPECT_TRUE(data()["error_bars"].is_null());
  folder_.file("block/error_bars.csv",
               "column,quantity,value,bar,verdict\na [N],end,1.5,0.1,asymptotic\n");
  EXPECT_EQ(data()["error_bars"]["rows"][0][4], "asymptotic");
}

TEST_F(Report, ARunWithoutFramesHasCurvesAndSaysSo) {
  fs::remove(folder_ / "block/block.pvd");
  const ProgramResult report = run_program(folder_, "report block");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_NE(report.err.find("note: no frames to show in 3D"), std::string::npos) << report.err;
  const nlohmann::json page = data_of(folder_ / "block/report.html");
  EXPECT_TRUE(page["scene"].is_null());
  EXPECT_GT(page["history"]["rows"], 5);
}

TEST_F(Report, ARunThatWasKilledIsShownAsFarAsItCame) {
  std::string summary = content(folder_ / "block/summary.json");
  summary.replace(summary.find("\"finished\""), 10, "\"unfinished\"");
  folder_.file("block/summary.json", summary);
  const std::string history = content(folder_ / "block/history.csv");
  folder_.file("block/history.csv", history.substr(0, history.find('\n') + 1));
  const nlohmann::json page = data();
  EXPECT_EQ(page["summary"]["outcome"], "unfinished");
  EXPECT_TRUE(page["history"].is_null());
  EXPECT_EQ(page["remarks"][0], "block/history.csv: holds no row of results yet");
  EXPECT_EQ(page["scene"]["moments"].size(), 5U);
}

TEST_F(Report, AFrameThatIsGoneIsAnErrorAtItsFile) {
  fs::remove(folder_ / "block/frames/block_000002.vtu");
  const ProgramResult report = run_program(folder_, "report block");
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_NE(report.err.find("block_000002.vtu: this frame is listed"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "block/report.html"));
}

TEST_F(Report, RefusesWhatIsNoRun) {
  fs::create_directories(folder_ / "empty");
  const ProgramResult empty = run_program(folder_, "report empty");
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_EQ(empty.err,
            "articular: empty: no results here: expected the folder of an `articular run`\n");
  EXPECT_EQ(run_program(folder_, "report nowhere").exit_code, 2);
  EXPECT_EQ(run_program(folder_, "report").exit_code, 2);
}

TEST_F(Report, OfAScenarioShowsItsBodiesWithTheirMaterials) {
  const ProgramResult report = run_program(folder_, "report block.toml");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.out.find("wrote block_setup.html"), 0U) << report.out;
  const nlohmann::json page = data_of(folder_ / "block_setup.html");
  EXPECT_EQ(page["kind"], "setup");
  const nlohmann::json block = page["scene"]["bodies"][2];
  EXPECT_EQ(block["name"], "block");
  EXPECT_NE(block["details"].dump().find(R"(["material.young_modulus","50 kPa"])"),
            std::string::npos)
      << block["details"];
  std::vector<std::string> marks;
  for (const nlohmann::json& mark : page["scene"]["marks"]) marks.push_back(mark["name"]);
  EXPECT_EQ(marks, (std::vector<std::string>{"attached nodes", "ends of muscles and ligaments",
                                             "gravity of 9.81 m/s²"}));
}

TEST_F(Report, OfAScenarioThatIsWrongSaysWhere) {
  folder_.file("wrong.toml", "duration = \"1 parsec\"\n");
  const ProgramResult report = run_program(folder_, "report wrong.toml");
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_NE(report.err.find("wrong.toml:1:"), std::string::npos) << report.err;
}

}  // namespace articular::tools::report_test
