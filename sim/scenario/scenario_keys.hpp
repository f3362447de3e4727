#pragma once

#include "sim/scenario/key_table.hpp"

/// The keys of a scenario file. Each table stands beside the function that reads it.
namespace articular::sim {

const KeyTable& scenario_keys();  // of the file as a whole: all others are reached from it

const KeyTable& integrator_keys();
const KeyTable& detection_keys();
const KeyTable& output_keys();
const KeyTable& body_keys();
const KeyTable& attach_keys();
const KeyTable& support_keys();
const KeyTable& sheet_keys();
const KeyTable& muscle_keys();
const KeyTable& muscle_table_keys();
const KeyTable& excitations_keys();
const KeyTable& ligament_keys();
const KeyTable& bolus_keys();
const KeyTable& contact_keys();
const form::Variants& load_variants();
const form::Variants& probe_variants();

// Parts of entries.
const KeyTable& mesh_keys();
const KeyTable& contact_mesh_keys();
const KeyTable& geometry_keys();
const form::Variants& material_variants();
const KeyTable& material_fibres_keys();
const KeyTable& sheet_fibres_keys();  // they are as dense as the sheet is thick
const KeyTable& region_keys();
const KeyTable& place_keys();
const KeyTable& curve_keys();
const KeyTable& path_point_keys();

/// A curve, or the name of one in [curve].
KeyType curve_or_name();

/// `when` of an entry: choices that it needs. In no table: it is gone before the entry is read, see
/// scenario_choices.hpp.
Key when_key();
/// `mirror` of an entry that exists on two sides.
Key mirror_key();

/// Lists that several keys take.
form::List names_of_bodies(std::size_t count);
form::List list_of_times();
form::List list_of_freedoms();

}  // namespace articular::sim
