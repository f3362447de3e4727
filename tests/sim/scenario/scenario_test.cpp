#include "sim/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include "fem/material/any_material.hpp"
#include "fem/material/point_law.hpp"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "tests/sim/support/scenario_file.hpp"

namespace articular::sim::scenario_test {

constexpr double kDegree = std::numbers::pi / 180;

// Every key of the format once.
const std::string kComplete = R"(title = "Jaw opening"
duration = "0.6 s"
accuracy = "balanced"
contact_response = "pointwise"

[integrator]
scheme = "tr-bdf2"
step = "2 ms"
solver = "conjugate-gradients"
position_tolerance = "0.3 um"
max_iterations = 9

[detection]
tree = "buckets"

[[body]]
name = "skull"
kind = "fixed"
mesh = { file = "anatomy/skull.vtp", unit = "cm" }
contact_meshes = [
  { file = "anatomy/fossa_left.vtp", facing = [0, 0, -2], faces = 500, continued = { at = "0 24 80 mm", direction = [0, -2, 0], length = "14 mm", easing = "3 mm" } },
  { file = "anatomy/fossa_right.vtp", unit = "m", place = { scale = 2 } },
]
layer = { thickness = "0.4 mm", young_modulus = "2.7 MPa", poisson_ratio = 0.49, law = "logarithmic" }
collides = false

[[body]]
name = "mandible"
kind = "rigid"
mesh = { file = "${ARTICULAR_TEST_DATA}/mandible.vtp", place = { rotation = "0 0 10 deg", about = "1 0 0 mm", translation = "1 2 3 mm", scale = 1.5 } }
mass = "0.2 kg"
center_of_mass = "0 -9.5 36.1 mm"
inertia = ["147 246 297 kg mm^2", "1 2 -45 kg mm^2"]
velocity = "1 0 0 mm/s"
angular_velocity = "0 2 0 rad/s"

[[body]]
name = "disc_left"
kind = "tissue"
mesh = { file = "anatomy/disc_left.vtu" }
density = "1.1 g/cm^3"
material = { law = "neo-hookean", young_modulus = "5.4 MPa", poisson_ratio = 0.4 }
velocity = "0 0 1 m/s"

[[body]]
name = "disc_right"
kind = "tissue"
geometry = { sphere = { radius = "5 mm", element_size = "1 mm", center = "0 1 0 mm" } }
density = "1000 kg/m^3"
material = { law = "corotated", young_modulus = "1 MPa", poisson_ratio = -0.2 }

[[body]]
name = "block"
kind = "tissue"
geometry = { box = { size = "10 11 12 mm", cells = [4, 5, 6], center = "0 0 5 mm" }, place = { rotation = "0 0 45 deg" } }
density = "1000 kg/m^3"
material = { law = "linear", young_modulus = "100 kPa", poisson_ratio = 0.3, element = "plain" }

[[body]]
name = "tool"
kind = "rigid"
geometry = { v_shape = { leg_length = "40 mm", width = "8 mm", angle = "40 deg", cells = [20, 4] } }
density = "2 g/cm^3"

[[body]]
name = "stand"
kind = "fixed"

[[attach]]
body = "block"
to = "skull"
region = { box = ["-6 -6 -0.1 mm", "6 7 0.1 mm"], sphere = { center = "1 0 0 mm", radius = "9 mm" }, near = { body = "skull", distance = "0.5 mm" }, surface = true }

[[attach]]
body = "disc_left"
to = "mandible"
mirror = "x"
region = { box = ["1 2 3 mm", "4 5 6 mm"] }

[[muscle]]
name = "masseter"
mirror = "x"
path = [{ body = "skull", point = "57 -4 74 mm" }, { body = "disc_left", point = "50 0 40 mm" }, { body = "mandible", point = "47 18 31 mm" }]
max_force = "190.4 N"
optimal_length = "49 mm"
max_length_ratio = 1.4
tendon_ratio = 0.46
passive_fraction = 0.02
max_velocity = "8 1/s"
activation_time = "10 ms"
deactivation_time = "40 ms"
excitation = { time = ["0 s", "0.3 s"], value = [0, 0.1] }

[[ligament]]
name = "sphenomandibular"
mirror = "x"
path = [{ body = "skull", point = "33 13 -18 mm" }, { body = "disc_left", point = "47 -24 -31 mm", radius = "2 mm" }]
stiffness = "250 N/mm"
damping = "0.05 N s/mm"
slack_extension = "5.5 mm"

[[ligament]]
name = "cruciate"
path = [{ body = "skull", point = "0 0 0 mm" }, { body = "mandible", point = "0 0 30 mm" }]
stiffness_per_strain = "2000 N"
toe_strain = 0.05
reference_strain = -0.02

[[ligament]]
name = "capsule"
path = [{ body = "skull", point = "0 0 0 mm" }, { body = "mandible", point = "0 0 30 mm" }]
stiffness = "1 N/mm"
slack_length = "22.8 mm"

[[load]]
kind = "gravity"
acceleration = "0 0 -9.81 m/s^2"

[[load]]
kind = "force"
body = "block"
region = { box = ["-6 -6 9.9 mm", "6 6 10.1 mm"] }
force = "0 0 -1 N"
profile = { time = ["0 s", "0.1 s"], value = [0, 1] }

[[load]]
kind = "force"
body = "disc_left"
point = "1 2 3 mm"
radius = "1 mm"
force = "0 3 0 N"

[[load]]
kind = "moment"
body = "mandible"
moment = "0 5 0 N m"
profile = { time = ["0 s", "0.1 s"], value = [0, 1] }

[[load]]
kind = "motion"
body = "stand"
time = ["0 s", "1 s"]
translation = ["0 0 0 mm", "0 0 -5 mm"]
rotation = ["0 0 0 deg", "10 0 0 deg"]
about = "0 0 7 mm"
interpolation = "linear"

[[contact]]
bodies = ["disc_left", "mandible"]
friction = 0.02
slip_velocity = "0.1 mm/s"
damping = "1e4 Pa s/m"

[[contact]]
self = "block"

[[probe]]
name = "incisor"
kind = "point"
body = "mandible"
point = "0 -47 42 mm"

[[probe]]
name = "jaw"
kind = "angle"
body = "mandible"
axis = [0, 3, 4]

[[probe]]
name = "joint_left"
kind = "contact"
bodies = ["disc_left", "mandible"]

[[probe]]
name = "pull"
mirror = "x"
kind = "line"
line = "masseter_left"

[[probe]]
name = "energy"
kind = "energy"

[[probe]]
name = "skull"
kind = "reaction"
body = "skull"

[output]
interval = "20 ms"
length_unit = "cm"
directory = "out/opening"
contact_surfaces = true
checkpoint_interval = "100 ms"
directions = ["medial", "posterior", "superior"]
)";

class CompleteScenario : public ScenarioTest {
 protected:
  CompleteScenario() {
    ::setenv("ARTICULAR_TEST_DATA", "/data", 1);
    scenario_ = read(kComplete);
  }
  ~CompleteScenario() override { ::unsetenv("ARTICULAR_TEST_DATA"); }

  Scenario scenario_;
};

TEST_F(CompleteScenario, HasItsSettings) {
  EXPECT_EQ(scenario_.title, "Jaw opening");
  EXPECT_EQ(scenario_.name, "jaw");
  EXPECT_EQ(scenario_.file, folder_ / "jaw.toml");
  EXPECT_EQ(scenario_.duration, 0.6);
  EXPECT_EQ(scenario_.integrator.scheme, Integrator::Scheme::TrBdf2);
  EXPECT_EQ(scenario_.integrator.solver, Integrator::Solver::ConjugateGradients);
  EXPECT_EQ(scenario_.integrator.step, 2e-3);
  EXPECT_EQ(scenario_.integrator.position_tolerance, 3e-7);
  EXPECT_EQ(scenario_.integrator.max_iterations, 9);
  EXPECT_EQ(scenario_.contact_response, Scenario::Response::Pointwise);
  EXPECT_EQ(scenario_.detection.tree, Detection::Tree::Buckets);
  EXPECT_EQ(scenario_.output.interval, 20e-3);
  EXPECT_EQ(scenario_.output.length_unit.metres, 1e-2);
  EXPECT_EQ(scenario_.output.length_unit.name, "cm");
  EXPECT_EQ(scenario_.output.directory, "out/opening");
  EXPECT_TRUE(scenario_.output.contact_surfaces);
  EXPECT_EQ(scenario_.output.checkpoint_interval, 0.1);
  EXPECT_EQ(scenario_.output.directions,
            (std::vector<std::string>{"medial", "posterior", "superior"}));
}

TEST_F(CompleteScenario, HasItsBones) {
  ASSERT_EQ(scenario_.bodies.size(), 7U);
  const Body& skull = scenario_.bodies[0];
  EXPECT_EQ(skull.kind, Body::Kind::Fixed);
  const auto& skull_mesh = std::get<MeshFile>(skull.geometry);
  EXPECT_EQ(skull_mesh.path, folder_ / "anatomy/skull.vtp");
  EXPECT_EQ(skull_mesh.unit, 1e-2);
  ASSERT_EQ(skull.contact_meshes.size(), 2U);
  EXPECT_EQ(skull.contact_meshes[0].facing, Vec3(0, 0, -1));
  EXPECT_EQ(skull.contact_meshes[0].faces, 500);
  EXPECT_EQ(skull.contact_meshes[0].continued->at, Vec3(0, 24e-3, 80e-3));
  EXPECT_EQ(skull.contact_meshes[0].continued->direction, Vec3(0, -1, 0));
  EXPECT_EQ(skull.contact_meshes[0].continued->length, 14e-3);
  EXPECT_EQ(skull.contact_meshes[0].continued->easing, 3e-3);
  EXPECT_FALSE(skull.contact_meshes[1].continued);
  EXPECT_EQ(skull.contact_meshes[0].unit, 1e-3);
  EXPECT_EQ(skull.contact_meshes[1].unit, 1);
  EXPECT_EQ(skull.contact_meshes[1].placement.scale, 2);
  EXPECT_EQ(skull.layer->thickness, 0.4e-3);
  EXPECT_EQ(skull.layer->young_modulus, 2.7e6);
  EXPECT_EQ(skull.layer->poisson_ratio, 0.49);
  EXPECT_EQ(skull.layer->law, Layer::Law::Logarithmic);
  EXPECT_FALSE(skull.collides);

  const Body& mandible = scenario_.bodies[1];
  EXPECT_EQ(mandible.kind, Body::Kind::Rigid);
  const auto& mandible_mesh = std::get<MeshFile>(mandible.geometry);
  EXPECT_EQ(mandible_mesh.path, "/data/mandible.vtp");
  EXPECT_TRUE(mandible_mesh.placement.rotation.isApprox(Vec3(0, 0, 10 * kDegree)));
  EXPECT_EQ(mandible_mesh.placement.about, Vec3(1e-3, 0, 0));
  EXPECT_EQ(mandible_mesh.placement.translation, Vec3(1e-3, 2e-3, 3e-3));
  EXPECT_EQ(mandible_mesh.placement.scale, 1.5);
  EXPECT_EQ(mandible.mass, 0.2);
  EXPECT_EQ(mandible.center_of_mass, Vec3(0, -9.5e-3, 36.1e-3));
  Eigen::Matrix3d inertia;
  inertia << 147e-6, 1e-6, 2e-6, 1e-6, 246e-6, -45e-6, 2e-6, -45e-6, 297e-6;
  EXPECT_EQ(mandible.inertia, inertia);
  EXPECT_EQ(mandible.velocity, Vec3(1e-3, 0, 0));
  EXPECT_EQ(mandible.angular_velocity, Vec3(0, 2, 0));
  EXPECT_TRUE(mandible.collides);

  const Body& stand = scenario_.bodies[6];
  EXPECT_TRUE(std::holds_alternative<std::monostate>(stand.geometry));
}

TEST_F(CompleteScenario, HasItsTissueAndGeometries) {
  const Body& disc = scenario_.bodies[2];
  EXPECT_EQ(disc.kind, Body::Kind::Tissue);
  EXPECT_EQ(disc.density, 1100);
  EXPECT_TRUE(std::holds_alternative<fem::NeoHookean>(*disc.material->law));
  EXPECT_NEAR(fem::shear_modulus(*disc.material->law), 5.4e6 / (2 * 1.4), 1e-6);
  EXPECT_NEAR(fem::bulk_modulus(*disc.material->law), 5.4e6 / (3 * (1 - 2 * 0.4)), 1e-6);
  EXPECT_EQ(disc.material->element, TissueMaterial::Element::Smoothed);  // the default
  EXPECT_EQ(disc.velocity, Vec3(0, 0, 1));
  const Body& ball = scenario_.bodies[3];
  const auto& sphere = std::get<SphereGeometry>(ball.geometry);
  EXPECT_EQ(sphere.radius, 5e-3);
  EXPECT_EQ(sphere.element_size, 1e-3);
  EXPECT_EQ(sphere.center, Vec3(0, 1e-3, 0));
  EXPECT_TRUE(std::holds_alternative<fem::Corotated>(*ball.material->law));
  const Body& block = scenario_.bodies[4];
  const auto& box = std::get<BoxGeometry>(block.geometry);
  EXPECT_EQ(box.size, Vec3(10e-3, 11e-3, 12e-3));
  EXPECT_EQ(box.cells, Eigen::Vector3i(4, 5, 6));
  EXPECT_EQ(box.center, Vec3(0, 0, 5e-3));
  EXPECT_TRUE(block.placement.rotation.isApprox(Vec3(0, 0, 45 * kDegree)));
  EXPECT_TRUE(std::holds_alternative<fem::Linear>(*block.material->law));
  EXPECT_EQ(block.material->element, TissueMaterial::Element::Plain);
  const Body& tool = scenario_.bodies[5];
  const auto& shape = std::get<VShapeGeometry>(tool.geometry);
  EXPECT_EQ(shape.leg_length, 40e-3);
  EXPECT_EQ(shape.width, 8e-3);
  EXPECT_DOUBLE_EQ(shape.angle, 40 * kDegree);
  EXPECT_EQ(shape.cells, Eigen::Vector2i(20, 4));
  EXPECT_EQ(tool.density, 2000);
}

TEST_F(CompleteScenario, HasItsAttachments) {
  ASSERT_EQ(scenario_.attachments.size(), 3U);
  const Attachment& block = scenario_.attachments[0];
  EXPECT_EQ(block.body, "block");
  EXPECT_EQ(block.to, "skull");
  EXPECT_EQ(block.region.box->first, Vec3(-6e-3, -6e-3, -0.1e-3));
  EXPECT_EQ(block.region.box->second, Vec3(6e-3, 7e-3, 0.1e-3));
  EXPECT_EQ(block.region.sphere->first, Vec3(1e-3, 0, 0));
  EXPECT_EQ(block.region.sphere->second, 9e-3);
  EXPECT_EQ(block.region.near_body->first, "skull");
  EXPECT_EQ(block.region.near_body->second, 0.5e-3);
  EXPECT_TRUE(block.region.surface_only);
  const Attachment& mirrored = scenario_.attachments[2];
  EXPECT_EQ(mirrored.body, "disc_right");
  EXPECT_EQ(mirrored.to, "mandible");
  EXPECT_EQ(mirrored.region.box->first, Vec3(-4e-3, 2e-3, 3e-3));
  EXPECT_EQ(mirrored.region.box->second, Vec3(-1e-3, 5e-3, 6e-3));
}

TEST_F(CompleteScenario, HasItsMusclesOnBothSides) {
  ASSERT_EQ(scenario_.muscles.size(), 2U);
  const Muscle& left = scenario_.muscles[0];
  EXPECT_EQ(left.name, "masseter_left");
  ASSERT_EQ(left.path.size(), 3U);
  EXPECT_EQ(left.path[0].body, "skull");
  EXPECT_EQ(left.path[0].point, Vec3(57e-3, -4e-3, 74e-3));
  EXPECT_EQ(left.path[1].body, "disc_left");
  EXPECT_EQ(left.max_force, 190.4);
  EXPECT_EQ(left.optimal_length, 49e-3);
  EXPECT_EQ(left.max_length_ratio, 1.4);
  EXPECT_EQ(left.tendon_ratio, 0.46);
  EXPECT_EQ(left.passive_fraction, 0.02);
  EXPECT_EQ(left.max_velocity, 8);
  EXPECT_EQ(left.activation_time, 10e-3);
  EXPECT_EQ(left.deactivation_time, 40e-3);
  EXPECT_EQ(left.excitation.time, (std::vector<double>{0, 0.3}));
  EXPECT_EQ(left.excitation.value, (std::vector<double>{0, 0.1}));
  const Muscle& right = scenario_.muscles[1];
  EXPECT_EQ(right.name, "masseter_right");
  EXPECT_EQ(right.path[0].body, "skull");
  EXPECT_EQ(right.path[0].point, Vec3(-57e-3, -4e-3, 74e-3));
  EXPECT_EQ(right.path[1].body, "disc_right");
  EXPECT_EQ(right.max_force, 190.4);
}

TEST_F(CompleteScenario, HasItsLigamentsOnBothSides) {
  ASSERT_EQ(scenario_.ligaments.size(), 4U);
  EXPECT_EQ(scenario_.ligaments[0].name, "sphenomandibular_left");
  EXPECT_EQ(scenario_.ligaments[0].path[1].body, "disc_left");
  EXPECT_EQ(scenario_.ligaments[0].path[1].radius, 2e-3);
  EXPECT_EQ(scenario_.ligaments[0].law, Ligament::Law::Linear);
  EXPECT_EQ(scenario_.ligaments[0].stiffness, 250e3);
  EXPECT_EQ(scenario_.ligaments[0].damping, 50);
  EXPECT_EQ(scenario_.ligaments[0].slack_extension, 5.5e-3);
  EXPECT_EQ(scenario_.ligaments[1].name, "sphenomandibular_right");
  EXPECT_EQ(scenario_.ligaments[1].path[1].body, "disc_right");
  EXPECT_EQ(scenario_.ligaments[1].path[1].point, Vec3(-47e-3, -24e-3, -31e-3));
  EXPECT_EQ(scenario_.ligaments[2].law, Ligament::Law::Blankevoort);
  EXPECT_EQ(scenario_.ligaments[2].stiffness, 2000);
  EXPECT_EQ(scenario_.ligaments[2].toe_strain, 0.05);
  EXPECT_EQ(scenario_.ligaments[2].reference_strain, -0.02);
  EXPECT_EQ(scenario_.ligaments[3].slack_length, 22.8e-3);
}

TEST_F(CompleteScenario, HasItsLoads) {
  ASSERT_EQ(scenario_.loads.size(), 5U);
  EXPECT_EQ(std::get<GravityLoad>(scenario_.loads[0]).acceleration, Vec3(0, 0, -9.81));
  const auto& on_region = std::get<ForceLoad>(scenario_.loads[1]);
  EXPECT_EQ(std::get<TissueRegion>(on_region.at).tissue, "block");
  EXPECT_EQ(std::get<TissueRegion>(on_region.at).region.box->first, Vec3(-6e-3, -6e-3, 9.9e-3));
  EXPECT_EQ(on_region.force, Vec3(0, 0, -1));
  EXPECT_EQ(on_region.profile.value, (std::vector<double>{0, 1}));
  const Anchor& point = std::get<Anchor>(std::get<ForceLoad>(scenario_.loads[2]).at);
  EXPECT_EQ(point.body, "disc_left");
  EXPECT_EQ(point.point, Vec3(1e-3, 2e-3, 3e-3));
  EXPECT_EQ(point.radius, 1e-3);
  const auto& moment = std::get<MomentLoad>(scenario_.loads[3]);
  EXPECT_EQ(moment.body, "mandible");
  EXPECT_EQ(moment.moment, Vec3(0, 5, 0));
  EXPECT_EQ(moment.profile.value, (std::vector<double>{0, 1}));
  const auto& motion = std::get<MotionLoad>(scenario_.loads[4]);
  EXPECT_EQ(motion.body, "stand");
  EXPECT_EQ(motion.motion.time, (std::vector<double>{0, 1}));
  EXPECT_EQ(motion.motion.translation[1], Vec3(0, 0, -5e-3));
  EXPECT_TRUE(motion.motion.rotation[1].isApprox(Vec3(10 * kDegree, 0, 0)));
  EXPECT_EQ(motion.motion.about, Vec3(0, 0, 7e-3));
  EXPECT_EQ(motion.motion.interpolation, Motion::Interpolation::Linear);
}

TEST_F(CompleteScenario, HasItsContactsAndProbes) {
  EXPECT_TRUE(scenario_.contact);
  ASSERT_EQ(scenario_.contacts.size(), 2U);
  EXPECT_EQ(scenario_.contacts[0].a, "disc_left");
  EXPECT_EQ(scenario_.contacts[0].b, "mandible");
  EXPECT_EQ(scenario_.contacts[0].friction, 0.02);
  EXPECT_EQ(scenario_.contacts[0].slip_velocity, 1e-4);
  EXPECT_EQ(scenario_.contacts[0].damping, 1e4);
  EXPECT_EQ(scenario_.contacts[1].a, "block");
  EXPECT_EQ(scenario_.contacts[1].b, "block");
  EXPECT_EQ(scenario_.contacts[1].friction, 0);
  EXPECT_FALSE(scenario_.contacts[1].slip_velocity);
  EXPECT_EQ(scenario_.contacts[1].damping, 0);
  ASSERT_EQ(scenario_.probes.size(), 7U);
  const Anchor& incisor = std::get<PointProbe>(scenario_.probes[0].what).anchor;
  EXPECT_EQ(incisor.body, "mandible");
  EXPECT_EQ(incisor.point, Vec3(0, -47e-3, 42e-3));
  const auto& angle = std::get<AngleProbe>(scenario_.probes[1].what);
  EXPECT_EQ(angle.body, "mandible");
  EXPECT_TRUE(angle.axis.isApprox(Vec3(0, 0.6, 0.8)));
  const auto& contact = std::get<ContactProbe>(scenario_.probes[2].what);
  EXPECT_EQ(contact.first, "disc_left");
  EXPECT_EQ(contact.second, "mandible");
  EXPECT_EQ(scenario_.probes[3].name, "pull_left");
  EXPECT_EQ(std::get<LineProbe>(scenario_.probes[3].what).line, "masseter_left");
  EXPECT_EQ(std::get<LineProbe>(scenario_.probes[4].what).line, "masseter_right");
  EXPECT_TRUE(std::holds_alternative<EnergyProbe>(scenario_.probes[5].what));
  EXPECT_TRUE(std::holds_alternative<ReactionProbe>(scenario_.probes[6].what));
}

TEST_F(CompleteScenario, KnowsWhereEveryEntryStands) {
  std::vector<Location> places;
  for (const Body& body : scenario_.bodies) {
    places.push_back(body.where);
    if (const auto* mesh = std::get_if<MeshFile>(&body.geometry)) places.push_back(mesh->where);
    if (body.material) places.push_back(body.material->where);
    for (const MeshFile& mesh : body.contact_meshes) places.push_back(mesh.where);
  }
  for (const Attachment& attachment : scenario_.attachments) {
    places.push_back(attachment.where);
    places.push_back(attachment.region.where);
  }
  for (const Muscle& muscle : scenario_.muscles) {
    places.push_back(muscle.where);
    for (const Anchor& anchor : muscle.path) places.push_back(anchor.where);
  }
  for (const Ligament& ligament : scenario_.ligaments) places.push_back(ligament.where);
  for (const Load& load : scenario_.loads)
    places.push_back(std::visit([](const auto& kind) { return kind.where; }, load));
  for (const ContactPair& pair : scenario_.contacts) places.push_back(pair.where);
  for (const Probe& probe : scenario_.probes) places.push_back(probe.where);
  for (const Location& place : places) {
    EXPECT_EQ(place.file, (folder_ / "jaw.toml").string());
    EXPECT_GT(place.line, 0);
    EXPECT_GT(place.column, 0);
  }
  EXPECT_EQ(scenario_.bodies[0].where.line, 16);
  const Location& file = std::get<MeshFile>(scenario_.bodies[0].geometry).where;
  EXPECT_EQ(file.line, 19);
  EXPECT_EQ(file.column, 17);
}

TEST_F(CompleteScenario, RecordsItsSettingsAsJson) {
  const auto json = nlohmann::json::parse(scenario_.settings_json);
  EXPECT_EQ(json["title"], "Jaw opening");
  EXPECT_EQ(json["duration_s"], 0.6);
  EXPECT_EQ(json["accuracy"], "balanced");
  EXPECT_EQ(json["contact"][0]["bodies"][1], "mandible");
  EXPECT_EQ(json["integrator"]["scheme"], "tr-bdf2");
  EXPECT_EQ(json["integrator"]["position_tolerance_m"], 3e-7);
  EXPECT_EQ(json["contact_response"], "pointwise");
  EXPECT_EQ(json["contact_parameters_set"], 1);
  EXPECT_EQ(json["output"]["contact_surfaces"], true);
  EXPECT_EQ(json["output"]["checkpoint_interval_s"], 0.1);
}

// Cut, swap and repeat pieces of a valid file: the result is read, or refused in lines that start
// with the file. Both must happen often.
TEST_F(CompleteScenario, DamagedFilesAreReadOrRefusedWithTheirPlaces) {
  std::mt19937 random(5);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string text = kComplete;
    const std::size_t at = random() % text.size(), length = 1 + random() % 6;
    if (i % 3 == 0)
      text.erase(at, length);
    else if (i % 3 == 1)
      text.insert(at, text.substr(random() % text.size(), length));
    else
      text[at] = static_cast<char>(random() % 256);
    const std::string message = refusal(text);
    ++(message.empty() ? accepted : refused);
    if (message.empty()) continue;
    std::istringstream lines(message);
    for (std::string line; std::getline(lines, line);)
      EXPECT_TRUE(line.starts_with("jaw.toml:")) << message;
  }
  EXPECT_GT(accepted, 10);
  EXPECT_GT(refused, 100);
}

using LengthBeyond = ScenarioTest;

TEST_F(LengthBeyond, IsALengthOrOneOverTime) {
  const auto muscle = [&](const std::string& beyond) {
    return read(kStart +
                "[[muscle]]\nname = \"calf\"\nmax_force = \"1 N\"\npath = [{ body = \"skull\", "
                "point "
                "= \"0 0 0 mm\" }, { body = \"mandible\", point = \"0 0 9 m\", beyond_mesh = true "
                "}]\n" +
                beyond)
        .muscles[0];
  };
  EXPECT_TRUE(muscle("").beyond.time.empty());
  EXPECT_FALSE(muscle("").path[0].beyond_mesh);
  EXPECT_TRUE(muscle("").path[1].beyond_mesh);
  EXPECT_EQ(muscle("beyond = \"3 mm\"\n").beyond.value, std::vector<double>{3e-3});
  const Curve curve =
      muscle("beyond = { time = [\"1 s\", \"2 s\"], length = [\"0 mm\", \"12 mm\"] }\n").beyond;
  EXPECT_EQ(curve.time, (std::vector<double>{1, 2}));
  EXPECT_EQ(curve.value, (std::vector<double>{0, 12e-3}));
}

using Defaults = ScenarioTest;

TEST_F(Defaults, AreThoseOfTheStructs) {
  const Scenario scenario = read(kStart);
  EXPECT_EQ(scenario.title, "jaw");
  EXPECT_EQ(scenario.accuracy, Scenario::Accuracy::Balanced);
  EXPECT_TRUE(scenario.contact);
  EXPECT_TRUE(scenario.contacts.empty());
  EXPECT_EQ(scenario.integrator.step, 1e-3);
  EXPECT_EQ(scenario.output.interval, 10e-3);
  EXPECT_FALSE(scenario.output.directory);
  EXPECT_EQ(nlohmann::json::parse(scenario.settings_json)["contact"], "every pair");
}

// Time only says how much of the load acts: the steps are parts of the whole.
TEST_F(Defaults, OfAStaticAnalysisAreTenLoadStepsWithAFrameEach) {
  for (const double duration : {0.5, 100.0}) {
    const std::string given = "duration = \"" + std::to_string(duration) + " s\"\n";
    std::string text = "analysis = \"static\"\n" + kStart;
    text.replace(text.find("duration"),
                 text.find('\n', text.find("duration")) + 1 - text.find("duration"), given);
    const Scenario scenario = read(text);
    EXPECT_DOUBLE_EQ(scenario.integrator.step, duration / 10);
    EXPECT_EQ(scenario.output.interval, scenario.integrator.step);
    const auto settings = nlohmann::json::parse(scenario.settings_json);
    EXPECT_FALSE(settings.contains("accuracy"));
    EXPECT_FALSE(settings["integrator"].contains("scheme"));
  }
  const Scenario set =
      read("analysis = \"static\"\n" + kStart + "[integrator]\nstep = \"0.2 s\"\n");
  EXPECT_EQ(set.output.interval, 0.2);
  const Scenario both = read("analysis = \"static\"\n" + kStart +
                             "[integrator]\nstep = \"0.2 s\"\n[output]\ninterval = \"0.3 s\"\n");
  EXPECT_EQ(both.output.interval, 0.3);
}

TEST_F(Defaults, NoContactIsSaidByFalse) {
  const Scenario scenario = read("contact = false\n" + kStart);
  EXPECT_FALSE(scenario.contact);
  EXPECT_EQ(nlohmann::json::parse(scenario.settings_json)["contact"], false);
}

using Documentation = ScenarioTest;

TEST_F(Documentation, ItsExampleIsAScenario) {
  std::ifstream stream(ARTICULAR_SOURCE_DIR "/scenarios/README.md");
  std::string example;
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```"))
      inside = line == "```toml";
    else if (inside)
      example += line + "\n";
  }
  EXPECT_EQ(read(example).bodies.size(), 5U);  // with the one that is driven
}

// Nothing about contact is left to trial: no scenario that we ship sets what we choose.
TEST(ShippedScenarios, LeaveContactAsItIs) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(ARTICULAR_SOURCE_DIR "/scenarios")) {
    const std::string name = entry.path().filename().string();
    const auto is_of = [&](const char* kind) { return name.ends_with(kind); };
    if (!is_of(".toml") || is_of("-study.toml") || is_of("-fit.toml") || is_of("-track.toml") ||
        is_of("-population.toml"))
      continue;
    if (name.starts_with("subject")) continue;  // reads data that is not here
    const auto settings = nlohmann::json::parse(read_scenario(entry.path()).settings_json);
    const int expected = name == "incline.toml" ? 2 : 0;  // two slip velocities: it verifies those
    EXPECT_EQ(settings["contact_parameters_set"], expected) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 12);
}

using Presets = ScenarioTest;

TEST_F(Presets, SetSchemeStepAndTolerance) {
  const Scenario fast = read("accuracy = \"fast\"\n" + kStart);
  EXPECT_EQ(fast.integrator.step, 2e-3);
  EXPECT_EQ(fast.contact_response, Scenario::Response::Pointwise);
  const Scenario balanced = read("accuracy = \"balanced\"\n" + kStart);
  EXPECT_EQ(balanced.integrator.step, 1e-3);
  EXPECT_EQ(balanced.integrator.scheme, Integrator::Scheme::ImplicitEuler);
  EXPECT_EQ(balanced.contact_response, Scenario::Response::Averaged);
  const Scenario accurate = read("accuracy = \"accurate\"\n" + kStart);
  EXPECT_EQ(accurate.integrator.step, 1e-3);
  EXPECT_EQ(accurate.integrator.scheme, Integrator::Scheme::TrBdf2);
  EXPECT_EQ(accurate.integrator.element_tolerance, 5e-5);
  EXPECT_EQ(accurate.contact_response, Scenario::Response::Averaged);
  EXPECT_EQ(accurate.contact_stiffness_factor, 1000);
  EXPECT_FALSE(balanced.contact_stiffness_factor);
}

TEST_F(Presets, GiveWayToWhatTheScenarioSays) {
  const Scenario scenario = read("accuracy = \"accurate\"\ncontact_response = \"pointwise\"\n" +
                                 kStart + "[integrator]\nstep = \"4 ms\"\n");
  EXPECT_EQ(scenario.contact_response, Scenario::Response::Pointwise);
  const Integrator& integrator = scenario.integrator;
  EXPECT_EQ(integrator.step, 4e-3);
  EXPECT_EQ(integrator.element_tolerance, 5e-5);
  EXPECT_FALSE(integrator.position_tolerance.has_value());
}

using MeshPaths = ScenarioTest;

TEST_F(MeshPaths, StartAtTheFolderOfTheScenarioOrAtAVariable) {
  const auto path = [&](const std::string& file) {
    const Scenario scenario = read(kStart, {"body.skull.mesh.file=" + file});
    return std::get<MeshFile>(scenario.bodies[0].geometry).path;
  };
  ::setenv("ARTICULAR_TEST_DATA", "/data", 1);
  EXPECT_EQ(path("a/../b.vtp"), folder_ / "b.vtp");
  EXPECT_EQ(path("/b.vtp"), "/b.vtp");
  EXPECT_EQ(path("${ARTICULAR_TEST_DATA}/b.vtp"), "/data/b.vtp");
  EXPECT_EQ(path("x${ARTICULAR_TEST_DATA}y${ARTICULAR_TEST_DATA}"), folder_ / "x/datay/data");
  // A relative variable is meant from where the program was started.
  ::setenv("ARTICULAR_TEST_DATA", "data", 1);
  EXPECT_EQ(path("${ARTICULAR_TEST_DATA}/b.vtp"), std::filesystem::current_path() / "data/b.vtp");
  ::unsetenv("ARTICULAR_TEST_DATA");
}

}  // namespace articular::sim::scenario_test
