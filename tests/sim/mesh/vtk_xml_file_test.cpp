// .vtu and .vtp: what VTK writes is read as VTK reads it, and whatever else is in a file is refused
// in one line.
#include <gtest/gtest.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <random>

#include "sim/mesh/vtk_files.hpp"
#include "sim/mesh/vtk_xml_file.hpp"
#include "tests/sim/support/damaged_file.hpp"
#include "tests/sim/support/temporary_folder.hpp"
#include "tests/sim/support/vtk_sets.hpp"

namespace articular::sim::vtk_xml_file_test {

/// How VTK writes.
struct Form {
  const char* name;
  int mode;
  bool encoded;
  vtkXMLWriter::CompressorType compressor;
  int byte_order, header;
};
std::ostream& operator<<(std::ostream& out, const Form& form) { return out << form.name; }

class WrittenXml : public ::testing::TestWithParam<Form> {
 protected:
  template <class Writer, class Set>
  std::filesystem::path write(const std::string& name, Set* set) const {
    const Form& form = GetParam();
    vtkNew<Writer> writer;
    writer->SetInputData(set);
    writer->SetFileName((folder_ / name).c_str());
    writer->SetDataMode(form.mode);
    writer->SetEncodeAppendedData(form.encoded);
    writer->SetCompressorType(form.compressor);
    writer->SetByteOrder(form.byte_order);
    writer->SetHeaderType(form.header);
    writer->SetBlockSize(32);  // several blocks an array
    EXPECT_EQ(writer->Write(), 1);
    return folder_ / name;
  }
  std::filesystem::path grid() const {
    return write<vtkXMLUnstructuredGridWriter>("m.vtu", some_grid(VTK_DOUBLE).Get());
  }
  std::filesystem::path surface() const {
    return write<vtkXMLPolyDataWriter>("m.vtp", some_surface(VTK_FLOAT).Get());
  }
  TemporaryFolder folder_;
};

constexpr int kText = vtkXMLWriter::Ascii, kBase64 = vtkXMLWriter::Binary,
              kAppended = vtkXMLWriter::Appended, kLittle = vtkXMLWriter::LittleEndian,
              kBig = vtkXMLWriter::BigEndian;
INSTANTIATE_TEST_SUITE_P(
    Vtk, WrittenXml,
    ::testing::Values(
        Form{"text", kText, false, vtkXMLWriter::NONE, kLittle, vtkXMLWriter::UInt32},
        Form{"base64", kBase64, false, vtkXMLWriter::NONE, kLittle, vtkXMLWriter::UInt32},
        Form{"base64Big", kBase64, false, vtkXMLWriter::NONE, kBig, vtkXMLWriter::UInt64},
        Form{"base64Zlib", kBase64, false, vtkXMLWriter::ZLIB, kLittle, vtkXMLWriter::UInt64},
        Form{"raw", kAppended, false, vtkXMLWriter::NONE, kLittle, vtkXMLWriter::UInt64},
        Form{"rawZlib", kAppended, false, vtkXMLWriter::ZLIB, kLittle, vtkXMLWriter::UInt32},
        Form{"rawLz4", kAppended, false, vtkXMLWriter::LZ4, kLittle, vtkXMLWriter::UInt64},
        Form{"rawLzmaBig", kAppended, false, vtkXMLWriter::LZMA, kBig, vtkXMLWriter::UInt32},
        Form{"encoded", kAppended, true, vtkXMLWriter::NONE, kLittle, vtkXMLWriter::UInt32},
        Form{"encodedZlib", kAppended, true, vtkXMLWriter::ZLIB, kBig, vtkXMLWriter::UInt64}),
    [](const auto& form) { return std::string(form.param.name); });

void expect_same(vtkDataSetAttributes& found, vtkDataSetAttributes& expected) {
  EXPECT_EQ(found.GetNumberOfArrays(), expected.GetNumberOfArrays());
  for (int i = 0; i < expected.GetNumberOfArrays(); ++i) {
    vtkDataArray* const wanted = expected.GetArray(i);
    vtkDataArray* const array = found.GetArray(wanted->GetName());
    ASSERT_NE(array, nullptr) << wanted->GetName();
    ASSERT_EQ(array->GetNumberOfComponents(), wanted->GetNumberOfComponents());
    ASSERT_EQ(array->GetNumberOfTuples(), wanted->GetNumberOfTuples());
    for (vtkIdType t = 0; t < wanted->GetNumberOfTuples(); ++t)
      for (int c = 0; c < wanted->GetNumberOfComponents(); ++c)
        EXPECT_EQ(array->GetComponent(t, c), wanted->GetComponent(t, c)) << wanted->GetName();
  }
}

/// Cells with their nodes, points, fields and texts.
void expect_same(vtkPointSet& found, vtkPointSet& expected) {
  ASSERT_EQ(found.GetNumberOfPoints(), expected.GetNumberOfPoints());
  for (vtkIdType a = 0; a < expected.GetNumberOfPoints(); ++a)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(found.GetPoint(a)[k], expected.GetPoint(a)[k]);
  ASSERT_EQ(found.GetNumberOfCells(), expected.GetNumberOfCells());
  for (vtkIdType e = 0; e < expected.GetNumberOfCells(); ++e) {
    EXPECT_EQ(found.GetCellType(e), expected.GetCellType(e));
    vtkNew<vtkIdList> nodes, wanted;
    found.GetCellPoints(e, nodes);
    expected.GetCellPoints(e, wanted);
    ASSERT_EQ(nodes->GetNumberOfIds(), wanted->GetNumberOfIds());
    for (vtkIdType a = 0; a < wanted->GetNumberOfIds(); ++a)
      EXPECT_EQ(nodes->GetId(a), wanted->GetId(a));
  }
  expect_same(*found.GetPointData(), *expected.GetPointData());
  expect_same(*found.GetCellData(), *expected.GetCellData());
  auto* const text = vtkStringArray::SafeDownCast(found.GetFieldData()->GetAbstractArray("unit"));
  ASSERT_NE(text, nullptr);
  EXPECT_EQ(text->GetValue(0), "mm and more");
}

TEST_P(WrittenXml, AGridIsWhatWasWritten) {
  expect_same(*read_vtk_file(grid()), *some_grid(VTK_DOUBLE));
}

TEST_P(WrittenXml, ASurfaceIsWhatWasWritten) {
  expect_same(*read_vtk_file(surface()), *some_surface(VTK_FLOAT));
}

TEST_P(WrittenXml, AMeshHasItsTetrahedraTrianglesAndVectors) {
  const MeshData mesh = read_mesh(grid(), 1);
  Tetrahedra tets(4, 2);
  tets << 0, 1, 1, 2, 2, 3, 3, 4;
  EXPECT_EQ(mesh.tets, tets);
  EXPECT_EQ(mesh.triangles, Eigen::Vector3i(0, 2, 1));
  EXPECT_EQ(Vec3(mesh.X.col(4)), Vec3(1, 1, 1.25));
  ASSERT_EQ(mesh.cell_vectors.size(), 2U);
  for (const auto& [name, values] : mesh.cell_vectors) {
    ASSERT_EQ(values.cols(), 2);
    EXPECT_EQ(Vec3(values.col(1)), Vec3(1.5, 0.5, -0.5));  // of the fourth cell
  }
  ASSERT_EQ(mesh.sets.size(), 1U);
  EXPECT_EQ(mesh.sets[0].name, "rim");
  EXPECT_EQ(mesh.sets[0].nodes, (std::vector<int>{3, 4}));
  EXPECT_EQ(read_mesh(surface(), 1).triangles.cols(), 4);
}

TEST_P(WrittenXml, WhateverIsDamagedIsReadOrRefusedInOneLine) {
  const Form& form = GetParam();
  std::mt19937 random(static_cast<unsigned>(form.mode * 100 + form.compressor * 10 + form.header));
  for (const auto& file : {grid(), surface()}) {
    const std::string whole = content(file);
    int refused = 0;
    for (int trial = 0; trial < 100; ++trial) {
      const std::string message =
          refusal(folder_.file("damaged" + file.extension().string(), damaged(whole, random)));
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      if (!message.empty()) ++refused;
    }
    EXPECT_GT(refused, 25);
  }
}

// Two pieces are one mesh; a field that one of them lacks is none.
TEST(VtkXml, PiecesAreJoined) {
  const TemporaryFolder folder;
  const auto piece = [](const std::string& z, const std::string& field) {
    return "<Piece NumberOfPoints='4' NumberOfCells='1'><CellData>" + field +
           "</CellData><Points><DataArray type='Float64' NumberOfComponents='3' format='ascii'>"
           "0 0 0 1 0 0 0 1 0 0 0 " +
           z +
           "</DataArray></Points><Cells><DataArray type='Int64' Name='connectivity' format='ascii'>"
           "0 1 2 3</DataArray><DataArray type='Int64' Name='offsets' format='ascii'>4</DataArray>"
           "<DataArray type='UInt8' Name='types' format='ascii'>10</DataArray></Cells></Piece>";
  };
  const auto file = [&](const std::string& first, const std::string& second) {
    return folder.file("m.vtu", "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>" + first +
                                    second + "</UnstructuredGrid></VTKFile>");
  };
  const std::string
      a = "<DataArray type='Float32' Name='fibre' NumberOfComponents='3'>1 0 0</DataArray>",
      b = "<DataArray type='Float32' Name='fibre' NumberOfComponents='3'>0 1 0</DataArray>";
  const MeshData mesh = read_mesh(file(piece("1", a), piece("2", b)), 1);
  EXPECT_EQ(mesh.X.cols(), 8);
  EXPECT_EQ(Eigen::Vector4i(mesh.tets.col(1)), Eigen::Vector4i(4, 5, 6, 7));
  ASSERT_EQ(mesh.cell_vectors.size(), 1U);
  EXPECT_EQ(Vec3(mesh.cell_vectors[0].second.col(1)), Vec3(0, 1, 0));
  for (const auto& path : {file(piece("1", ""), piece("2", b)), file(piece("1", a), piece("2", "")),
                           file(piece("1", a + a), piece("2", b))})
    EXPECT_NE(refusal(path).find("`fibre` is there twice, or not in all pieces"), std::string::npos)
        << refusal(path);
}

std::string grid_with(const std::string& points, const std::string& more = "",
                      const std::string& attributes = "") {
  return "<VTKFile type='UnstructuredGrid' " + attributes +
         "><UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='1'><Points>" + points +
         "</Points><Cells><DataArray type='Int64' Name='connectivity'>0 1 2 3</DataArray>"
         "<DataArray type='Int64' Name='offsets'>4</DataArray>"
         "<DataArray type='UInt8' Name='types'>10</DataArray></Cells></Piece></UnstructuredGrid>" +
         more + "</VTKFile>";
}

// Each is looked for among those before it: 200 000 took minutes.
TEST(VtkXml, MoreThanAThousandFieldsAreRefused) {
  const TemporaryFolder folder;
  const auto with_fields = [&](int count) {
    std::string text = grid_with(
        "<DataArray type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1</DataArray>");
    std::string fields = "<CellData>";
    for (int i = 0; i < count; ++i)
      fields += "<DataArray type='Float32' Name='v" + std::to_string(i) +
                "' NumberOfComponents='3'>1 0 0</DataArray>";
    text.insert(text.find("</Piece>"), fields + "</CellData>");
    return folder.file("m.vtu", text);
  };
  EXPECT_EQ(read_mesh(with_fields(1000), 1).cell_vectors.size(), 1000U);
  EXPECT_NE(refusal(with_fields(1001)).find("it has more than 1000 fields"), std::string::npos);
}

// No test would end, or fit into memory, if a claim were believed.
TEST(VtkXml, MoreThanTheFileHoldsIsRefusedBeforeMemoryIsTaken) {
  const TemporaryFolder folder;
  const auto of = [&](const std::string& text) { return refusal(folder.file("m.vtu", text)); };
  const std::string points =
      "<DataArray type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1</DataArray>";
  EXPECT_EQ(of(grid_with(points)), "");
  EXPECT_NE(of(grid_with("<DataArray type='Float64' NumberOfComponents='2147483648'>0</DataArray>"))
                .find("2147483648 components; expected 1 to 1000"),
            std::string::npos);
  EXPECT_NE(
      of(grid_with(
             "<DataArray type='Float64' NumberOfComponents='3' format='appended' offset='1e308'/>"))
          .find("offset=\"1e308\" is not a number"),
      std::string::npos);
  EXPECT_NE(
      of(grid_with(
             "<DataArray type='Float64' NumberOfComponents='3' format='appended' offset='99'/>",
             "<AppendedData encoding='raw'>_x</AppendedData>"))
          .find("begins behind the end"),
      std::string::npos);
  // "/////w==" is 2³² − 1 bytes.
  EXPECT_NE(of(grid_with("<DataArray type='Float64' NumberOfComponents='3' "
                         "format='binary'>/////w==AAAA</DataArray>"))
                .find("claims more bytes than the file has"),
            std::string::npos);
  std::string many = grid_with(points);
  many.replace(many.find("NumberOfPoints='4'"), 18, "NumberOfPoints='1000000000'");
  EXPECT_NE(of(many).find("12 numbers for points; expected 1000000000 times 3"), std::string::npos);
  // 2³² − 1 blocks of 2³² − 1 bytes.
  EXPECT_NE(of(grid_with("<DataArray type='Float64' NumberOfComponents='3' format='binary'>"
                         "////////////////</DataArray>",
                         "", "compressor='vtkZLibDataCompressor'"))
                .find("claims more blocks than the file has"),
            std::string::npos);
}

// A number beyond all integers was made a character.
TEST(VtkXml, ATextHoldsCharacters) {
  const TemporaryFolder folder;
  const auto unit_of = [&](const std::string& characters) {
    std::string text = grid_with(
        "<DataArray type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1</DataArray>");
    text.insert(text.find("<Piece"), "<FieldData><Array type='String' Name='unit'>" + characters +
                                         "</Array></FieldData>");
    return read_vtk_xml(folder.file("m.vtu", text), VtkXmlFields::All).texts.at(0).second;
  };
  EXPECT_EQ(unit_of("109 109 0 109 0"), "mm");
  EXPECT_EQ(unit_of("-62 -75 109 0"), "µm");
  for (const char* const characters : {"1099999999999999999999 0", "256 0", "-129 0", "1e300 0"})
    EXPECT_THROW(unit_of(characters), InputError) << characters;
}

TEST(VtkXml, CellsHaveTextsSuchAsTheNamesOfMuscles) {
  const TemporaryFolder folder;
  const auto with_texts = [&](const std::string& characters) {
    std::string text = grid_with(
        "<DataArray type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1</DataArray>");
    text.insert(text.find("</Piece>"),
                "<CellData><Array type='String' Name='name'>" + characters + "</Array></CellData>");
    return folder.file("m.vtu", text);
  };
  const VtkXmlContent content = read_vtk_xml(with_texts("109 49 0"), VtkXmlFields::All);
  ASSERT_EQ(content.cell_texts.size(), 1U);
  EXPECT_EQ(content.cell_texts[0].name, "name");
  EXPECT_EQ(content.cell_texts[0].texts, (std::vector<std::string>{"m1"}));
  EXPECT_TRUE(read_vtk_xml(with_texts("109 0"), VtkXmlFields::OfMeshes).cell_texts.empty());
  EXPECT_THROW(read_vtk_xml(with_texts("109 0 110 0"), VtkXmlFields::All), InputError);
  EXPECT_THROW(read_vtk_xml(with_texts("300 0"), VtkXmlFields::All), InputError);
}

// Zeros fold to a thousandth at best.
TEST(VtkXml, DataThatUnfoldToMoreThanAnyCompressorCanAreRefused) {
  const TemporaryFolder folder;
  std::string data;
  for (const std::uint32_t count : {1U, 4'000'000'000U, 0U, 3U})  // blocks, size, last, compressed
    data.append(reinterpret_cast<const char*>(&count), sizeof count);
  EXPECT_NE(
      refusal(folder.file("m.vtu",
                          grid_with("<DataArray type='Float64' NumberOfComponents='3' "
                                    "format='appended' offset='0'/>",
                                    "<AppendedData encoding='raw'>_" + data + "abc</AppendedData>",
                                    "compressor='vtkZLibDataCompressor'")))
          .find("more bytes than its data can unfold to"),
      std::string::npos);
}

TEST(VtkXml, WhatIsNoSuchFileIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto of = [&](const std::string& text) { return refusal(folder.file("m.vtu", text)); };
  EXPECT_NE(of("<VTKFile type='UnstructuredGrid'>\n<UnstructuredGrid>\n</VTKFile>")
                .find("m.vtu:3: not readable as .vtu: mismatched tag"),
            std::string::npos);
  EXPECT_NE(of("<VTKFile type='ImageData'></VTKFile>").find("of type `ImageData`"),
            std::string::npos);
  EXPECT_NE(of("<other/>").find("its root is not <VTKFile>"), std::string::npos);
  EXPECT_NE(of("<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'>]><VTKFile type='PolyData'>&a;</VTKFile>")
                .find("defines a document type"),
            std::string::npos);
  EXPECT_NE(of(grid_with("")).find("<Points> holds no array"), std::string::npos);
}

}  // namespace articular::sim::vtk_xml_file_test
