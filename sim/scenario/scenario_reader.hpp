#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/mistakes.hpp"
#include "sim/base/place_text.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/scenario_choices.hpp"
#include "sim/scenario/toml_reader.hpp"

/// The parts of read_scenario(): each reads one kind of entry and checks it against what was read
/// before.
namespace articular::sim {

/// The right side of an entry with `mirror = "x"`: x is negated, `_left` in names becomes `_right`.
enum class Side { AsWritten, Mirrored };

/// What the reading of an entry refers to.
struct Context {
  std::filesystem::path folder;     // of the scenario file
  const std::vector<Body>& bodies;  // complete
  const Node* curves = nullptr;     // [curve], or nullptr
  std::span<const LeftOut> left_out = {};
  Side side = Side::AsWritten;

  std::string name(const std::string& written) const;  // on this side
  Vec3 point(const Vec3& written) const;
};

/// What to append where an entry of one of these lists is missed: "; the one of jaw.toml:84 is left
/// out by its `when`", else the suggestion() among these names.
std::string missing_hint(const Context& context, std::initializer_list<std::string_view> lists,
                         std::string_view name, const std::vector<std::string>& names);

/// "body `skull`" for messages about an entry, or "[[body]]" if it has no name.
std::string label(const Node& entry, std::string_view list);

/// A name of an entry: letters, digits, `_`, `-` and inner spaces, since results carry it in file
/// names and table headers.
std::string read_name(const Node& node);

/// Throws at `node` if one of the entries so far has the name.
template <class Entry>
void check_new_name(const Node& node, std::string_view what, const std::string& name,
                    const std::vector<Entry>& so_far) {
  for (const Entry& entry : so_far)
    if (entry.name == name)
      fail(node, fmt::format("a second {} is called `{}`, the first is at {}", what, name,
                             place_text(entry.where)));
}

/// The sides on which an entry exists: as written, and mirrored if it has `mirror = "x"`.
std::vector<Side> read_sides(const TableReader& table);

/// "_left", "_right" for an entry that is mirrored, or "".
std::string side_suffix(const TableReader& table, Side side);

/// "translation.x" to "rotation.z", by Hold::held.
std::string_view freedom_name(std::size_t freedom);

/// Which of them a list names.
std::array<bool, 6> read_freedoms(const Node& node);

/// A rotation vector [rad] of at most a whole turn: radians are written for degrees, and degrees
/// for radians. @throws InputError  for more
Vec3 read_turn(const TableReader& table, const char* key);

/// The body that a node names. @throws InputError  if there is none, with the nearest name
const Body& read_body_reference(const Node& node, const Context& context);

bool has_surface(const Body& body);

/// The body that a node names, which can touch something.
const Body& read_touching_body(const Node& node, const Context& context);

Placement read_placement(const Node& node);

/// The lower and the upper corner of a box [m].
std::pair<Vec3, Vec3> read_corners(const Node& node);

Region read_region(const Node& node, const Context& context);

/// Directions of fibres. @param keys  material_fibres_keys() or sheet_fibres_keys()
Fibres read_fibres(const Node& node, const KeyTable& keys, const Context& context);

/// `mesh` of a body, its `contact_meshes`, and its `geometry` with `place`.
MeshFile read_mesh_file(const Node& node, const std::filesystem::path& folder);
std::vector<MeshFile> read_contact_meshes(const Node& node, const std::filesystem::path& folder);
void read_geometry(const Node& node, Body& body);

TissueMaterial read_material(const Node& node);

/// `body`, `point` and, where it has this key, `radius` of a table.
Anchor read_anchor(const TableReader& table, const Context& context);

/// A table of `time` and `value`, or the name of one in [curve]. @param range  of the values
Curve read_curve(const Node& node, const Range& range, const Context& context);
/// The times of a table, and as many entries of a key.
/// @param key       in the singular: errors name its plural
/// @param expected  what the list should be
Curve read_over_time(const TableReader& table, const char* key, const char* expected,
                     const std::function<double(const Node&)>& read_value);

/// [curve], each of which has to be a curve; nullptr if there is none.
const Node* check_curves(const TableReader& document);

/// Strictly increasing times.
std::vector<double> read_times(const Node& node);

std::vector<Body> read_bodies(const TableReader& document, const std::filesystem::path& folder);
std::vector<Attachment> read_attachments(const TableReader& document, const Context& context);
std::vector<Support> read_supports(const TableReader& document, const Context& context);
std::vector<Sheet> read_sheets(const TableReader& document, const Context& context);
std::vector<Muscle> read_muscles(const TableReader& document, const Context& context);
std::vector<Ligament> read_ligaments(const TableReader& document, const Context& context,
                                     const std::vector<Muscle>& muscles);
std::vector<Bolus> read_boluses(const TableReader& document, const Context& context,
                                const std::vector<Muscle>& muscles,
                                const std::vector<Ligament>& ligaments);
/// The support that a node names. @throws InputError  if there is none, with the nearest name
const Support& read_support_reference(const Node& node, const Context& context,
                                      const std::vector<Support>& supports);
std::vector<Load> read_loads(const TableReader& document, const Context& context,
                             const std::vector<Support>& supports);
void read_contacts(const TableReader& document, const Context& context, Scenario& scenario);
std::vector<Probe> read_probes(const TableReader& document, const Context& context,
                               const Scenario& read_so_far);

/// The keys that read_settings() reads.
std::vector<Key> settings_keys();

/// Title, duration, accuracy, integrator, detection and output.
void read_settings(const TableReader& document, Scenario& scenario);

/// The settings as JSON text, see Scenario::settings_json.
std::string settings_as_json(const Scenario& scenario);

}  // namespace articular::sim
