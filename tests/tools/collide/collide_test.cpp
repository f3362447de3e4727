// What `articular collide` finds is what brute force finds, however it is asked.
#include "tools/collide/collide.hpp"
#include "tests/support/address_sanitizer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/collide/collide_meshes.hpp"
#include "tests/tools/support/program.hpp"
#include "tools/collide/collide_report.hpp"

namespace articular::collide_test {

using Json = nlohmann::ordered_json;
using Rows = std::vector<tools::PairRow>;

/// Three frames of two V-shapes, the second leaving the first: A_0.vtu ..., B_0.vtk ...
class Series : public ::testing::Test {
 protected:
  Series() {
    for (int i = 0; i < 3; ++i) {
      a_.push_back(shapes_.upright(1 - 0.6 * i));
      b_.push_back(shapes_.across(1.5 * i));
      write_vtu(folder_ / fmt::format("A_{}.vtu", i), mesh().tets, a_.back());
      write_vtk(folder_ / fmt::format("B_{}.vtk", i), mesh().tets, b_.back());
    }
  }

  const Mesh& mesh() const { return shapes_.bar; }
  std::string csv() const { return content(folder_ / "pairs.csv"); }
  /// Runs the program and expects it to be silent on stderr.
  std::string collide(const std::string& arguments) const {
    std::filesystem::remove(folder_ / "pairs.csv");
    const ProgramResult result = run_program(folder_, "collide " + arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments;
    EXPECT_EQ(result.err, "") << arguments;
    return result.out;
  }
  Rows two_in_all_frames() const {
    Rows rows;
    for (std::size_t i = 0; i < 3; ++i) append(rows, two(i));
    return rows;
  }
  Rows two(std::size_t i) const {
    return brute_force_two(mesh(), static_cast<int>(i), a_[i], b_[i]);
  }
  static void append(Rows& rows, const Rows& more) {
    rows.insert(rows.end(), more.begin(), more.end());
  }

  TemporaryFolder folder_;
  VShapes shapes_;
  std::vector<Positions> a_, b_;
};

TEST_F(Series, TwoMeshesGiveThePairsOfBruteForceWithEitherMethodAndTest) {
  const Rows expected = two(0);
  EXPECT_GT(expected.size(), 50u);
  for (const char* options : {"", "--narrow sat", "--narrow gjk", "--method article",
                              "--method article --narrow gjk", "--threads 3"}) {
    collide(std::string("A_0.vtu B_0.vtk --pairs pairs.csv ") + options);
    EXPECT_EQ(csv(), csv_of(expected)) << options;
  }
}

TEST_F(Series, OneMeshIsSearchedAgainstItself) {
  write_vtu(folder_ / "folded.vtu", mesh().tets, shapes_.upright(-0.3));
  const Rows expected = brute_force_self(mesh(), 0, 0, sim::read_mesh(folder_ / "folded.vtu", 1).X);
  EXPECT_GT(expected.size(), 50u);
  for (const char* options : {"", "--self", "--method article", "--threads 2"}) {
    collide(std::string("folded.vtu --pairs pairs.csv ") + options);
    EXPECT_EQ(csv(), csv_of(expected)) << options;
  }
}

TEST_F(Series, SelfAddsEachBodysOwnPairsToThoseOfTwo) {
  const Positions folded = shapes_.upright(-0.3);
  write_vtu(folder_ / "folded.vtu", mesh().tets, folded);
  Rows expected = brute_force_two(mesh(), 0, b_[0], folded);
  append(expected, brute_force_self(mesh(), 0, 0, b_[0]));
  const Rows own = brute_force_self(mesh(), 0, 1, folded);
  EXPECT_FALSE(own.empty());
  append(expected, own);
  for (const char* method : {"blocks", "article"}) {
    collide(std::string("B_0.vtk folded.vtu --self --pairs pairs.csv --method ") + method);
    EXPECT_EQ(csv(), csv_of(expected)) << method;
  }
}

TEST_F(Series, PatternsAreTakenInTheOrderOfNames) {
  const Rows expected = two_in_all_frames();
  EXPECT_EQ(expected.front().frame, 0);
  EXPECT_GT(expected.back().frame, 0);
  collide("'A_*.vtu' 'B_?.vtk' --pairs pairs.csv");
  EXPECT_EQ(csv(), csv_of(expected));
  collide("'A_*.vtu' 'B_?.vtk' --pairs pairs.csv --repeat 3 --threads 2");
  EXPECT_EQ(csv(), csv_of(expected));
}

TEST_F(Series, MeshThatStandsStillIsTheSameInEveryFrame) {
  Rows expected;
  for (int i = 0; i < 3; ++i)
    append(expected, brute_force_two(mesh(), i, a_[0], b_[static_cast<std::size_t>(i)]));
  for (const char* method : {"blocks", "article"}) {
    collide(std::string("A_0.vtu 'B_*.vtk' --pairs pairs.csv --method ") + method);
    EXPECT_EQ(csv(), csv_of(expected)) << method;
  }
}

TEST_F(Series, PvdIsTakenInTheOrderOfTimeAndABodyIsChosenByItsName) {
  std::filesystem::create_directory(folder_ / "run");
  const auto entry = [](int time, const char* name, const std::string& file) {
    return fmt::format("<DataSet timestep=\"{}\" name=\"{}\" file=\"../{}\"/>\n", time, name, file);
  };
  std::string text = "<VTKFile type=\"Collection\"><Collection>\n";
  for (int i = 2; i >= 0; --i)
    text += entry(i, "a", fmt::format("A_{}.vtu", i)) + entry(i, "b", fmt::format("B_{}.vtk", i)) +
            entry(i, "bone", fmt::format("bone_{}.vtp", i));
  text += "</Collection></VTKFile>\n";
  folder_.file("run/run.pvd", text);
  collide("run/run.pvd:a run/run.pvd:b --pairs pairs.csv");
  EXPECT_EQ(csv(), csv_of(two_in_all_frames()));

  const ProgramResult unclear = run_program(folder_, "collide run/run.pvd");
  EXPECT_EQ(unclear.exit_code, 2);
  EXPECT_NE(unclear.err.find("run/run.pvd:b (of a, b)"), std::string::npos) << unclear.err;

  folder_.file("one.pvd",
               "<VTKFile><Collection>" + entry(0, "", "x/../A_0.vtu") + "</Collection></VTKFile>");
  EXPECT_EQ(tools::series_files((folder_ / "one.pvd").string()).size(), 1u);
}

TEST_F(Series, PairsNearerThanTheMarginAreAmongThose) {
  const Positions apart = a_[0].colwise() + Eigen::Vector3d(0, 2.15, 0);
  write_vtu(folder_ / "apart.vtu", mesh().tets, apart);
  collide("A_0.vtu apart.vtu --pairs pairs.csv");
  EXPECT_EQ(csv(), csv_of({}));
  const Rows near = brute_force_two(mesh(), 0, a_[0], apart, 0.2);
  EXPECT_GT(near.size(), 20u);
  for (const char* options : {"", "--narrow gjk", "--method article"}) {
    collide(std::string("A_0.vtu apart.vtu --margin 0.2 --pairs pairs.csv ") + options);
    const std::string table = csv();
    for (const tools::PairRow& row : near) {
      const std::string line = csv_of({row}).substr(csv_of({}).size());
      EXPECT_NE(table.find("\n" + line), std::string::npos) << options << ": " << line;
    }
  }
}

TEST_F(Series, JsonHasExactlyTheseKeysAndCountsWhatTheTableHolds) {
  const Json json = Json::parse(collide("'A_*.vtu' 'B_*.vtk' --json --repeat 2"));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"bodies", "frames", "memory_bytes"}));
  if (!has_address_sanitizer()) {
    EXPECT_GT(json["memory_bytes"], 10'000);
  }
  ASSERT_EQ(json["bodies"].size(), 2u);
  const Json body = {{"tetrahedra", mesh().tets.cols()},
                     {"surface_triangles", mesh().surface.faces.cols()}};
  for (const Json& found : json["bodies"]) EXPECT_EQ(found, body);
  ASSERT_EQ(json["frames"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& frame = json["frames"][i];
    keys.clear();
    for (const auto& [key, value] : frame.items()) keys.push_back(key);
    EXPECT_EQ(keys, (std::vector<std::string>{"frame", "update_s", "traverse_s", "narrow_s",
                                              "total_s", "candidates", "pairs"}));
    EXPECT_EQ(frame["frame"], i);
    EXPECT_EQ(frame["pairs"], two(i).size());
    EXPECT_GE(frame["candidates"], frame["pairs"]);
    EXPECT_GT(frame["total_s"], 0);
    EXPECT_GE(frame["update_s"], 0);
  }
}

TEST_F(Series, TextTellsTheBodiesAndEachFrame) {
  const std::string text = collide("'A_*.vtu' 'B_*.vtk' --pairs pairs.csv");
  EXPECT_NE(text.find("body 1: B_*.vtk: 240 tetrahedra"), std::string::npos) << text;
  EXPECT_NE(text.find(fmt::format(" {}\n", two(0).size())), std::string::npos) << text;
  EXPECT_NE(text.find("wrote pairs.csv\n"), std::string::npos) << text;
}

// Face 0 lies opposite node 0: x + y + z = 1. A small tetrahedron around its centre meets it alone.
TEST(CollideRows, AFaceIsNamedByTheNodeThatItLiesOpposite) {
  const TemporaryFolder folder;
  const Tetrahedra one = Eigen::Vector4i(0, 1, 2, 3);
  Positions large(3, 4);
  large << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  const Positions small = (0.1 * large).colwise() + Eigen::Vector3d(0.31, 0.3, 0.32);
  write_vtk(folder / "large.vtk", one, large);
  write_vtk(folder / "small.vtk", one, small);
  const ProgramResult result = run_program(folder, "collide large.vtk small.vtk --pairs pairs.csv");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(
      content(folder / "pairs.csv"),
      csv_of({{0, 0, 0, 0, 1, 0}, {0, 1, 0, 1, 0, 0}, {0, 1, 0, 2, 0, 0}, {0, 1, 0, 3, 0, 0}}));
}

// Triangles between the tetrahedra don't count.
TEST(CollideRows, TetrahedraAreNumberedAmongTetrahedra) {
  const TemporaryFolder folder;
  folder.file("mixed.vtk",
              "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\n"
              "POINTS 8 double\n0 0 0 1 0 0 0 1 0 0 0 1  5 0 0 6 0 0 5 1 0 5 0 1\n"
              "CELLS 4 18\n3 0 2 1\n4 0 1 2 3\n3 4 6 5\n4 4 5 6 7\nCELL_TYPES 4\n5\n10\n5\n10\n");
  Positions probe(3, 4);
  probe << 5.1, 5.2, 5.1, 5.1, 0.1, 0.1, 0.2, 0.1, 0.1, 0.1, 0.1, 0.2;
  write_vtk(folder / "probe.vtk", Eigen::Vector4i(0, 1, 2, 3), probe);
  run_program(folder, "collide probe.vtk mixed.vtk --pairs pairs.csv");
  EXPECT_EQ(
      content(folder / "pairs.csv"),
      csv_of({{0, 0, 0, 0, 1, 1}, {0, 0, 0, 1, 1, 1}, {0, 0, 0, 2, 1, 1}, {0, 0, 0, 3, 1, 1}}));
}

TEST(CollideFrames, FiguresAreMediansOverThePassesAndStopWhenAsked) {
  VShapes shapes;
  tools::MeshSeries body{"v", shapes.bar.tets, shapes.bar.surface, {"v_0.vtk", "v_1.vtk"}, {}};
  body.frames = {shapes.upright(-0.3), shapes.upright(0.3)};
  tools::PassSettings passes;
  passes.repeat = 3;
  std::vector<std::size_t> rows, done;
  passes.take_pairs = [&](std::span<const tools::PairRow> pairs) { rows.push_back(pairs.size()); };
  passes.after_frame = [&](std::size_t frames) {
    done.push_back(frames);
    return false;
  };
  const tools::CollideFigures figures = tools::collide_frames({&body, 1}, {}, passes);
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(rows.size(), 2u);  // of the first pass
  ASSERT_EQ(figures.frames.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const tools::FrameFigures& frame = figures.frames[i];
    EXPECT_EQ(static_cast<std::size_t>(frame.pairs), rows[i]);
    EXPECT_GT(frame.update_seconds, 0);
    EXPECT_GT(frame.total_seconds, frame.update_seconds);
  }
  EXPECT_FALSE(figures.interrupted);

  passes.after_frame = [](std::size_t frames) { return frames == 2; };
  EXPECT_TRUE(tools::collide_frames({&body, 1}, {}, passes).interrupted);
}

TEST(CollideReport, LongSeriesAreSummedUp) {
  VShapes shapes;
  const tools::MeshSeries body{
      "v", shapes.bar.tets, shapes.bar.surface, {}, std::vector<Positions>(100)};
  tools::CollideFigures figures;
  figures.frames.resize(100);
  figures.frames[30].pairs = 4;
  figures.frames[40].pairs = 6;
  figures.frames[7].update_seconds = 0.2;
  const std::string text = tools::to_text({&body, 1}, figures);
  EXPECT_NE(text.find("10 in 2 of 100 frames, first in frame 30, last in 40, most in 40: 6"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("mean 2.000 ms, longest 200.000 ms (frame 7)"), std::string::npos) << text;
}

}  // namespace articular::collide_test
