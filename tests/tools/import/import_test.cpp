// `articular import`: models in FEBio's format beside the same scenes written by hand, and closed
// forms. All models in the folder were written for these tests.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sim/base/error.hpp"
#include "tests/tools/support/program.hpp"
#include "tools/import/febio_material.hpp"

namespace articular::import_test {

using tools::FebioMaterial;
using tools::Loss;

const std::string kModels = ARTICULAR_SOURCE_DIR "/tests/tools/import/models/";

struct TwinModel {
  const char* name;
  int exit_code;
  const char* loss;  // part of what stderr tells
};

class Twin : public testing::TestWithParam<TwinModel> {};

// Same mesh, same settings: the same results to the last bit.
TEST_P(Twin, GivesTheSameResultsAsTheSceneWrittenByHand) {
  const TemporaryFolder folder;
  const std::string name = GetParam().name;
  const ProgramResult imported =
      run_program(folder, "import " + kModels + name + ".feb -o scene" +
                              (name == "stretch" || name == "uniaxial" ? ""
                               : name == "beam"                        ? " --units SI"
                                                                       : " --units mm-N-s"));
  EXPECT_EQ(imported.exit_code, GetParam().exit_code) << imported.err;
  EXPECT_NE(imported.err.find(GetParam().loss), std::string::npos) << imported.err;
  EXPECT_EQ(imported.out, "scene/" + name + ".toml\nscene/" + name + ".feb\n");
  const ProgramResult run =
      run_program(folder, "run scene/" + name + ".toml --out imported --quiet");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const ProgramResult by_hand =
      run_program(folder, "run " + kModels + name + ".toml --out by_hand --quiet");
  EXPECT_EQ(by_hand.exit_code, 0) << by_hand.err;
  const std::string history = content(folder / "imported/history.csv");
  EXPECT_GT(history.size(), 500U);
  EXPECT_EQ(history, content(folder / "by_hand/history.csv"));
  EXPECT_EQ(content(folder / ("scene/" + name + ".toml")).find("stiffness"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Import, Twin,
                         testing::Values(TwinModel{"stretch", 0, ""}, TwinModel{"uniaxial", 0, ""},
                                         TwinModel{"beam", 0, ""},
                                         TwinModel{"press", 3,
                                                   "not taken over: friction: in a static analysis "
                                                   "nothing has a velocity"}),
                         [](const auto& info) { return std::string(info.param.name); });

// A block that can't widen, under the pressure p: p = -(mu (s^2 - 1) + lambda ln s)/s at the
// stretch s. Elements hold a uniform deformation exactly, so the tolerance is the digits of the
// history.
TEST(Import, AConfinedBlockUnderPressureHasTheStretchOfFebiosLaw) {
  const TemporaryFolder folder;
  const ProgramResult imported = run_program(folder, "import " + kModels + "confined.feb -o scene");
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  folder.file("scene/probed.toml",
              content(folder / "scene/confined.toml") +
                  "[[probe]]\nname = 'p'\nkind = 'point'\nbody = 'block'\npoint = '5 5 10 mm'\n");
  const ProgramResult run = run_program(folder, "run scene/probed.toml --out run --quiet");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const double E = 15000, nu = 0.4, p = 5000;
  const double mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  double low = 0.5, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double s = (low + high) / 2;
    (-(mu * (s * s - 1) + lambda * std::log(s)) / s > p ? low : high) = s;
  }
  const std::string history = content(folder / "run/history.csv");
  std::istringstream lines(history);
  std::string header, line, last;
  std::getline(lines, header);
  while (std::getline(lines, line)) last = line;
  std::size_t column = 0;
  std::istringstream names(header);
  for (std::string name; std::getline(names, name, ',') && name != "p.position.z [mm]";) ++column;
  std::istringstream cells(last);
  std::string cell;
  for (std::size_t k = 0; k <= column; ++k) std::getline(cells, cell, ',');
  EXPECT_NEAR(std::stod(cell), 10 * low, 1e-5 * 10);
}

struct MappedLaw {
  const char* type;
  const char* constants;  // XML
  const char* table;
};

struct Translated {
  std::string table;
  std::vector<Loss> losses;
};

Translated translated(const std::string& type, const std::string& constants,
                      bool is_dynamic = true) {
  const sim::XmlElement element =
      sim::read_xml_tree("m.feb", ".feb", "<material>" + constants + "</material>");
  const FebioMaterial material{"1", "soft", type, &element};
  Translated result;
  const auto text =
      tools::material_text(material, tools::unit_system("mm-N-s"), "", is_dynamic, result.losses);
  if (text) result.table = text->table;
  return result;
}

// Energies of both programs are compared in tools/import/README.md.
TEST(Import, EachLawOfFebioBecomesTheOneWithTheSameEnergy) {
  const MappedLaw laws[] = {
      {"neo-Hookean", "<E>1</E><v>0.3</v>",
       "{ law = \"coupled-neo-hookean\", young_modulus = \"1 MPa\", poisson_ratio = 0.3 }"},
      {"isotropic elastic", "<E>1</E><v>0.3</v>",
       "{ law = \"st-venant-kirchhoff\", young_modulus = \"1 MPa\", poisson_ratio = 0.3 }"},
      {"Holmes-Mow", "<E>1</E><v>0.2</v><beta>0.5</beta>",
       "{ law = \"holmes-mow\", young_modulus = \"1 MPa\", poisson_ratio = 0.2, beta = 0.5 }"},
      {"incomp neo-Hookean", "<G>3</G><k>100</k>",
       "{ law = \"mooney-rivlin\", c10 = \"1.5 MPa\", bulk_modulus = \"100 MPa\", volumetric = "
       "\"logarithmic\" }"},
      {"Mooney-Rivlin", "<c1>1</c1><c2>2</c2><k>100</k><pressure_model>2</pressure_model>",
       "{ law = \"mooney-rivlin\", c10 = \"1 MPa\", c01 = \"2 MPa\", bulk_modulus = \"100 MPa\", "
       "volumetric = \"quadratic\" }"},
      {"Veronda-Westmann", "<c1>1</c1><c2>2</c2><k>100</k>",
       "{ law = \"veronda-westmann\", c1 = \"1 MPa\", c2 = 2, bulk_modulus = \"100 MPa\", "
       "volumetric = \"logarithmic\" }"},
      {"Ogden", "<c1>1</c1><m1>2.5</m1><c2>0</c2><c3>3</c3><m3>-2</m3><k>100</k>",
       "{ law = \"ogden\", terms = [{ c = \"1 MPa\", m = 2.5 }, { c = \"3 MPa\", m = -2 }], "
       "bulk_modulus = \"100 MPa\", volumetric = \"logarithmic\" }"},
      {"trans iso Mooney-Rivlin",
       "<c1>1</c1><c2>0</c2><c3>3</c3><c4>4</c4><c5>5</c5><lam_max>1.05</lam_max><k>100</k>"
       "<fiber type=\"vector\">0,0,1</fiber>",
       "{ law = \"transversely-isotropic\", c10 = \"1 MPa\", c01 = \"0 MPa\", c3 = \"3 MPa\", c4 = "
       "4, c5 = \"5 MPa\", toe_end = 1.05, bulk_modulus = \"100 MPa\", volumetric = "
       "\"logarithmic\", fibres = { direction = [0, 0, 1] } }"},
      {"muscle material",
       "<g1>1</g1><g2>2</g2><p1>0.05</p1><p2>6.6</p2><Lofl>1.1</Lofl><smax>0.3</smax>"
       "<lam_max>1.54</lam_max><k>100</k>",
       "{ law = \"muscle\", max_stress = \"0.3 MPa\", p1 = 0.05, p2 = 6.6, toe_end = 1.4, "
       "optimal_stretch = 1.1, shear_along = \"1 MPa\", shear_across = \"2 MPa\", bulk_modulus = "
       "\"100 MPa\", volumetric = \"logarithmic\", fibres = { direction = [1, 0, 0] } }"},
      // The stress of FEBio's law is what is left at last; here the law has all of it.
      {"uncoupled viscoelastic",
       "<g1>3</g1><t1>0.05</t1><elastic "
       "type=\"Mooney-Rivlin\"><c1>1</c1><c2>0</c2><k>9</k></elastic>",
       "{ law = \"mooney-rivlin\", c10 = \"4 MPa\", c01 = \"0 MPa\", bulk_modulus = \"9 MPa\", "
       "volumetric = \"logarithmic\", relaxation = [{ weight = 0.75, time = \"0.05 s\" }] }"}};
  for (const MappedLaw& law : laws) {
    const Translated result = translated(law.type, law.constants);
    EXPECT_EQ(result.table, law.table);
    EXPECT_TRUE(result.losses.empty()) << law.type;
  }
}

TEST(Import, WhatOfAMaterialHasNoCounterpartIsTold) {
  const MappedLaw laws[] = {
      {"biphasic", "", "no law here is the same"},
      {"neo-Hookean", "<E>1</E>", "it has no constant `v`"},
      {"neo-Hookean", "<E type=\"map\">young</E><v>0.3</v>", "`E` varies in space or time"},
      {"Mooney-Rivlin", "<c1>1</c1><c2>2</c2><k>100</k><pressure_model>1</pressure_model>",
       "pressure_model"},
      {"Mooney-Rivlin", "<c1>1</c1><c2>2</c2><k>100</k><laugon>1</laugon>", "incompressibility"},
      {"neo-Hookean", "<E>1</E><v>0.3</v><prestress>5</prestress>", "`prestress` of the material"},
      {"neo-Hookean", "<E>1</E><E>2</E><v>0.3</v><mat_axis type=\"vector\"/>", "`E` of the"},
      {"Mooney-Rivlin", "<c1>1</c1><k>100</k><prestrain type=\"in-situ\"/>", "`prestrain` of"},
      {"trans iso Mooney-Rivlin",
       "<c1>1</c1><c3>3</c3><c4>4</c4><c5>5</c5><lam_max>1.05</lam_max><k>100</k>"
       "<fiber type=\"local\">1,2</fiber>",
       "its fibres are not one direction"}};
  for (const MappedLaw& law : laws) {
    const Translated result = translated(law.type, law.constants);
    ASSERT_EQ(result.losses.size(), 1U) << law.type;
    EXPECT_NE(result.losses[0].what.find(law.table), std::string::npos) << result.losses[0].what;
  }
  EXPECT_EQ(
      translated("uncoupled viscoelastic",
                 "<g1>3</g1><elastic type=\"Mooney-Rivlin\"><c1>1</c1><k>9</k></elastic>", false)
          .losses.size(),
      1U);
}

struct ChangedModel {
  const char *from, *to;
  int exit_code;
  const char* message;
};

void expect_messages(const std::string& name, const std::vector<ChangedModel>& changes) {
  const std::string model = content(kModels + name);
  const TemporaryFolder folder;
  for (const ChangedModel& change : changes) {
    std::string text = model;
    const std::size_t at = text.find(change.from);
    ASSERT_NE(at, std::string::npos) << change.from;
    folder.file("model.feb", text.replace(at, std::string(change.from).size(), change.to));
    const ProgramResult result = run_program(folder, "import model.feb -o scene");
    EXPECT_EQ(result.exit_code, change.exit_code) << result.err;
    EXPECT_NE(result.err.find(change.message), std::string::npos) << result.err;
  }
}

TEST(Import, WhatIsWrongOrMissingIsNamedWithItsLine) {
  expect_messages(
      "stretch.feb",
      {{"<units>mm-N-s</units>", "", 2, "model.feb: the model does not say its units"},
       {"<units>mm-N-s</units>", "<units>imperial</units>", 2,
        "unknown system of units `imperial`"},
       {"type=\"solid\"", "type=\"biphasic\"", 2,
        "model.feb:3: the model is of the module \"biphasic\""},
       {"version=\"4.0\"", "version=\"1.2\"", 2, "model.feb:2: found version `1.2`"},
       {"node_set=\"bottom\"", "node_set=\"nothing\"", 2, "there is no set `nothing`; it has"},
       {"lc=\"1\"", "lc=\"7\"", 2, "there is no load curve `7`"},
       {"type=\"neo-Hookean\"", "type=\"perfect\"", 2, "nothing can be taken over: line 5"},
       {"<v>0.4</v>", "<v>0.5</v>", 2, "Poisson's ratio must lie between"},
       {"<interpolate>LINEAR", "<interpolate>SMOOTH", 3,
        "interpolation \"smooth\" of load curve 1"},
       {"<x_dof>1</x_dof><y_dof>1</y_dof><z_dof>0</z_dof></bc>", "<x_dof>1</x_dof></bc>", 0, ""},
       {"</Boundary>", "</Boundary><Discrete><spring/></Discrete>", 3, "not taken over: <spring>"},
       {"</febio_spec>", "", 2, "not readable as .feb"}});
}

TEST(Import, ADisplacementAlongOneAxisThatCanNotBeTakenOverIsNamedWithItsReason) {
  const std::string lost = "not taken over: the prescribed displacement of `top` along z: ";
  const std::string at_start = lost + "it is not 0 at the start",
                    twice = lost + "some of the nodes are held or moved along it by another";
  expect_messages(
      "uniaxial.feb",
      {{"<pt>0,0</pt>", "<pt>0,0.5</pt>", 3, at_start.c_str()},
       {"</Boundary>",
        "<bc type=\"zero displacement\" node_set=\"left\"><z_dof>1</z_dof></bc></Boundary>", 3,
        twice.c_str()},
       {"node_set=\"left\"><x_dof>1</x_dof><y_dof>0</y_dof><z_dof>0</z_dof>",
        "node_set=\"left\"><x_dof>1</x_dof><y_dof>0</y_dof><z_dof>1</z_dof>", 3,
        "not taken over: the held nodes of `left` along z: some of them are moved along it"}});
}

// Two blocks of one material that share a face are one body; a rigid part that shares one holds it.
TEST(Import, PartsThatShareNodesAreJoined) {
  const TemporaryFolder folder;
  std::string nodes, elements;
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 4; ++c)
      nodes += "<node id=\"" + std::to_string(4 * k + c + 1) + "\">" +
               (c == 1 || c == 2 ? "1" : "0") + "," + (c > 1 ? "1" : "0") + "," +
               std::to_string(k) + "</node>";
  for (int e = 0; e < 3; ++e) {
    std::string list;
    for (int a = 1; a <= 8; ++a) list += (a > 1 ? "," : "") + std::to_string(4 * e + a);
    elements += "<Elements type=\"hex8\" name=\"part" + std::to_string(e) + "\"><elem id=\"" +
                std::to_string(e + 1) + "\">" + list + "</elem></Elements>";
  }
  folder.file(
      "model.feb",
      "<febio_spec version=\"4.0\"><Module type=\"solid\"><units>SI</units></Module><Material>"
      "<material id=\"1\" name=\"soft\" type=\"neo-Hookean\"><E>1</E><v>0.3</v></material>"
      "<material id=\"2\" name=\"bone\" type=\"rigid body\"/></Material><Mesh><Nodes>" +
          nodes + "</Nodes>" + elements +
          "</Mesh><MeshDomains><SolidDomain name=\"part0\" mat=\"bone\"/>"
          "<SolidDomain name=\"part1\" mat=\"soft\"/><SolidDomain name=\"part2\" mat=\"soft\"/>"
          "</MeshDomains><Rigid><rigid_bc type=\"rigid_fixed\"><rb>bone</rb><Rx_dof>1</Rx_dof>"
          "<Ry_dof>1</Ry_dof><Rz_dof>1</Rz_dof></rigid_bc></Rigid></febio_spec>");
  const ProgramResult result = run_program(folder, "import model.feb -o scene");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string scene = content(folder / "scene/model.toml");
  EXPECT_NE(scene.find("part = [\"part1\", \"part2\"]"), std::string::npos) << scene;
  EXPECT_NE(scene.find("body = \"part1\"\nto = \"bone\"\nregion = { set = \"part0\" }"),
            std::string::npos)
      << scene;
  EXPECT_NE(scene.find("hold = { freedoms = [\"translation.x\", \"translation.y\", "
                       "\"translation.z\"], at = \"0.5 0.5 0.5 m\" }"),
            std::string::npos)
      << scene;
  const ProgramResult check = run_program(folder, "check scene/model.toml");
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("4 of 12 nodes"), std::string::npos) << check.out;
}

}  // namespace articular::import_test
