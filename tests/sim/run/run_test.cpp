// run(): history, summary, frames.
#include "sim/run/run.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/mesh/frame_series.hpp"
#include "tests/sim/support/run_scene.hpp"

namespace articular::sim::run_test {

TEST_F(RunTest, TheHistoryHasAColumnWithItsUnitForEveryProbeValueAndARowForEveryStep) {
  run_all("run");
  const auto lines = split(content(out("run") / "history.csv"), '\n');
  const auto columns = split(lines.at(0), ',');
  EXPECT_EQ(columns.front(), "time [s]");
  for (const char* name :
       {"plate.position.z [mm]", "table_block.force.x [N]", "table_block.area [mm^2]",
        "table_block.max_pressure [Pa]", "table_block.max_penetration [mm]",
        "table_block.moment.x [N m]", "table_block.center.z [mm]",
        "table_block.max_penetration_at.z [mm]", "table_block.max_point_penetration [mm]",
        "puller.force [N]", "puller.length [mm]", "puller.activation [-]", "band.force [N]",
        "table.moment.y [N m]", "tilt.angle [deg]", "energy.numerical_loss [J]"})
    EXPECT_NE(std::find(columns.begin(), columns.end(), name), columns.end()) << name;
  EXPECT_EQ(std::find(columns.begin(), columns.end(), "band.activation [-]"), columns.end());
  double last = -1;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto values = split(lines[i], ',');
    ASSERT_EQ(values.size(), columns.size());
    EXPECT_GT(std::stod(values[0]), last);
    last = std::stod(values[0]);
  }
  EXPECT_EQ(last, 0.06);
  EXPECT_GE(lines.size(), 62U);
}

TEST_F(RunTest, PlacesOfAContactThatIsNotThereAreEmptyCells) {
  run_all("run");
  const std::string history = content(out("run") / "history.csv");
  EXPECT_EQ(history.find("nan"), std::string::npos);
  const auto lines = split(history, '\n');
  const auto columns = split(lines.at(0), ',');
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  };
  const auto force = column("table_block.force.z [N]"), z = column("table_block.center.z [mm]"),
             at = column("table_block.max_penetration_at.z [mm]");
  int touching = 0, apart = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto cells = split(lines[i], ',');
    const bool touches = std::stod(cells.at(force)) != 0;
    ++(touches ? touching : apart);
    EXPECT_EQ(cells.at(z).empty(), !touches);
    EXPECT_EQ(cells.at(at).empty(), !touches);
  }
  EXPECT_GT(touching, 0);
  EXPECT_GT(apart, 0);
}

TEST_F(RunTest, TheSummaryCountsWhatTheSceneNeedsAndBalancesTheEnergy) {
  run_all("run");
  const auto summary = nlohmann::json::parse(content(out("run") / "summary.json"));
  EXPECT_EQ(summary["outcome"], "finished");
  EXPECT_EQ(summary["simulated_time_s"], 0.06);
  EXPECT_EQ(summary["frames"], 11);
  for (const char* count : {"sundials_steps", "newton_iterations", "factorizations",
                            "force_evaluations", "tree_updates", "narrow_tests", "reported_pairs"})
    EXPECT_GT(summary["counts"][count], 0) << count;
  EXPECT_EQ(summary["size"]["tetrahedra"], 48);
  EXPECT_EQ(summary["size"]["rigid_bones"], 1);
  EXPECT_EQ(summary["size"]["unknown_velocities"], 3 * 27 + 6);
  EXPECT_GT(summary["max_penetration_m"], 0);
  for (const char* phase : {"total", "collision_update", "collision_narrow", "elastic_force",
                            "contact_force", "assembly", "solve", "output"})
    EXPECT_GT(summary["wall_time_s"][phase], 0) << phase;
  const auto& e = summary["energy"];
  const double balance = e["start"].get<double>() + e["muscle_work"].get<double>() +
                         e["load_work"].get<double>() + e["motion_work"].get<double>() -
                         e["ligament_loss"].get<double>() - e["numerical_loss"].get<double>() -
                         e["end"]["total"].get<double>();
  EXPECT_NEAR(balance, 0, 1e-15);
  EXPECT_GT(e["numerical_loss"], 0);
  EXPECT_GT(e["muscle_work"], 0);
}

template <class Reader>
auto read(const fs::path& file) {
  const vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return vtkSmartPointer(reader->GetOutput());
}

void expect_arrays(vtkFieldData& data, const std::vector<std::pair<const char*, int>>& arrays) {
  for (const auto& [name, components] : arrays) {
    vtkDataArray* const array = data.GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetNumberOfComponents(), components) << name;
  }
}

TEST_F(RunTest, TheSeriesOpensInVtkWithEveryArray) {
  run_all("run");
  const std::vector<SeriesEntry> entries = read_series(out("run") / "scene.pvd");
  EXPECT_EQ(entries.size(), 11U * 4U);  // three bodies and the lines
  double greatest_pressure = 0;
  for (const SeriesEntry& entry : entries) {
    const fs::path file = out("run") / entry.file;
    EXPECT_NEAR(entry.time, std::min(0.006 * entry.index, 0.06), 1e-12);
    if (entry.part == "block") {
      const auto grid = read<vtkXMLUnstructuredGridReader>(file);
      EXPECT_EQ(grid->GetNumberOfPoints(), 27);
      EXPECT_EQ(grid->GetNumberOfCells(), 48);
      expect_arrays(
          *grid->GetPointData(),
          {{"displacement", 3}, {"velocity", 3}, {"contact_force", 3}, {"contact_pressure", 1}});
      expect_arrays(*grid->GetCellData(), {{"cauchy_stress", 6},
                                           {"von_mises", 1},
                                           {"volume_ratio", 1},
                                           {"strain_energy_density", 1}});
      greatest_pressure = std::max(
          greatest_pressure, grid->GetPointData()->GetArray("contact_pressure")->GetRange()[1]);
    } else {
      const auto poly = read<vtkXMLPolyDataReader>(file);
      EXPECT_GT(poly->GetNumberOfPoints(), 0);
      if (entry.part == "lines")
        expect_arrays(*poly->GetCellData(), {{"activation", 1}, {"force", 1}, {"length", 1}});
      else
        expect_arrays(
            *poly->GetPointData(),
            {{"displacement", 3}, {"velocity", 3}, {"contact_force", 3}, {"contact_pressure", 1}});
    }
  }
  EXPECT_GT(greatest_pressure, 0);
}

/// Σ pressure · area · (−normal) over the triangles of a contact surface [N].
Vec3 force_through(vtkPolyData& surface) {
  vtkDataArray* const pressure = surface.GetCellData()->GetArray("contact_pressure");
  Vec3 force = Vec3::Zero();
  for (vtkIdType f = 0; f < surface.GetNumberOfCells(); ++f) {
    Mat3 x;  // [mm]
    for (int k = 0; k < 3; ++k)
      surface.GetPoint(surface.GetCell(f)->GetPointId(k), x.col(k).data());
    const FlatTriangle face = flat_triangle(1e-3 * x);
    force -= pressure->GetComponent(f, 0) * face.twice_area / 2 * face.normal;
  }
  return force;
}

TEST_F(RunTest, ContactSurfacesAreWrittenWhereAskedForAndCarryTheForce) {
  run_all("without");
  run_all("run", false, {"output.contact_surfaces=true"});
  EXPECT_FALSE(fs::exists(out("without") / "frames/block_contact_000000.vtp"));
  const std::vector<SeriesEntry> entries = read_series(out("run") / "scene.pvd");
  EXPECT_EQ(entries.size(), 11U * (4U + 3U));
  // Only the table's and the block's own faces in the last frame: the plate may rest on the block.
  const auto table = read<vtkXMLPolyDataReader>(out("run") / "frames/table_contact_000010.vtp");
  const auto block = read<vtkXMLPolyDataReader>(out("run") / "frames/block_contact_000010.vtp");
  EXPECT_EQ(block->GetNumberOfPoints(), 26);  // without the node inside
  EXPECT_EQ(block->GetNumberOfCells(), 48);
  for (vtkPolyData* surface : {table.Get(), block.Get()}) {
    expect_arrays(*surface->GetPointData(), {{"contact_force", 3}, {"contact_pressure", 1}});
    expect_arrays(*surface->GetCellData(), {{"contact_pressure", 1}, {"contact_gap", 1}});
    Vec3 at_nodes = Vec3::Zero();
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i) {
      Vec3 f;
      surface->GetPointData()->GetArray("contact_force")->GetTuple(i, f.data());
      at_nodes += f;
    }
    EXPECT_GT(force_through(*table).norm(), 1e-4);  // [N]: something weighs on it
    EXPECT_LT((force_through(*surface) - at_nodes).norm(), 0.02 * force_through(*table).norm());
  }
  const auto lines = split(content(out("run") / "history.csv"), '\n');
  const auto columns = split(lines.at(0), ',');
  const auto z = std::find(columns.begin(), columns.end(), "table_block.force.z [N]");
  const double probe =
      std::stod(split(lines.back(), ',').at(static_cast<std::size_t>(z - columns.begin())));
  EXPECT_NEAR(force_through(*table).z(), probe, 1e-6 * std::abs(probe));
}

TEST_F(RunTest, ARunThatCannotGoOnSaysUntilWhenAndLeavesValidFiles) {
  RunOptions options;
  options.directory = out("run");
  // One Newton iteration is too few for this tolerance, however short the step.
  const std::vector<std::string> overrides = {"integrator.max_iterations=1",
                                              "integrator.position_tolerance=1e-9 um"};
  EXPECT_THROW(run_with(options, overrides), SimulationError);
  const auto summary = nlohmann::json::parse(content(out("run") / "summary.json"));
  EXPECT_NE(summary["outcome"].get<std::string>().find("cannot go on at t ="), std::string::npos);
  EXPECT_FALSE(read_series(out("run") / "scene.pvd").empty());
}

TEST_F(RunTest, StepsEndAtEveryKink) {
  const std::vector<double> kinks = kink_times(build_model(scenario()), scenario().duration);
  ASSERT_EQ(kinks.size(), 2U);
  EXPECT_EQ(kinks[0], 0.0153);
  run_all("run");
  EXPECT_NE(content(out("run") / "history.csv").find("\n0.0153,"), std::string::npos);
}

/// Whoever goes through a course by himself, restarts where checkpoints are due included.
TEST_F(RunTest, ACourseHasTheStatesOfARun) {
  const Scenario scene = scenario();
  const Model model = build_model(scene);
  std::vector<Eigen::VectorXd> states;
  RunOptions options;
  options.directory = out("run");
  options.steer = [&](Course& course) { states.push_back(course.state().y); };
  run(scene, model, options);

  Course course(scene, model);
  course.begin();
  course.set_apart();
  std::size_t i = 0;
  EXPECT_EQ(course.state().y, states.at(i));
  int restarts = 0;
  while (!course.is_done()) {
    course.step();
    if (course.checkpoint_is_due()) {
      course.restart();
      ++restarts;
    }
    ASSERT_EQ(course.state().y, states.at(++i)) << "step " << i;
  }
  EXPECT_EQ(i + 1, states.size());
  EXPECT_GT(restarts, 0);
}

TEST_F(RunTest, AnActivationThatIsSteeredIsThatOfTheNextStep) {
  const Scenario scene = scenario();
  const Model model = build_model(scene);
  RunOptions options;
  options.directory = out("run");
  double last = 0;
  options.steer = [&](Course& course) {
    last = course.stepper().now().configuration.activation[0];
    course.state().y[model.layout.activations()] = 0.9;
    course.restart();
  };
  run(scene, model, options);
  // After a step of 1 ms it has gone a small part of the way to its excitation.
  EXPECT_GT(last, 0.8);
  EXPECT_LT(last, 0.9);
}

// The block falls from the air through the table, which [[contact]] forgot, and is beyond it at the
// end.
TEST_F(RunTest, ABodyThatWentThroughAnotherIsTold) {
  Scenario falling = scenario({"body.2.velocity=\"0 0 -400 mm/s\"", "output.interval=\"3 ms\""});
  falling.contacts = {{"plate", "block", {}}, {"plate", "table", {}}};
  falling.probes.clear();
  std::string warnings;
  RunOptions options;
  options.directory = out("run");
  options.warn = [&](const std::string& warning) { warnings += warning + "\n"; };
  const std::string told = "`table` and `block` went into each other";
  run(falling, build_model(falling), options);
  EXPECT_NE(warnings.find(told), std::string::npos) << warnings;
  const auto summary = nlohmann::json::parse(content(out("run") / "summary.json"));
  EXPECT_NE(summary.at("warnings").dump().find(told), std::string::npos);
}

}  // namespace articular::sim::run_test
