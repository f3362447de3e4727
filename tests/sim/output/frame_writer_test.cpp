#include "sim/output/frame_writer.hpp"
#include "sim/base/atomic_file.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "sim/base/error.hpp"
#include "sim/mesh/frame_series.hpp"
#include "tests/sim/support/temporary_folder.hpp"

namespace articular::sim::frame_writer_test {

constexpr double kMillimetre = 1e-3;  // [m]

Field random_field(const std::string& name, const std::string& unit, int rows, int columns) {
  std::mt19937 random(static_cast<unsigned>(name.size()));
  std::uniform_real_distribution<double> value(-1, 1);
  Field field{name, unit, Eigen::MatrixXd(rows, columns)};
  for (double& v : field.values.reshaped()) v = value(random);
  return field;
}

/// A tetrahedron, a triangle and two lines, with every array that a run writes.
struct Scene {
  Positions x = 0.1 * Positions::Random(3, 4);
  Tetrahedra tets = Eigen::Vector4i(0, 1, 2, 3);
  Triangles triangles = Eigen::Vector3i(0, 1, 2);
  TissueFrame tissue{
      "disc",
      x,
      tets,
      {random_field("displacement", "m", 3, 4), random_field("velocity", "m/s", 3, 4),
       random_field("contact_force", "N", 3, 4), random_field("contact_pressure", "Pa", 1, 4)},
      {random_field("cauchy_stress", "Pa", 6, 1), random_field("von_mises", "Pa", 1, 1),
       random_field("volume_ratio", "-", 1, 1),
       random_field("strain_energy_density", "J/m^3", 1, 1),
       random_field("fibre_stretch", "-", 1, 1)}};
  RigidBodyFrame rigid{"condyle", x, triangles, {}, {random_field("contact_pressure", "Pa", 1, 1)}};
  LinesFrame lines{{"masseter", "temporomandibular"},
                   {0.1 * Positions::Random(3, 2), 0.1 * Positions::Random(3, 3)},
                   {random_field("activation", "-", 1, 2), random_field("force", "N", 1, 2),
                    random_field("length", "m", 1, 2), random_field("kind", "-", 1, 2)}};

  void write(FrameWriter& writer, int index, double time) const {
    writer.write_tissue(tissue, index, time);
    writer.write_rigid_body(rigid, index, time);
    writer.write_lines(lines, index, time);
    writer.finish_frame(index, time);
  }
};

template <class Reader>
auto read(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkSmartPointer output = reader->GetOutput();
  return output;
}

void expect_positions(vtkPointSet& set, const Positions& x) {
  ASSERT_EQ(set.GetNumberOfPoints(), x.cols());
  for (Eigen::Index a = 0; a < x.cols(); ++a) {
    Vec3 p;
    set.GetPoint(a, p.data());
    EXPECT_EQ(p, Vec3(x.col(a) / kMillimetre));
  }
}

std::string text_of(vtkPointSet& set, const std::string& name) {
  auto* const array =
      vtkStringArray::SafeDownCast(set.GetFieldData()->GetAbstractArray(name.c_str()));
  return array != nullptr ? array->GetValue(0) : "absent";
}

void expect_field(vtkPointSet& set, vtkFieldData& data, const Field& field, double scale,
                  const std::string& unit) {
  vtkDataArray* const array = data.GetArray(field.name.c_str());
  ASSERT_NE(array, nullptr) << field.name;
  ASSERT_EQ(array->GetNumberOfComponents(), field.values.rows()) << field.name;
  ASSERT_EQ(array->GetNumberOfTuples(), field.values.cols()) << field.name;
  EXPECT_EQ(array->GetDataType(), VTK_DOUBLE) << field.name;
  for (Eigen::Index j = 0; j < field.values.cols(); ++j)
    for (int i = 0; i < field.values.rows(); ++i)
      EXPECT_DOUBLE_EQ(array->GetComponent(j, i), scale * field.values(i, j)) << field.name;
  EXPECT_EQ(text_of(set, field.name + ".unit"), unit);
}

TEST(FrameWriter, EveryArrayIsReadBackByVtkWithItsUnit) {
  const TemporaryFolder folder;
  const Scene scene;
  FrameWriter writer(folder / "run", "opening", {kMillimetre, "mm"});
  scene.write(writer, 123, 0.25);

  const auto tissue = read<vtkXMLUnstructuredGridReader>(folder / "run/frames/disc_000123.vtu");
  expect_positions(*tissue, scene.x);
  ASSERT_EQ(tissue->GetNumberOfCells(), 1);
  EXPECT_EQ(tissue->GetCellType(0), VTK_TETRA);
  for (const Field& field : scene.tissue.point_fields) {
    const bool in_metres = field.unit == "m" || field.unit == "m/s";
    expect_field(*tissue, *tissue->GetPointData(), field, in_metres ? 1000 : 1,
                 (in_metres ? "m" : "") + field.unit);  // "m" to "mm", "m/s" to "mm/s"
  }
  for (const Field& field : scene.tissue.cell_fields)
    expect_field(*tissue, *tissue->GetCellData(), field, 1, field.unit);
  EXPECT_EQ(tissue->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.25);
  EXPECT_EQ(text_of(*tissue, "coordinates.unit"), "mm");

  const auto rigid = read<vtkXMLPolyDataReader>(folder / "run/frames/condyle_000123.vtp");
  EXPECT_EQ(rigid->GetNumberOfPolys(), 1);
  expect_positions(*rigid, scene.x);
  expect_field(*rigid, *rigid->GetCellData(), scene.rigid.cell_fields[0], 1, "Pa");
  EXPECT_EQ(rigid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.25);

  const auto lines = read<vtkXMLPolyDataReader>(folder / "run/frames/lines_000123.vtp");
  ASSERT_EQ(lines->GetNumberOfLines(), 2);
  Positions all(3, 5);
  all << scene.lines.paths[0], scene.lines.paths[1];
  expect_positions(*lines, all);
  EXPECT_EQ(lines->GetCell(1)->GetNumberOfPoints(), 3);
  for (const Field& field : scene.lines.cell_fields)
    expect_field(*lines, *lines->GetCellData(), field, 1, field.unit);
  auto* const names = vtkStringArray::SafeDownCast(lines->GetCellData()->GetAbstractArray("name"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(1), "temporomandibular");
}

TEST(FrameWriter, AContactSurfaceHasTheNodesOfItsFacesOnly) {
  const TemporaryFolder folder;
  const Positions x = 0.1 * Positions::Random(3, 6);
  Triangles faces(3, 2);
  faces << 1, 4, 2, 2, 4, 5;  // columns 1 2 4 and 4 2 5
  const Field pressure = random_field("contact_pressure", "Pa", 1, 6);
  const Field gap = random_field("contact_gap", "m", 1, 2);
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  writer.write_contact_surface({"disc", x, faces, {pressure}, {gap}}, 7, 0.1);
  writer.finish_frame(7, 0.1);
  const std::vector<int> kept = {1, 2, 4, 5};
  const auto surface = read<vtkXMLPolyDataReader>(folder / "frames/disc_contact_000007.vtp");
  expect_positions(*surface, x(Eigen::all, kept));
  ASSERT_EQ(surface->GetNumberOfPolys(), 2);
  for (int f = 0; f < 2; ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(kept[static_cast<std::size_t>(surface->GetCell(f)->GetPointId(k))], faces(k, f));
  Field at_kept = pressure;
  at_kept.values = pressure.values(Eigen::all, kept);
  expect_field(*surface, *surface->GetPointData(), at_kept, 1, "Pa");
  expect_field(*surface, *surface->GetCellData(), gap, 1000, "mm");
  const std::vector<SeriesEntry> entries = read_series(folder / "opening.pvd");
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_TRUE(is_contact_surface(entries[0]));
  EXPECT_FALSE(is_contact_surface({0, 0, "disc_contact", "frames/disc_contact_000000.vtp"}));
}

TEST(FrameWriter, FilesAreBinaryAsItIs) {
  const TemporaryFolder folder;
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  Scene().write(writer, 0, 0);
  const std::string text = content(folder / "frames/disc_000000.vtu");
  EXPECT_EQ(text.find("compressor="), std::string::npos);
  EXPECT_EQ(text.find("format=\"ascii\""), std::string::npos);
}

TEST(FrameWriter, AFrameIsListedWhenAllItsPartsAreThere) {
  const TemporaryFolder folder;
  const Scene scene;
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  scene.write(writer, 0, 0);
  writer.write_tissue(scene.tissue, 1, 0.1);
  EXPECT_EQ(read_series(folder / "opening.pvd").size(), 3U);
  writer.write_rigid_body(scene.rigid, 1, 0.1);
  writer.finish_frame(1, 0.1);
  const std::vector<SeriesEntry> entries = read_series(folder / "opening.pvd");
  ASSERT_EQ(entries.size(), 5U);
  EXPECT_EQ(entries[3].time, 0.1);
  EXPECT_EQ(entries[3].index, 1);
  EXPECT_EQ(entries[3].part, "disc");
  EXPECT_EQ(entries[3].file, "frames/disc_000001.vtu");
  EXPECT_EQ(entries[4].part, "condyle");
  for (const SeriesEntry& entry : entries)
    EXPECT_TRUE(std::filesystem::exists(folder / entry.file)) << entry.file;
}

TEST(FrameWriter, AResumedRunContinuesTheSeriesWithoutGapOrDouble) {
  const TemporaryFolder folder;
  const Scene scene;
  FileExtent known;
  {
    FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
    for (int i = 0; i < 6; ++i) {
      scene.write(writer, i, 0.1 * i);
      if (i == 3) known = writer.series();
    }
  }
  FrameWriter resumed(folder.path(), "opening", {kMillimetre, "mm"});
  resumed.resume_at(known);
  EXPECT_EQ(read_series(folder / "opening.pvd").size(), 12U);
  for (int i = 4; i < 8; ++i) scene.write(resumed, i, 0.1 * i);
  const std::vector<SeriesEntry> entries = read_series(folder / "opening.pvd");
  ASSERT_EQ(entries.size(), 24U);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const int frame = static_cast<int>(i / 3);
    EXPECT_EQ(entries[i].index, frame);
    EXPECT_EQ(entries[i].time, 0.1 * frame);
  }
}

TEST(FrameWriter, PartsKeepTheirNumbersWhenARunIsResumed) {
  const TemporaryFolder folder;
  const Scene scene;
  const auto write = [&](FrameWriter& writer, int index) {
    if (index == 1)  // parts in another order
      writer.write_rigid_body(scene.rigid, index, 0.1);
    writer.write_tissue(scene.tissue, index, 0.1 * index);
    writer.finish_frame(index, 0.1 * index);
  };
  for (const char* const name : {"whole", "parts"}) {
    std::optional<FrameWriter> writer;
    writer.emplace(folder / name, "opening", LengthUnit{kMillimetre, "mm"});
    write(*writer, 0);
    const FileExtent known = writer->series();
    if (name == std::string("parts")) {
      writer.emplace(folder / name, "opening", LengthUnit{kMillimetre, "mm"});
      writer->resume_at(known);
    }
    write(*writer, 1);
  }
  EXPECT_EQ(content(folder / "whole/opening.pvd"), content(folder / "parts/opening.pvd"));
}

TEST(FrameWriter, ResumingIsRefusedWhereFramesOrTheSeriesAreNotAsTheyWere) {
  const TemporaryFolder folder;
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  Scene().write(writer, 0, 0);
  Scene().write(writer, 1, 0.1);
  const FileExtent known = writer.series();
  const std::string series = content(folder / "opening.pvd");
  const std::string frame = content(folder / "frames/disc_000001.vtu");
  writer.resume_at(known);
  folder.file("opening.pvd", series.substr(0, series.size() / 2));
  EXPECT_THROW(writer.resume_at(known), InputError);
  folder.file("opening.pvd", series);
  folder.file("frames/disc_000001.vtu", "");  // a power cut
  EXPECT_THROW(writer.resume_at(known), InputError);
  std::filesystem::remove(folder / "frames/disc_000001.vtu");
  EXPECT_THROW(writer.resume_at(known), InputError);
  folder.file("frames/disc_000001.vtu", frame);
  writer.resume_at(known);
}

TEST(FrameWriter, NoTwoPartsShareAFile) {
  const TemporaryFolder folder;
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  const Scene scene;
  writer.write_tissue(scene.tissue, 0, 0);
  EXPECT_THROW(writer.write_tissue(scene.tissue, 0, 0), InputError);
}

TEST(FrameWriter, NamesWithMarkupSurviveInTheSeries) {
  const TemporaryFolder folder;
  Scene scene;
  scene.tissue.body = "a<b>&\"c\"";
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  scene.write(writer, 0, 0);
  EXPECT_EQ(read_series(folder / "opening.pvd")[0].part, scene.tissue.body);
}

TEST(FrameWriter, NamesThatCantBeAFileAreRefused) {
  const TemporaryFolder folder;
  Scene scene;
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  for (const std::string name : {"", "../disc", "a/b", ".disc"}) {
    scene.tissue.body = name;
    EXPECT_THROW(writer.write_tissue(scene.tissue, 0, 0), InputError) << name;
  }
}

TEST(FrameWriter, AFolderThatCantBeMadeIsASystemErrorThatNamesIt) {
  const TemporaryFolder folder;
  folder.file("plain", "text");
  const std::string below = (folder / "plain/run").string();
  try {
    const FrameWriter writer(below, "opening", {kMillimetre, "mm"});
    ADD_FAILURE();
  } catch (const SystemError& error) {
    EXPECT_NE(std::string(error.what()).find(below), std::string::npos) << error.what();
  }
}

TEST(FrameWriter, AFrameThatCantBeWrittenIsNotListed) {
  const TemporaryFolder folder;
  const Scene scene;
  FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"});
  scene.write(writer, 0, 0);
  std::filesystem::create_symlink("/dev/full", folder / "frames/disc_000001.vtu");
  EXPECT_THROW(scene.write(writer, 1, 0.1), SystemError);
  EXPECT_EQ(read_series(folder / "opening.pvd").size(), 3U);
}

TEST(FrameWriter, AThreadOfItsOwnWritesTheSameFiles) {
  const TemporaryFolder folder;
  const Scene scene;
  for (const auto& [name, thread] :
       {std::pair{"callers", FrameThread::Callers}, std::pair{"its_own", FrameThread::OfItsOwn}}) {
    FrameWriter writer(folder / name, "opening", {kMillimetre, "mm"}, thread);
    for (int i = 0; i < 5; ++i) scene.write(writer, i, 0.1 * i);
    writer.series();  // waits for the last frame
    EXPECT_EQ(read_series(folder / name / "opening.pvd").size(), 15U);
  }
  EXPECT_EQ(content(folder / "its_own/opening.pvd"), content(folder / "callers/opening.pvd"));
  const std::vector<SeriesEntry> entries = read_series(folder / "its_own/opening.pvd");
  ASSERT_EQ(entries.size(), 15U);
  for (const SeriesEntry& entry : entries)
    EXPECT_EQ(content(folder / "its_own" / entry.file), content(folder / "callers" / entry.file));
}

TEST(FrameWriter, WhatAThreadOfItsOwnCantWriteIsThrownByWhateverComesNext) {
  const Scene scene;
  using Next = std::function<void(FrameWriter&)>;
  for (const Next& next : {Next([&](FrameWriter& writer) { scene.write(writer, 2, 0.2); }),
                           Next([](FrameWriter& writer) { writer.sync(); }),
                           Next([](FrameWriter& writer) { writer.series(); })}) {
    const TemporaryFolder folder;
    FrameWriter writer(folder.path(), "opening", {kMillimetre, "mm"}, FrameThread::OfItsOwn);
    scene.write(writer, 0, 0);
    writer.sync();
    std::filesystem::create_symlink("/dev/full", folder / "frames/disc_000001.vtu");
    scene.write(writer, 1, 0.1);
    EXPECT_THROW(next(writer), SystemError);
    EXPECT_EQ(read_series(folder / "opening.pvd").size(), 3U);
  }
}

TEST(WriteTextFile, ReplacesTheWholeFileAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  const auto file = folder.file("f.json", "a longer text than the next");
  folder.file("f.json.part", "left by a run that was killed");
  write_text_file(file, "next");
  EXPECT_EQ(content(file), "next");
  EXPECT_FALSE(std::filesystem::exists(folder / "f.json.part"));
}

TEST(WriteTextFile, FollowsALinkAndKeepsIt) {
  const TemporaryFolder folder;
  folder.file("target", "old");
  std::filesystem::create_symlink("target", folder / "link");
  write_text_file(folder / "link", "new");
  EXPECT_EQ(content(folder / "target"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
}

TEST(WriteTextFile, AFailureKeepsTheOldFile) {
  const TemporaryFolder folder;
  const auto file = folder.file("f.json", "old");
  std::filesystem::create_directory(folder / "f.json.part");  // stands in the way, also of root
  EXPECT_THROW(write_text_file(file, "new"), SystemError);
  EXPECT_EQ(content(file), "old");
}

TEST(WriteTextFile, AFullDiskIsASystemErrorAndADeviceStaysADevice) {
  try {
    write_text_file("/dev/full", "text");
    ADD_FAILURE();
  } catch (const SystemError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: can't be written: No space left on device");
  }
  write_text_file("/dev/null", "text");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(FrameWriter, RefusesWhatIsNoNumber) {
  const TemporaryFolder folder;
  FrameWriter writer(folder.path(), "scene", {kMillimetre, "mm"});
  Scene scene;
  Field& stress = scene.tissue.cell_fields[0];
  stress.values(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(scene.write(writer, 0, 0), SimulationError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "frames"));
  stress.may_be_blank = true;
  scene.write(writer, 0, 0);
}

}  // namespace articular::sim::frame_writer_test
