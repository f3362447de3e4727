// One case for each kind of mistake in a scenario: the place and the whole message.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::scenario_error_test {

/// A scenario with a mistake behind the mark `@`, which is not part of the text.
struct Mistake {
  const char* name;
  std::string text;
  std::string message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class ScenarioErrors : public ScenarioTest, public ::testing::WithParamInterface<Mistake> {};

TEST_P(ScenarioErrors, NameThePlaceAndWhatWasExpected) {
  std::string text = GetParam().text;
  const std::size_t mark = text.find('@');
  ASSERT_NE(mark, std::string::npos);
  text.erase(mark, 1);
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark), '\n');
  const std::size_t line_start = mark == 0 ? std::string::npos : text.rfind('\n', mark - 1);
  const std::size_t column = mark - (line_start == std::string::npos ? 0 : line_start + 1) + 1;
  EXPECT_EQ(refusal(text), "jaw.toml:" + std::to_string(line) + ":" + std::to_string(column) +
                               ": " + GetParam().message);
}

std::string test_name(const ::testing::TestParamInfo<Mistake>& info) { return info.param.name; }

std::string body(const std::string& rest) { return kStart + "[[body]]\nname = \"extra\"\n" + rest; }
std::string tissue(const std::string& rest) {
  return body("kind = \"tissue\"\nmesh = { file = \"a.vtu\" }\n" + rest);
}
const std::string kElastic = "young_modulus = \"1 Pa\", poisson_ratio = 0.3";
const std::string kCollagen =
    "c10 = \"1 Pa\", c3 = \"1 Pa\", c4 = 10, c5 = \"1 Pa\", toe_end = 1.1, bulk_modulus = \"1 "
    "Pa\", fibres = { direction = [1, 0, 0] }";

/// A tissue of a law. @param mark  "@" where the whole table is the place of the mistake
std::string law(const std::string& name, const std::string& rest, const std::string& mark = "") {
  return tissue("density = \"1 g/cm^3\"\nmaterial = " + mark + "{ law = \"" + name + "\", " + rest +
                " }\n");
}
std::string material(const std::string& rest) {
  return tissue("density = \"1 g/cm^3\"\nmaterial = { law = \"linear\", " + rest + " }\n");
}
std::string geometry(const std::string& rest) {
  return body("kind = \"tissue\"\ngeometry = { " + rest + " }\n");
}
std::string rigid(const std::string& rest) {
  return body("kind = \"rigid\"\nmesh = { file = \"a.vtp\" }\n" + rest);
}
std::string path(const std::string& points) {
  return kStart + "[[muscle]]\nname = \"temporalis\"\nmax_force = \"1 N\"\npath = " + points + "\n";
}
const std::string kPath =
    "path = [{ body = \"skull\", point = \"0 0 0 m\" }, { body = \"mandible\", point = \"0 0 1 m\" "
    "}]\n";
std::string muscle(const std::string& rest) {
  return kStart + "[[muscle]]\nname = \"temporalis\"\n" + kPath + "max_force = \"1 N\"\n" + rest;
}
std::string ligament(const std::string& rest) {
  return kStart + "[[ligament]]\nname = \"capsule\"\n" + kPath + rest;
}
std::string bolus(const std::string& rest) {
  return kStart + "[[bolus]]\nname = \"nut\"\n" + kPath + rest;
}
std::string motion(const std::string& rest) {
  return kStart + "[[load]]\nkind = \"motion\"\nbody = \"stand\"\n" + rest;
}

INSTANTIATE_TEST_SUITE_P(
    Toml, ScenarioErrors,
    ::testing::Values(
        Mistake{"NotToml", "duration = @= 3\n",
                "not valid TOML: Error while parsing value: could not determine value type"},
        Mistake{"UnknownKey", "@duraton = \"1 s\"\n" + kBodies,
                "scenario: unknown key `duraton`; did you mean `duration`?"},
        Mistake{"UnknownKeyInAnEntry", tissue("@densitty = \"1 g/cm^3\"\n"),
                "body `extra`: unknown key `densitty`; did you mean `density`?"},
        Mistake{"UnknownKeyFarFromAny", "duration = \"1 s\"\n[detection]\n@colour = 1\n" + kBodies,
                "[detection]: unknown key `colour`; expected `tree`"},
        Mistake{
            "ResponseOfStatics",
            "analysis = \"static\"\nduration = \"1 s\"\n@contact_response = \"pointwise\"\n" +
                kBodies,
            "scenario: `contact_response` does not belong here: a static analysis averages depths"},
        Mistake{"AccuracyOfStatics",
                "analysis = \"static\"\nduration = \"1 s\"\n@accuracy = \"fast\"\n" + kBodies,
                "scenario: `accuracy` does not belong here: it is about motion in time, and the "
                "analysis is static"},
        Mistake{"ToleranceOfStatics",
                "analysis = \"static\"\nduration = \"1 s\"\n[integrator]\n@position_tolerance = "
                "\"1 um\"\n" +
                    kBodies,
                "[integrator]: `position_tolerance` does not belong here: a static analysis has no "
                "time integration: it goes on until the forces balance"},
        Mistake{"SettingBelowATable", kBodies + "[output]\n@duration = \"1 s\"\n",
                "`duration` is no key of [output] but of the scenario: expected it above the first "
                "[table] of the file"},
        Mistake{"SettingBelowAnEntry",
                kStart + "[[body]]\nname = \"extra\"\n@analysis = "
                         "\"static\"\n",
                "`analysis` is no key of [[body]] but of the scenario: expected it above the first "
                "[table] of the file"},
        Mistake{"MissingKey", "@title = \"x\"\n" + kBodies, "scenario: `duration` is missing"},
        Mistake{"MissingKeyInAnEntry", kStart + "@[[body]]\nname = \"extra\"\n",
                "body `extra`: `kind` is missing"},
        Mistake{"WrongType", "duration = @false\n" + kBodies,
                "`duration`: expected a time such as \"0.6 s\", found false"},
        Mistake{"TextExpected", "title = @3\n" + kStart,
                "`title`: expected text in quotes, found the number 3"},
        Mistake{"DateFound", "title = @1979-05-27\n" + kStart,
                "`title`: expected text in quotes, found a date or time of day"},
        Mistake{"SingleTable", "duration = \"1 s\"\n@[body]\nname = \"a\"\n",
                "`body`: expected entries that start with [[body]], found a table"},
        Mistake{
            "TableExpected", body("kind = \"fixed\"\nmesh = @\"skull.vtp\"\n"),
            "`mesh`: expected a table of file, unit, part, place, made_by, found \"skull.vtp\""},
        Mistake{"NoBodies", "@duration = \"1 s\"\n", "the scenario has no [[body]]"},
        Mistake{"MultiLineText", "duration = @\"\"\"1\ns\"\"\"\n" + kBodies,
                "`duration`: expected a time such as \"0.6 s\", found \"1\\ns\" (cannot read "
                "\"\\ns\")"}),
    test_name);

std::string choice(const std::string& word, const std::string& when) {
  return "duration = \"1 s\"\n[choice]\n" + word + "\n" + kBodies + "when = " + when + "\n";
}

INSTANTIATE_TEST_SUITE_P(
    Choice, ScenarioErrors,
    ::testing::Values(
        Mistake{"WordThatNobodyMentions",
                choice("disc = @\"tisue\"", "{ disc = [\"tissue\", \"rigid\"] }"),
                "`disc`: no `when` mentions this word; expected one of \"off\", \"rigid\", "
                "\"tissue\", found \"tisue\""},
        Mistake{"ChoiceThatNobodyMentions",
                choice("disc = \"rigid\"\n@dics = \"rigid\"", "{ disc = \"rigid\" }"),
                "no `when` mentions the choice `dics`; expected `disc`"},
        Mistake{"UnknownChoice", choice("disc = \"rigid\"", "{ @disk = \"rigid\" }"),
                "`when`: there is no choice `disk`; did you mean `disc`?"},
        Mistake{"WithoutChoices", kStart + "when = { @disc = \"rigid\" }\n",
                "`when`: there is no choice `disc`; expected it in [choice], which the scenario "
                "does not have"},
        Mistake{"WhenIsNoTable", choice("disc = \"rigid\"", "@\"rigid\""),
                "`when`: expected a table of choices such as { disc = \"tissue\" }, found "
                "\"rigid\""},
        Mistake{"WhenIsEmpty", choice("disc = \"rigid\"", "@{}"),
                "`when`: expected a table of choices such as { disc = \"tissue\" }, found an empty "
                "one"},
        Mistake{"WordIsANumber", choice("disc = \"rigid\"", "{ disc = @3 }"),
                "`disc`: expected a word, or a list of words, found the number 3"},
        Mistake{"ChosenWordIsANumber", choice("disc = @3", "{ disc = \"rigid\" }"),
                "`disc`: expected text in quotes, found the number 3"},
        Mistake{"ChoiceIsNoTable", "choice = @\"rigid\"\n" + kStart,
                "`choice`: expected a table [choice] of words, found \"rigid\""},
        Mistake{"WhenOfATable", kStart + "[output]\n@when = { disc = \"rigid\" }\n",
                "[output]: unknown key `when`; expected one of `interval`, `length_unit`, "
                "`directory`, `frames`, `contact_surfaces`, `checkpoint_interval`, `directions`"},
        Mistake{"TwoDirectionsToASide",
                kStart + "[output]\ndirections = @[\"left\", \"medial\", \"superior\"]\n",
                "`directions`: expected one direction to a side, one to the front or back, and one "
                "up or down"},
        Mistake{"DirectionsOfAMirrorImage",
                kStart + "[output]\ndirections = @[\"right\", \"posterior\", \"superior\"]\n",
                "`directions`: expected a body that is no mirror image: with these directions left "
                "and right are exchanged"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Values, ScenarioErrors,
    ::testing::Values(
        Mistake{"BareNumber", material("young_modulus = @15, poisson_ratio = 0"),
                "`young_modulus`: expected a quantity with its unit, such as \"15 kPa\", found the "
                "number 15"},
        Mistake{
            "WrongUnit", material("young_modulus = @\"15 mm\", poisson_ratio = 0"),
            "`young_modulus`: expected a stress such as \"15 kPa\", found \"15 mm\" (a length)"},
        Mistake{"NegativeDensity",
                tissue("density = @\"-1 g/cm^3\"\nmaterial = { law = \"linear\", "
                       "young_modulus = \"1 Pa\", poisson_ratio = 0 }\n"),
                "`density` must be positive, found \"-1 g/cm^3\""},
        Mistake{"ZeroModulus", material("young_modulus = @\"0 Pa\", poisson_ratio = 0"),
                "`young_modulus` must be positive, found \"0 Pa\""},
        Mistake{"PoissonRatio", material("young_modulus = \"1 Pa\", poisson_ratio = @0.5"),
                "Poisson's ratio must lie between -1 and 0.5 (exclusive), found 0.5"},
        Mistake{"PoissonRatioNan", material("young_modulus = \"1 Pa\", poisson_ratio = @nan"),
                "Poisson's ratio must be finite, found nan"},
        Mistake{"RelaxationOfALinearLaw",
                material("young_modulus = \"1 Pa\", poisson_ratio = 0.3, @relaxation = "
                         "[{ weight = 0.3, time = \"1 s\" }]"),
                "material: `relaxation` does not belong here: the law is \"linear\""},
        Mistake{"RelaxationOfAllStress",
                tissue("density = \"1 t/m^3\"\nmaterial = { law = \"corotated\", young_modulus = "
                       "\"1 Pa\", poisson_ratio = 0.3, relaxation = @[{ weight = 0.3, time = "
                       "\"1 s\" }, { weight = 0.8, time = \"2 s\" }] }\n"),
                "`relaxation`: the weights sum up to 1.1, which must be below 1: nothing would "
                "be left of the stress"},
        Mistake{
            "MisspeltLaw",
            tissue("density = \"1 t/m^3\"\nmaterial = { @lw = \"linear\", poisson_ratio = 0 }\n"),
            "material: unknown key `lw`; did you mean `law`?"},
        Mistake{"BetaOfAnotherLaw", law("st-venant-kirchhoff", kElastic + ", @beta = 2"),
                "material: `beta` does not belong here: the law is \"st-venant-kirchhoff\""},
        Mistake{"BetaIsMissing", law("holmes-mow", kElastic, "@"), "material: `beta` is missing"},
        Mistake{
            "HolmesMowThatSoftens",
            law("holmes-mow", "young_modulus = \"1 Pa\", poisson_ratio = @0.4, beta = 1"),
            "Poisson's ratio of the law \"holmes-mow\" must lie between 0 and 1/3 (others soften "
            "in tension), found 0.4"},
        Mistake{"VolumetricOfACoupledLaw",
                law("coupled-neo-hookean", kElastic + ", @volumetric = \"logarithmic\""),
                "material: `volumetric` does not belong here: the law is \"coupled-neo-hookean\""},
        Mistake{"OgdenWithoutTerms", law("ogden", "terms = @[], bulk_modulus = \"1 kPa\""),
                "`terms`: expected a list of terms such as [{ c = \"10 kPa\", m = 2.5 }, ...], "
                "found a list of 0"},
        Mistake{"OgdenExponentOfZero",
                law("ogden", "terms = [{ c = \"1 kPa\", m = @0 }], bulk_modulus = \"1 kPa\""),
                "`m`: m is 0, must be finite and 0.01 or more away from 0"},
        Mistake{"OgdenNegativeConstant",
                law("ogden", "terms = [{ c = @\"-1 kPa\", m = 2 }], bulk_modulus = \"1 kPa\""),
                "`c` must be positive, found \"-1 kPa\""},
        Mistake{"OgdenUnknownKey",
                law("ogden", "terms = [{ c = \"1 kPa\", @alpha = 2 }], bulk_modulus = \"1 kPa\""),
                "term of `terms`: unknown key `alpha`; expected one of `c`, `m`"},
        Mistake{"ForceLengthWithoutActiveStress",
                law("transversely-isotropic", kCollagen + ", @force_length = {}"),
                "material: `force_length` does not belong here: without `active_stress` there is "
                "nothing that depends on it"},
        Mistake{"PrestretchAsPercent",
                law("transversely-isotropic", kCollagen + ", prestretch = @3"),
                "`prestretch` must lie between 0.5 and 2: fibres that are drawn out by 3 % have "
                "1.03, found 3"},
        Mistake{"ForceLengthUnit",
                law("transversely-isotropic",
                    kCollagen + ", active_stress = \"1 kPa\", force_length = { b = @\"4 um\" }"),
                "`b`: expected one over a length such as \"4.75 1/um\", found \"4 um\" (a length)"},
        Mistake{"MoreCalciumThanTheMost",
                law("transversely-isotropic",
                    kCollagen + ", active_stress = \"1 kPa\", force_length = @{ calcium = 5 }"),
                "`force_length`: calcium is 5 umol/l, must be at most the largest calcium, 4.35 "
                "umol/l"},
        Mistake{"PoissonRatioText", material("young_modulus = \"1 Pa\", poisson_ratio = @\"0.3\""),
                "`poisson_ratio`: expected a number without unit or quotes, found \"0.3\""},
        Mistake{"UnknownLaw",
                tissue("density = \"1 t/m^3\"\nmaterial = { law = @\"neohookean\", young_modulus = "
                       "\"1 Pa\", "
                       "poisson_ratio = 0 }\n"),
                "`law`: expected one of \"linear\", \"corotated\", \"st-venant-kirchhoff\", "
                "\"neo-hookean\", \"coupled-neo-hookean\", \"holmes-mow\", "
                "\"isochoric-neo-hookean\", \"mooney-rivlin\", \"yeoh\", \"ogden\", "
                "\"veronda-westmann\", \"transversely-isotropic\", \"muscle\", found "
                "\"neohookean\"; did you mean "
                "\"neo-hookean\"?"},

        Mistake{"InfiniteTime", "duration = @\"inf s\"\n" + kBodies,
                "`duration`: expected a time such as \"0.6 s\", found \"inf s\" (not finite)"},
        Mistake{"VectorAsList", rigid("mass = \"1 kg\"\nvelocity = @[1, 0, 0]\n"),
                "`velocity`: expected a velocity as three numbers and one unit in quotes, such as "
                "\"0 0 5 mm/s\", "
                "found a list of 3"},
        Mistake{"Inertia", rigid("mass = \"1 kg\"\ninertia = @[\"1 2 9 kg m^2\"]\n"),
                "`inertia`: not the inertia of a body: its principal moments 1, 2 and 9 kg m^2 "
                "must be positive "
                "and none larger than the sum of the others"},
        Mistake{"LengthUnit",
                body("kind = \"fixed\"\nmesh = { file = \"a.vtp\", unit = @\"kg\" }\n"),
                "`unit`: expected the unit of a length such as \"mm\", found \"kg\" (a mass)"},
        Mistake{
            "Facing",
            body("kind = \"fixed\"\ncontact_meshes = [{ file = \"a\", facing = @[0, 0, 0] }]\n"),
            "`facing`: a direction must have a length"},
        Mistake{
            "ContinuedWithoutLength",
            body("kind = \"fixed\"\ncontact_meshes = [{ file = \"a\", continued = @{ at = \"0 0 "
                 "0 mm\", direction = [1, 0, 0] } }]\n"),
            "continued: `length` is missing"},
        Mistake{"NoCells", geometry("box = { size = \"1 1 1 m\", cells = [4, @0, 4] }"),
                "`cells[1]`: expected a whole number from 1 to 10000, found the number 0"},
        Mistake{"FlatBox", geometry("box = { size = @\"1 0 1 m\", cells = [4, 4, 4] }"),
                "`size`: the three edges must be positive, found \"1 0 1 m\""},
        Mistake{"CoarseSphere",
                geometry("sphere = { radius = \"1 mm\", element_size = @\"2 mm\" }"),
                "`element_size`: must not exceed the radius, found \"2 mm\""},
        Mistake{"HexahedronInsideOut",
                geometry("hexahedron = { corners = [@\"0 0 0 mm\", \"0 1 0 mm\", \"1 1 0 mm\", "
                         "\"1 0 0 mm\", \"0 0 1 mm\", \"0 1 1 mm\", \"1 1 1 mm\", \"1 0 1 mm\"], "
                         "cells = [1, 1, 1] }"),
                "`corners[0]`: the block is flat or turned inside out at this corner; expected the "
                "corners of the lower face, counterclockwise as seen from above, then those of the "
                "upper face above them"},
        Mistake{"OpenShape",
                geometry("v_shape = { leg_length = \"1 m\", width = \"1 m\", angle = @\"180 deg\", "
                         "cells = [1, 1] }"),
                "`angle` must lie between 0 and 180 deg, found \"180 deg\""},
        Mistake{"Variable",
                body("kind = \"fixed\"\nmesh = { file = @\"${ARTICULAR_NOT_SET}/a.vtp\" }\n"),
                "`file`: ${ARTICULAR_NOT_SET} is not set in the environment; set ARTICULAR_NOT_SET "
                "to the folder "
                "that holds the data"},
        Mistake{"OpenVariable", body("kind = \"fixed\"\nmesh = { file = @\"${DATA/a.vtp\" }\n"),
                "`file`: `}` is missing after `${` in \"${DATA/a.vtp\""}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Names, ScenarioErrors,
    ::testing::Values(
        Mistake{"EmptyName", kStart + "[[body]]\nname = @\"\"\n",
                "`name`: expected text, found an empty string"},
        Mistake{"ResultsAtAnAbsolutePath", kStart + "[output]\ndirectory = @\"/home/you\"\n",
                "`directory`: expected a folder within the working folder, found \"/home/you\"; "
                "give another one as --out"},
        Mistake{"ResultsAbove", kStart + "[output]\ndirectory = @\"out/../../you\"\n",
                "`directory`: expected a folder within the working folder, found "
                "\"out/../../you\"; give another one as --out"},
        Mistake{"NameWithSlash", kStart + "[[body]]\nname = @\"../x\"\n",
                "`name`: expected a name of letters, digits, `_`, `-` and inner spaces, found "
                "\"../x\""},
        Mistake{"ReservedName", kStart + "[[body]]\nname = @\"lines\"\nkind = \"fixed\"\n",
                "`name`: a body cannot be called `lines`; results use that name"},
        Mistake{"NameOfAContactSurface",
                kStart + "[output]\ncontact_surfaces = true\n@[[body]]\n"
                         "name = \"skull_contact\"\nkind = \"fixed\"\n",
                "body `skull_contact` has the name of the contact surface of `skull` in the "
                "results; expected another name, or no output.contact_surfaces"},
        Mistake{"SecondBody", kStart + "[[body]]\nname = @\"skull\"\nkind = \"fixed\"\n",
                "`name`: a second body is called `skull`, the first is at jaw.toml:3"},
        Mistake{"SecondMuscle",
                muscle("[[muscle]]\nname = @\"temporalis\"\n" + kPath + "max_force = \"1 N\"\n"),
                "`name`: a second muscle is called `temporalis`, the first is at jaw.toml:21"},
        Mistake{
            "LigamentCalledAsAMuscle",
            muscle("[[ligament]]\nname = @\"temporalis\"\n" + kPath + "stiffness = \"1 N/m\"\n"),
            "`name`: a second line (muscle or ligament) is called `temporalis`, the first is at "
            "jaw.toml:21"},
        Mistake{"SecondProbe",
                kStart + "[[probe]]\nname = \"e\"\nkind = \"energy\"\n[[probe]]\nname = "
                         "@\"e\"\nkind = \"energy\"\n",
                "`name`: a second probe is called `e`, the first is at jaw.toml:21"},
        Mistake{"UnknownBody",
                kStart + "[[attach]]\nbody = @\"disk_left\"\nto = \"skull\"\nregion = {}\n",
                "`body`: no body is called `disk_left`; did you mean `disc_left`?"},
        Mistake{"UnknownBodyInARegion",
                kStart + "[[attach]]\nbody = \"disc_left\"\nto = \"skull\"\nregion = { near = { "
                         "body = @\"scull\", "
                         "distance = \"1 mm\" } }\n",
                "`body`: no body is called `scull`; did you mean `skull`?"},
        Mistake{
            "UnknownMirrorImage",
            kStart +
                "[[attach]]\nmirror = \"x\"\nbody = @\"disc_left\"\nto = \"skull\"\nregion = {}\n",
            "`body`: no body is called `disc_right` (mirror image of `disc_left`); expected one of "
            "`skull`, "
            "`mandible`, `disc_left`, `stand`"},
        Mistake{
            "UnknownLine",
            muscle("[[probe]]\nname = \"p\"\nkind = \"line\"\nline = @\"temporalus\"\n"),
            "`line`: no muscle or ligament is called `temporalus`; did you mean `temporalis`?"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Bodies, ScenarioErrors,
    ::testing::Values(
        Mistake{"TissueWithoutMaterial",
                kStart +
                    "@[[body]]\nname = \"extra\"\nkind = \"tissue\"\nmesh = { file = \"a.vtu\" }\n"
                    "density = \"1 g/cm^3\"\n",
                "body `extra`: `material` is missing"},
        Mistake{"TissueWithMass", tissue("@mass = \"1 kg\"\n"),
                "body `extra`: `mass` does not belong here: tissue has a density instead"},
        Mistake{"FixedWithDensity", body("kind = \"fixed\"\n@density = \"1 g/cm^3\"\n"),
                "body `extra`: `density` does not belong here: a fixed body has no inertia"},
        Mistake{"FixedWithVelocity", body("kind = \"fixed\"\n@velocity = \"0 0 1 m/s\"\n"),
                "body `extra`: `velocity` does not belong here: a fixed body has no velocity; a "
                "[[load]] of kind "
                "\"motion\" moves it"},
        Mistake{"RigidWithoutMesh",
                kStart + "@[[body]]\nname = \"extra\"\nkind = \"rigid\"\nmass = \"1 kg\"\n",
                "body `extra`: expected `mesh` or `geometry`, found none of them"},
        Mistake{"RigidWithMassAndDensity", rigid("density = \"1 t/m^3\"\n@mass = \"1 kg\"\n"),
                "body `extra`: `density` and `mass` exclude each other"},
        Mistake{"RigidWithMaterial",
                rigid("mass = \"1 kg\"\n@material = { law = \"linear\", young_modulus = \"1 Pa\", "
                      "poisson_ratio = 0 }\n"),
                "body `extra`: `material` does not belong here: only tissue has a material"},
        Mistake{"MeshAndGeometry",
                body("kind = \"tissue\"\ngeometry = { sphere = { radius = \"1 m\", element_size = "
                     "\"1 m\" } }\n"
                     "@mesh = { file = \"a\" }\n"),
                "body `extra`: `geometry` and `mesh` exclude each other"},
        Mistake{"NoGeometry", body("kind = \"tissue\"\ngeometry = @{ }\n"),
                "geometry: expected `box` or `hexahedron` or `sphere` or `v_shape`, found none of "
                "them"},
        Mistake{"AttachToTissue",
                kStart + "[[attach]]\nbody = \"disc_left\"\nto = @\"disc_left\"\nregion = {}\n",
                "`to`: expected a fixed or rigid body to attach to, body `disc_left` is tissue"},
        Mistake{"AttachOfBone",
                kStart + "[[attach]]\nbody = @\"mandible\"\nto = \"skull\"\nregion = {}\n",
                "`body`: only tissue can be attached, and body `mandible` is none"},
        Mistake{"CornersSwapped",
                kStart + "[[attach]]\nbody = \"disc_left\"\nto = \"skull\"\nregion = { box = @[\"1 "
                         "1 1 mm\", \"0 2 2 "
                         "mm\"] }\n",
                "`box`: expected the lower corner first: each coordinate of \"1 1 1 mm\" must not "
                "exceed that of \"0 "
                "2 2 mm\""},
        Mistake{"NearABodyWithoutSurface",
                kStart + "[[attach]]\nbody = \"disc_left\"\nto = \"skull\"\nregion = { near = { "
                         "body = @\"stand\", "
                         "distance = \"1 mm\" } }\n",
                "`body`: body `stand` has no surface"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    Lines, ScenarioErrors,
    ::testing::Values(
        Mistake{"NoInsertion", path("@[{ body = \"skull\", point = \"0 0 0 m\" }]"),
                "`path`: muscle `temporalis` has no insertion: its path needs at least two points"},
        Mistake{"NoLength",
                path("@[{ body = \"skull\", point = \"0 0 1 m\" }, { body = \"mandible\", point = "
                     "\"0 0 1 m\" }]"),
                "`path`: the path of muscle `temporalis` has no length"},
        Mistake{"WrapAroundNothing", muscle("wrap = [@\"skul\"]\n"),
                "`wrap[0]`: no body is called `skul`; did you mean `skull`?"},
        Mistake{"WrapTwice", muscle("wrap = [\"skull\", @\"skull\"]\n"),
                "`wrap[1]`: body `skull` is named twice"},
        Mistake{
            "WrapAroundTissue",
            tissue("density = \"1 g/cm^3\"\nmaterial = { law = \"linear\", " + kElastic + " }\n") +
                muscle("wrap = [@\"extra\"]\n").substr(kStart.size()),
            "`wrap[0]`: lines wrap around fixed and rigid bodies, body `extra` is tissue"},
        Mistake{"WrapProbeOfAStraightLine",
                muscle("[[probe]]\nname = \"p\"\nkind = \"wrap\"\nline = @\"temporalis\"\n"),
                "`line`: `temporalis` has no `wrap`"},
        Mistake{"ExtentProbeInTheFrameOfTissue",
                kStart +
                    "[[probe]]\nname = \"p\"\nkind = \"extent\"\nbody = \"disc_left\"\nframe = "
                    "@\"disc_left\"\npoint = \"0 0 0 mm\"\ndirection = [1, 0, 0]\n",
                "`frame`: expected a fixed or rigid body, body `disc_left` is tissue"},
        Mistake{"FibresProbeOfTissueWithout",
                kStart + "[[probe]]\nname = \"p\"\nkind = \"fibres\"\nbody = @\"disc_left\"\n",
                "`body`: expected a tissue with fibres, body `disc_left` has none"},
        Mistake{"VolumeProbeOfBone",
                kStart + "[[probe]]\nname = \"p\"\nkind = \"volume\"\nbody = @\"skull\"\n",
                "`body`: expected a tissue body, body `skull` is none"},
        Mistake{"SheetOnBone",
                kStart + "[[sheet]]\nname = \"s\"\nbody = @\"skull\"\nregion = {}\nthickness = \"1 "
                         "mm\"\nyoung_modulus = \"1 MPa\"\nfibres = { direction = [1, 0, 0] }\n",
                "`body`: a sheet lies on the surface of a tissue, and body `skull` is none"},
        Mistake{"SheetWithoutFibresOnTissueWithout",
                kStart + "@[[sheet]]\nname = \"s\"\nbody = \"disc_left\"\nregion = {}\nthickness = "
                         "\"1 mm\"\nyoung_modulus = \"1 MPa\"\n",
                "sheet `s`: tissue `disc_left` has no fibres whose direction the sheet could have; "
                "expected `fibres`"},
        Mistake{"SheetWithDensityOfFibres",
                kStart +
                    "[[sheet]]\nname = \"s\"\nbody = \"disc_left\"\nregion = {}\nthickness = \"1 "
                    "mm\"\nyoung_modulus = \"1 MPa\"\nfibres = { array = \"a\", @density = "
                    "\"conserved\" }\n",
                "fibres: unknown key `density`; expected one of `direction`, `array`, `from`, "
                "`to`"},
        Mistake{"SheetProbeOfNone",
                kStart + "[[probe]]\nname = \"p\"\nkind = \"sheet\"\nsheet = @\"fascia\"\n",
                "`sheet`: no [[sheet]] has the name `fascia`"},
        Mistake{"RadiusOnBone",
                path("[{ body = \"skull\", point = \"0 0 0 m\", radius = @\"1 mm\" }, { body = "
                     "\"mandible\", point = \"0 0 1 m\" }]"),
                "`radius`: a radius spreads a point over tissue, and body `skull` is none"},
        Mistake{
            "TissueBeyondItsMesh",
            path("[{ body = \"disc_left\", point = \"0 0 0 m\", beyond_mesh = @true }, { body = "
                 "\"mandible\", point = \"0 0 1 m\" }]"),
            "`beyond_mesh`: only a bone goes on beyond its mesh, and body `disc_left` is tissue"},
        Mistake{"ExcitationAboveOne",
                muscle("excitation = { time = [\"0 s\", \"1 s\"], value = [0, @1.1] }\n"),
                "`value[1]` must lie between 0 and 1, found 1.1"},
        Mistake{"UnequalLists",
                muscle("excitation = { time = [\"0 s\", \"1 s\"], value = @[0] }\n"),
                "`value`: expected as many values as times (2), found 1"},
        Mistake{"EmptyLists", muscle("excitation = { time = @[], value = [] }\n"),
                "`time`: expected a list of times such as [\"0 s\", \"0.3 s\"], found a list of 0"},
        Mistake{
            "TimesNotIncreasing",
            muscle(
                "excitation = { time = [\"0 s\", \"20 ms\", @\"0.02 s\"], value = [0, 0, 0] }\n"),
            "`time[2]`: times must increase, found \"0.02 s\" after \"20 ms\""},
        Mistake{
            "TendonRatio", muscle("tendon_ratio = @1\n"),
            "`tendon_ratio`: a tendon as long as the muscle leaves no fibers, found the number 1"},
        Mistake{"NegativeLengthBeyond", muscle("beyond = @\"-1 mm\"\n"),
                "`beyond` must not be negative, found \"-1 mm\""},
        Mistake{"LengthsBeyondForOtherTimes",
                muscle("beyond = { time = [\"0 s\", \"1 s\"], length = @[\"1 mm\"] }\n"),
                "`length`: expected as many lengths as times (2), found 1"},
        Mistake{"LengthBeyondWithoutForceLength",
                muscle("force_length = false\n@beyond = \"1 mm\"\n"),
                "muscle `temporalis`: `beyond` does not belong here: with force_length = false the "
                "force depends on activation alone"},
        Mistake{"MaxLengthRatio", muscle("max_length_ratio = @1.0\n"),
                "`max_length_ratio` must be greater than 1, found 1"},
        Mistake{"Mirror", ligament("mirror = @\"y\"\nstiffness = \"1 N/m\"\n"),
                "`mirror`: expected \"x\", found \"y\""},
        Mistake{"OwnMirrorImage",
                kStart +
                    "[[ligament]]\nname = \"capsule\"\nstiffness = \"1 N/m\"\nmirror = @\"x\"\n" +
                    "path = [{ body = \"skull\", point = \"0 0 9 mm\" }, { body = \"mandible\", "
                    "point = \"0 1 0 mm\" }]\n",
                "`mirror`: ligament `capsule` is its own mirror image, and would pull twice: "
                "expected it without `mirror`"},
        Mistake{"FromAPointToItsMirrorImage",
                kStart +
                    "[[ligament]]\nname = \"capsule\"\nstiffness = \"1 N/m\"\nmirror = @\"x\"\n" +
                    "path = [{ body = \"skull\", point = \"2 0 9 mm\" }, { body = \"skull\", "
                    "point = \"-2 0 9 mm\" }]\n",
                "`mirror`: ligament `capsule` is its own mirror image, and would pull twice: "
                "expected it without `mirror`"},
        Mistake{"NoStiffness", kStart + "@[[ligament]]\nname = \"capsule\"\n" + kPath,
                "ligament `capsule`: expected `stiffness` or `stiffness_per_strain`, found none of "
                "them"},
        Mistake{"SpeedWithoutForceLength",
                muscle("force_length = false\n@max_velocity = \"10 1/s\"\n"),
                "muscle `temporalis`: `max_velocity` does not belong here: with force_length = "
                "false the force depends on activation alone"},
        Mistake{"ToeOfALinearLigament", ligament("stiffness = \"1 N/m\"\n@toe_strain = 0.03\n"),
                "ligament `capsule`: `toe_strain` does not belong here: a ligament with "
                "`stiffness` is linear; "
                "`stiffness_per_strain` has a toe"},
        Mistake{"BolusOfOneDepth",
                bolus("depth = @[\"0 mm\"]\nforce = [\"0 N\"]\nunloading_stiffness = \"9 N/mm\"\n"),
                "`depth`: expected two or more depths, each larger than the one before"},
        Mistake{"BolusOfFallingDepths",
                bolus("depth = @[\"0 mm\", \"2 mm\", \"1 mm\"]\nforce = [\"0 N\", \"1 N\", \"2 "
                      "N\"]\nunloading_stiffness = \"9 N/mm\"\n"),
                "`depth`: expected two or more depths, each larger than the one before"},
        Mistake{"BolusForOtherDepths",
                bolus("depth = [\"0 mm\", \"2 mm\"]\nforce = @[\"0 N\"]\nunloading_stiffness = \"9 "
                      "N/mm\"\n"),
                "`force`: expected as many forces as depths (2), found 1"},
        Mistake{"BolusThatPushesAtOnce",
                bolus("depth = @[\"0 mm\", \"2 mm\"]\nforce = [\"1 N\", \"2 N\"]\n"
                      "unloading_stiffness = \"9 N/mm\"\n"),
                "`depth`: expected to begin with no depth and no force"},
        Mistake{"BolusThatGivesMoreThanItTook",
                bolus("depth = [\"0 mm\", \"2 mm\", \"3 mm\"]\nforce = [\"0 N\", \"1 N\", \"11 "
                      "N\"]\nunloading_stiffness = @\"9 N/mm\"\n"),
                "`unloading_stiffness`: less than the slope of `force` at a depth of 2 mm: the "
                "bolus would give back more than it took"},
        Mistake{"BolusThatGrowsStronger",
                bolus("depth = [\"0 mm\", \"2 mm\"]\nforce = [\"0 N\", \"2 "
                      "N\"]\nunloading_stiffness = \"9 N/mm\"\nforce_kept = @1.1\n"),
                "`force_kept` must lie between 0 and 1, found 1.1"},
        Mistake{"BolusAlongThreePoints",
                kStart + "[[bolus]]\nname = \"nut\"\npath = @[{ body = \"skull\", point = \"0 0 0 "
                         "m\" }, { body = \"mandible\", point = \"0 0 1 m\" }, { body = "
                         "\"mandible\", point = \"0 0 2 m\" }]\ndepth = [\"0 mm\", \"2 "
                         "mm\"]\nforce = [\"0 N\", \"2 N\"]\nunloading_stiffness = \"9 N/mm\"\n",
                "`path`: bolus `nut` lies between two points"},
        Mistake{
            "TwoSlacks",
            ligament("stiffness = \"1 N/m\"\nreference_strain = 0.02\n@slack_length = \"1 mm\"\n"),
            "ligament `capsule`: `reference_strain` and `slack_length` exclude each other"}),
    test_name);

INSTANTIATE_TEST_SUITE_P(
    LoadsContactsProbes, ScenarioErrors,
    ::testing::Values(
        Mistake{"LoadWithoutKind", kStart + "@[[load]]\nbody = \"skull\"\n",
                "[[load]]: `kind` is missing"},
        Mistake{"GravityWithForce",
                kStart + "[[load]]\nkind = \"gravity\"\nacceleration = \"0 0 -9.81 m/s^2\"\n@force "
                         "= \"0 0 1 N\"\n",
                "[[load]] of kind \"gravity\": `force` does not belong here: the load is of kind "
                "\"gravity\""},
        Mistake{"ForceOnFixed",
                kStart + "[[load]]\nkind = \"force\"\nbody = @\"skull\"\npoint = \"0 0 0 "
                         "m\"\nforce = \"0 0 1 N\"\n",
                "`body`: a force moves a rigid body or tissue, body `skull` is fixed"},
        Mistake{"MomentOnFixed",
                kStart + "[[load]]\nkind = \"moment\"\nbody = @\"skull\"\nmoment = \"0 0 1 N "
                         "m\"\n",
                "`body`: a moment turns a rigid body, body `skull` is fixed"},
        Mistake{"MomentAsAForce",
                kStart + "[[load]]\nkind = \"moment\"\nbody = \"mandible\"\nmoment = @\"0 0 1 "
                         "N\"\n",
                "`moment`: expected a moment as three numbers and one unit, such as \"0 0 5 N m\", "
                "found "
                "\"0 0 1 N\" (a force)"},
        Mistake{"ForceOnRegionOfBone",
                kStart + "[[load]]\nkind = \"force\"\nbody = \"mandible\"\nregion = @{}\nforce = "
                         "\"0 0 1 N\"\n",
                "`region`: a force on a region acts on tissue; body `mandible` is rigid and takes "
                "a `point`"},
        Mistake{"MotionOfRigid",
                kStart + "[[load]]\nkind = \"motion\"\nbody = @\"mandible\"\ntime = [\"0 s\"]\n",
                "`body`: a motion drives a fixed body, or what `hold` of a rigid one holds; body "
                "`mandible` is rigid, without `hold`"},
        Mistake{"MotionUnequal",
                motion("time = [\"0 s\", \"1 s\"]\ntranslation = @[\"0 0 0 m\"]\n"),
                "`translation`: expected as many entries as times (2), found 1"},
        Mistake{"MotionOfNothing",
                kStart + "@[[load]]\nkind = \"motion\"\nbody = \"stand\"\ntime = [\"0 s\"]\n",
                "[[load]] of kind \"motion\": expected `translation`, `rotation` or both"},
        Mistake{"TwoMotions",
                motion("time = [\"0 s\"]\nrotation = [\"0 0 1 deg\"]\n[[load]]\nkind = "
                       "\"motion\"\nbody = @\"stand\"\n"
                       "time = [\"0 s\"]\nrotation = [\"0 0 1 deg\"]\n"),
                "`body`: body `stand` already has a motion, at jaw.toml:21"},
        Mistake{"TurnOfAHoldInRadians",
                kStart + "[[body]]\nname = \"block\"\nkind = \"rigid\"\ndensity = \"1 g/cm^3\"\n"
                         "geometry = { box = { size = \"1 1 1 mm\", cells = [1, 1, 1] } }\n"
                         "hold = { freedoms = [\"translation.x\"], turned = @\"0 0 90 rad\" }\n",
                "`turned`: turns by 5157 degrees: expected at most 360; is the unit the one that "
                "was meant?"},
        Mistake{"ContactOfOne", kStart + "[[contact]]\nbodies = @[\"skull\"]\n",
                "`bodies`: expected the names of two bodies, found a list of 1"},
        Mistake{"RigidSelfContact", kStart + "[[contact]]\nself = @\"mandible\"\n",
                "`self`: only tissue can touch itself, body `mandible` is rigid"},
        Mistake{"ContactWithoutSurface", kStart + "[[contact]]\nbodies = [\"skull\", @\"stand\"]\n",
                "`bodies[1]`: body `stand` has no surface that could touch"},
        Mistake{"NegativeFriction",
                kStart + "[[contact]]\nbodies = [\"skull\", \"mandible\"]\nfriction = @-0.1\n",
                "`friction` must not be negative, found -0.1"},
        Mistake{"SlipWithoutFriction",
                kStart + "[[contact]]\nbodies = [\"skull\", \"mandible\"]\n@slip_velocity = \"1 "
                         "mm/s\"\n",
                "[[contact]]: `slip_velocity` does not belong here: there is no friction"},
        Mistake{"StaticFriction",
                "analysis = \"static\"\n" + kStart +
                    "[[contact]]\nbodies = [\"skull\", \"mandible\"]\nfriction = @0.1\n",
                "`friction`: needs a dynamic analysis: in a static one nothing has a "
                "velocity"},
        Mistake{
            "ContactDampingUnit",
            kStart + "[[contact]]\nbodies = [\"skull\", \"mandible\"]\ndamping = @\"1 N s/m\"\n",
            "`damping`: expected a damping per area such as \"1e4 Pa s/m\", found \"1 N s/m\" "
            "(a damping)"},
        Mistake{"ContactTwice",
                kStart + "[[contact]]\nbodies = [\"skull\", \"mandible\"]\n@[[contact]]\nbodies = "
                         "[\"mandible\", "
                         "\"skull\"]\n",
                "[[contact]]: the pair `mandible`, `skull` is given twice, first at jaw.toml:21"},
        Mistake{"ContactOfNobody", kStart + "[[contact]]\nbodies = [\"skull\", @\"disk*\"]\n",
                "`bodies[1]`: no body that can touch something has a name like `disk*`; `*` stands "
                "for any characters"},
        Mistake{"RigidSelfContacts", kStart + "[[contact]]\nself = @\"mand*\"\n",
                "`self`: only tissue can touch itself, and none has a name like `mand*`"},
        Mistake{"ContactPatternsTwice",
                kStart + "[[contact]]\nbodies = [\"*\", \"mand*\"]\n@[[contact]]\nbodies = "
                         "[\"mand*\", \"*\"]\n",
                "[[contact]]: the pair `mand*`, `*` is given twice, first at jaw.toml:21"},
        Mistake{"ContactText", "contact = @\"none\"\n" + kStart,
                "`contact`: expected true, false or entries that start with [[contact]], found "
                "\"none\""},
        Mistake{"ContactsTwice",
                kStart + "[[probe]]\nname = \"p\"\nkind = \"contacts\"\nof = [\"a\", @\"a\"]\n",
                "`of[1]`: probe `a` is named twice, and would count twice: expected each once"},
        Mistake{"AngleOfTissue",
                kStart + "[[probe]]\nname = \"p\"\nkind = \"angle\"\nbody = @\"disc_left\"\n",
                "`body`: expected a rigid body, body `disc_left` is none"},
        Mistake{"EnergyOfABody",
                kStart + "[[probe]]\nname = \"p\"\nkind = \"energy\"\n@body = \"disc_left\"\n",
                "probe `p`: `body` does not belong here: the probe is of kind \"energy\""}),
    test_name);

using ScenarioFiles = ScenarioTest;

std::string refusal_of(const std::filesystem::path& file) {
  try {
    read_scenario(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(ScenarioFiles, AMissingFileIsNamed) {
  const std::string file = (folder_ / "none.toml").string();
  EXPECT_EQ(refusal_of(file), file + ": cannot read this file: No such file or directory");
}

TEST_F(ScenarioFiles, AFolderIsNoScenario) {
  EXPECT_EQ(refusal_of(folder_), folder_.string() + ": expected a scenario file, found a folder");
}

using AllMistakes = ScenarioTest;

TEST_F(AllMistakes, OfSettingsAndBodiesAreToldAtOnce) {
  EXPECT_EQ(refusal("duration = 1\n" + kBodies +
                    "[[body]]\nname = \"extra\"\n[[body]]\nname = \"skull\"\nkind = \"fixed\"\n"),
            "jaw.toml:1:12: `duration`: expected a quantity with its unit, such as \"0.6 s\", "
            "found the number 1\n"
            "jaw.toml:21:1: body `extra`: `kind` is missing\n"
            "jaw.toml:24:8: `name`: a second body is called `skull`, the first is at jaw.toml:3");
}

TEST_F(AllMistakes, OfEntriesThatNameBodiesAreToldAtOnce) {
  const std::string message = refusal(
      muscle("max_velocity = 1\n") + ligament("stiffness = \"1 N\"\n").substr(kStart.size()) +
      "[[attach]]\nbody = \"dics_left\"\nto = \"skull\"\nregion = {}\n");
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 2) << message;
  for (const char* part : {"max_velocity", "stiffness", "did you mean `disc_left`?"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace articular::sim::scenario_error_test
