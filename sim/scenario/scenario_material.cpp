// The material of a tissue: its law with the constants, its fibres and its damping.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fem/material/any_material.hpp"
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

enum class Law {
  Linear,
  Corotated,
  StVenantKirchhoff,
  NeoHookean,
  CoupledNeoHookean,
  HolmesMow,
  IsochoricNeoHookean,
  MooneyRivlin,
  Yeoh,
  Ogden,
  VerondaWestmann,
  TransverselyIsotropic,
  Muscle
};

/// Words of laws, and what they are for.
struct LawName {
  Law law;
  std::string_view word, purpose;
};
constexpr LawName kLaws[] = {
    {Law::Linear, "linear", "small strain"},
    {Law::Corotated, "corotated", "large rotation"},
    {Law::StVenantKirchhoff, "st-venant-kirchhoff", "large rotation, moderate strain"},
    {Law::NeoHookean, "neo-hookean", "large strain"},
    {Law::CoupledNeoHookean, "coupled-neo-hookean", "large strain, with ln J"},
    {Law::HolmesMow, "holmes-mow", "cartilage without its fluid: stiffens as it is pressed"},
    {Law::IsochoricNeoHookean, "isochoric-neo-hookean", "nearly incompressible tissue"},
    {Law::MooneyRivlin, "mooney-rivlin", "nearly incompressible tissue"},
    {Law::Yeoh, "yeoh", "tongue, face"},
    {Law::Ogden, "ogden", "brain, fat, rubber"},
    {Law::VerondaWestmann, "veronda-westmann", "skin"},
    {Law::TransverselyIsotropic, "transversely-isotropic", "ligament, tendon, meniscus"},
    {Law::Muscle, "muscle", "muscle"}};

const KeyTable& force_length_keys() {
  static const KeyTable kTable{
      "force_length",
      {{"sarcomere_length",
        {form::Quantity{kLength, kPositive}},
        standard("1.85 um"),
        "length of a sarcomere at rest; l is this times the fibre stretch"},
       {"zero_length",
        {form::Quantity{kLength, kPositive}},
        standard("1.58 um"),
        "l0: up to this length there is no active stress"},
       {"b",
        {form::Quantity{kPerLength, kPositive}},
        standard("4.75 1/um"),
        "how fast it rises beyond"},
       {"calcium", {form::Number{kPositive}}, standard(4.35), "Ca in µmol/l"},
       {"max_calcium",
        {form::Number{kPositive}},
        standard(4.35),
        "Camax in µmol/l, which Ca does not exceed"}}};
  return kTable;
}

const KeyTable& ogden_term_keys() {
  static const KeyTable kTable{"term of `terms`",
                               {{"c",
                                 {form::Quantity{kStress, kPositive}},
                                 kRequired,
                                 "adds the energy c/m² (λ̃1^m + λ̃2^m + λ̃3^m − 3)"},
                                {"m", {form::Number{kAny}}, kRequired, "exponent, not 0"}}};
  return kTable;
}

std::vector<Key> fibre_direction_keys() {
  return {{"direction", {form::Direction{}}, kNone, "the same everywhere; or one of the next"},
          {"array", {form::Text{"name of a cell array"}}, kNone, "as the mesh has them"},
          {"from",
           {form::Table{region_keys}},
           kNone,
           "along the gradient of a harmonic field, from this region"},
          {"to", {form::Table{region_keys}}, kNone, "to this one"}};
}

const KeyTable& relaxation_term_keys() {
  static const KeyTable kTable{
      "term of `relaxation`",
      {{"weight",
        {form::Number{kPositive}},
        kRequired,
        "part of the stress that relaxes; all weights sum to below 1"},
       {"time", {form::Quantity{kTime, kPositive}}, kRequired, "its time constant"}}};
  return kTable;
}

/// As a law says in fem/material, where the value has no place in the file.
constexpr Range kHolmesMowRatio{0, 1.0 / 3 + 1e-6, false,
                                "must lie between 0 and 1/3 (others soften in tension)",
                                "Poisson's ratio of the law \"holmes-mow\""};

constexpr Range kPrestretchRange{0.5, 2, false,
                                 "must lie between 0.5 and 2: fibres that are drawn out by 3 % "
                                 "have 1.03"};

Key stress_key(std::string_view name, const Range& range, Absence absence,
               std::string_view meaning) {
  return {name, {form::Quantity{kStress, range}}, absence, meaning};
}
Key number_key(std::string_view name, const Range& range, Absence absence,
               std::string_view meaning) {
  return {name, {form::Number{range}}, absence, meaning};
}
Key volumetric_key(const char* word) {
  return {"volumetric",
          {form::Choice{{{"quadratic", false}, {"logarithmic", true}}}},
          standard(word),
          "κ/2 (J − 1)² or κ/2 (ln J)²"};
}
Key fibres_key() {
  return {"fibres", {form::Table{material_fibres_keys}}, kRequired, "directions at the start"};
}

/// Those that a law has, beside what every tissue may have.
std::vector<Key> constants_of(Law law) {
  const Key E{"young_modulus", {form::Quantity{kStress, kPositive}}, kRequired, "Young's modulus"};
  const Key nu{"poisson_ratio", {form::Number{kPoissonRange}}, kRequired, "Poisson's ratio"};
  const Key c10 = stress_key("c10", kNotNegative, kRequired, "of I1 − 3"),
            c01 = stress_key("c01", kNotNegative, standard("0 Pa"), "of I2 − 3"),
            kappa = stress_key("bulk_modulus", kPositive, kRequired, "κ, bulk modulus"),
            volumetric = volumetric_key("quadratic");
  switch (law) {
    case Law::Linear:
    case Law::Corotated:
    case Law::StVenantKirchhoff:
    case Law::NeoHookean:
    case Law::CoupledNeoHookean:
      return {E, nu};
    case Law::HolmesMow:
      return {E, number_key("poisson_ratio", kHolmesMowRatio, kRequired, "Poisson's ratio"),
              number_key("beta", kPositive, kRequired, "how fast it stiffens")};
    case Law::IsochoricNeoHookean:
      return {E, nu, volumetric};
    case Law::MooneyRivlin:
      return {c10, c01, kappa, volumetric};
    case Law::Yeoh:
      return {stress_key("c10", kPositive, kRequired, "of I1 − 3"),
              stress_key("c20", kNotNegative, kRequired, "of (I1 − 3)²"), kappa, volumetric};
    case Law::Ogden:
      return {{"terms",
               {list_of({form::Table{ogden_term_keys}})},
               kRequired,
               "each adds an energy; the shear modulus is half the sum of all `c`"},
              kappa,
              volumetric};
    case Law::VerondaWestmann:
      return {stress_key("c1", kPositive, kRequired, "of the exponential in I1 − 3"),
              number_key("c2", kPositive, kRequired, "its exponent"), kappa, volumetric};
    case Law::TransverselyIsotropic:
      return {c10,
              c01,
              stress_key("c3", kPositive, kRequired, "of the fibres' toe"),
              number_key("c4", kPositive, kRequired, "exponent of the toe"),
              stress_key("c5", kPositive, kRequired, "modulus of straight fibres"),
              number_key("toe_end", kMoreThanOne, kRequired,
                         "fibre stretch at which the curve becomes straight"),
              number_key("prestretch", kPrestretchRange, standard(1.0),
                         "length of the fibres at the start by their length in free tissue"),
              stress_key("active_stress", kNotNegative, standard("0 Pa"),
                         "force of fully activated fibres per area at rest, at any length"),
              {"force_length",
               {form::Table{force_length_keys}},
               kNone,
               "how `active_stress` depends on length; `{}`: cardiac muscle (Guccione 1993)"},
              kappa,
              volumetric,
              fibres_key()};
    case Law::Muscle:
      return {
          stress_key("max_stress", kPositive, standard("0.3 MPa"), "greatest active stress"),
          number_key("p1", kPositive, standard(0.05), "factor of the passive curve"),
          number_key("p2", kPositive, standard(6.6), "exponent of the passive curve"),
          number_key("toe_end", kMoreThanOne, standard(1.4),
                     "fibre length per optimal length at which the passive curve becomes "
                     "straight"),
          number_key("optimal_stretch", kOneOrMore, standard(1.0),
                     "stretch of greatest active force"),
          number_key("tendon_ratio", kFraction, standard(0.0),
                     "part of the fibres' line that is tendon and does not stretch, below 1"),
          {"descending_limb",
           {form::Boolean{}},
           standard(true),
           "`false`: fibres beyond their optimal length pull as hard as at it"},
          {"max_velocity",
           {form::Quantity{kRate, kPositive}},
           kNone,
           "largest speed of shortening in optimal lengths per second; none: force does not "
           "depend on speed"},
          stress_key("shear_along", kPositive, standard("500 Pa"),
                     "shear modulus along the fibres"),
          stress_key("shear_across", kPositive, standard("500 Pa"), "shear modulus across them"),
          stress_key("c10", kNotNegative, standard("0 Pa"), "of I1 − 3"),
          stress_key("active_c10", kNotNegative, standard("0 Pa"),
                     "what full activation adds to it"),
          stress_key("bulk_modulus", kPositive, standard("10 MPa"), "κ, bulk modulus"),
          volumetric_key("logarithmic"),
          fibres_key()};
  }
  return {};
}

template <std::size_t I>
const KeyTable& material_keys() {
  static const KeyTable kTable = [] {
    const LawName& name = kLaws[I];
    KeyTable table{"material",
                   {{"law", {form::Choice{{{name.word, name.law}}}}, kRequired, name.purpose}}};
    for (Key& key : constants_of(name.law)) table.keys.push_back(std::move(key));
    table.keys.push_back(
        {"element",
         {form::Choice{{{"plain", TissueMaterial::Element::Plain},
                        {"smoothed", TissueMaterial::Element::Smoothed}}}},
         standard("smoothed"),
         "smoothed tetrahedra bend rightly and do not lock; plain ones are faster"});
    table.keys.push_back({"mass_damping",
                          {form::Quantity{kRate, kNotNegative}},
                          standard("0 1/s"),
                          "Rayleigh's α; also slows free flight"});
    table.keys.push_back({"stiffness_damping",
                          {form::Quantity{kTime, kNotNegative}},
                          standard("0 s"),
                          "Rayleigh's β"});
    // The stress of the linear law does not turn with rotations.
    if (name.law != Law::Linear)
      table.keys.push_back({"relaxation",
                            {list_of({form::Table{relaxation_term_keys}})},
                            kNone,
                            "Prony series of the distortion; statics has it all gone"});
    return table;
  }();
  return kTable;
}

template <std::size_t... I>
form::Variants variants_of_laws(std::index_sequence<I...>) {
  return {"material", "law", "the law is", {{kLaws[I].word, material_keys<I>}...}};
}

Law read_law_name(const Node& node) {
  return std::find_if(std::begin(kLaws), std::end(kLaws),
                      [&](const LawName& name) { return name.word == *node.text(); })
      ->law;
}

double stress(const TableReader& table, std::string_view key) { return table.get<double>(key); }
double number(const TableReader& table, std::string_view key) { return table.get<double>(key); }

fem::ForceLength read_force_length(const Node& node) {
  const TableReader table(node, force_length_keys(), "force_length");
  const fem::ForceLength::Constants c{.sarcomere_length = table.get<double>("sarcomere_length"),
                                      .zero_length = table.get<double>("zero_length"),
                                      .b = table.get<double>("b"),
                                      .calcium = table.get<double>("calcium"),
                                      .max_calcium = table.get<double>("max_calcium")};
  try {
    return fem::ForceLength(c);
  } catch (const std::invalid_argument& error) {
    fail(node, error.what());
  }
}

fem::ToeLinearFibre read_collagen(const TableReader& table) {
  return fem::ToeLinearFibre({.c3 = stress(table, "c3"),
                              .c4 = number(table, "c4"),
                              .c5 = stress(table, "c5"),
                              .toe_end = number(table, "toe_end")});
}

fem::ActiveFibre read_active_fibre(const TableReader& table) {
  fem::ActiveFibre::Constants c{.stress = stress(table, "active_stress"), .force_length = {}};
  if (c.stress == 0)
    table.refuse({"force_length"}, "without `active_stress` there is nothing that depends on it");
  table.read("force_length", c.force_length, read_force_length);
  return fem::ActiveFibre(c);
}

std::vector<fem::OgdenTerm> read_ogden_terms(const Node& node) {
  std::vector<fem::OgdenTerm> terms;
  for (const Node& element :
       read_list(node, "a list of terms such as [{ c = \"10 kPa\", m = 2.5 }, ...]")) {
    const TableReader table(element, ogden_term_keys(), "term of `terms`");
    terms.push_back({.c = stress(table, "c"), .m = number(table, "m")});
    try {
      (void)fem::IsochoricOgden(std::vector{terms.back()});
    } catch (const std::invalid_argument& error) {
      fail(table.at("m"), error.what());
    }
  }
  return terms;
}

fem::MuscleFibre read_muscle_fibre(const TableReader& table) {
  std::optional<double> max_velocity;
  table.read("max_velocity", max_velocity);
  return fem::MuscleFibre({.max_stress = stress(table, "max_stress"),
                           .p1 = number(table, "p1"),
                           .p2 = number(table, "p2"),
                           .toe_end = number(table, "toe_end"),
                           .optimal_stretch = number(table, "optimal_stretch"),
                           .tendon_ratio = number(table, "tendon_ratio"),
                           .descending_limb = table.get<bool>("descending_limb"),
                           .max_velocity = max_velocity});
}

/// Laws with a volumetric energy κ/2 Θ².
template <fem::DilatationMeasure Theta>
fem::AnyMaterial read_split_law(const TableReader& table, Law law) {
  switch (law) {
    case Law::MooneyRivlin:
      return fem::MooneyRivlin<Theta>(stress(table, "c10"), stress(table, "c01"),
                                      stress(table, "bulk_modulus"));
    case Law::Yeoh:
      return fem::Yeoh<Theta>(stress(table, "c10"), stress(table, "c20"),
                              stress(table, "bulk_modulus"));
    case Law::Ogden:
      return fem::Ogden<Theta>(read_ogden_terms(table.at("terms")), stress(table, "bulk_modulus"));
    case Law::VerondaWestmann:
      return fem::VerondaWestmann<Theta>(stress(table, "c1"), number(table, "c2"),
                                         stress(table, "bulk_modulus"));
    case Law::TransverselyIsotropic:
      return fem::TransverselyIsotropic<Theta>(
          stress(table, "c10"), stress(table, "c01"), read_collagen(table),
          stress(table, "bulk_modulus"), read_active_fibre(table), number(table, "prestretch"));
    case Law::Muscle: {
      return fem::BlemkerMuscle<Theta>(read_muscle_fibre(table),
                                       {.G1 = stress(table, "shear_along"),
                                        .G2 = stress(table, "shear_across"),
                                        .c10 = stress(table, "c10"),
                                        .active_c10 = stress(table, "active_c10"),
                                        .kappa = stress(table, "bulk_modulus")});
    }
    default: {
      const auto [mu, lambda] =
          fem::lame_parameters(stress(table, "young_modulus"), number(table, "poisson_ratio"));
      return fem::MooneyRivlin<Theta>(mu / 2, 0, lambda + 2 * mu / 3);
    }
  }
}

/// Laws of Young's modulus and Poisson's ratio with a change of volume of their own.
std::optional<fem::AnyMaterial> read_coupled_law(const TableReader& table, Law law) {
  const auto E = [&] { return stress(table, "young_modulus"); };
  const auto nu = [&] { return number(table, "poisson_ratio"); };
  switch (law) {
    case Law::Linear:
      return fem::Linear(E(), nu());
    case Law::Corotated:
      return fem::Corotated(E(), nu());
    case Law::StVenantKirchhoff:
      return fem::StVenantKirchhoff(E(), nu());
    case Law::NeoHookean:
      return fem::NeoHookean(E(), nu());
    case Law::CoupledNeoHookean:
      return fem::CoupledNeoHookean(E(), nu());
    case Law::HolmesMow:
      return fem::HolmesMow(E(), nu(), number(table, "beta"));
    default:
      return std::nullopt;
  }
}

fem::AnyMaterial read_law(const TableReader& table, Law law) {
  if (std::optional<fem::AnyMaterial> coupled = read_coupled_law(table, law)) return *coupled;
  return table.get<bool>("volumetric") ? read_split_law<fem::LogVolumeChange>(table, law)
                                       : read_split_law<fem::VolumeChange>(table, law);
}

std::vector<fem::PronyTerm> read_relaxation(const Node& node) {
  std::vector<fem::PronyTerm> terms;
  double sum = 0;
  for (const Node& element :
       read_list(node, "a list of terms such as [{ weight = 0.3, time = \"50 ms\" }, ...]")) {
    const TableReader table(element, relaxation_term_keys(), "term of `relaxation`");
    terms.push_back({.weight = table.get<double>("weight"), .time = table.get<double>("time")});
    sum += terms.back().weight;
  }
  if (!(sum < 1))
    fail(node, fmt::format("the weights sum up to {:.4g}, which must be below 1: nothing would be "
                           "left of the stress",
                           sum));
  return terms;
}

}  // namespace

const KeyTable& material_fibres_keys() {
  static const KeyTable kTable = [] {
    KeyTable table{"fibres", fibre_direction_keys()};
    table.keys.push_back(
        {"density",
         {form::Choice{
             {{"even", Fibres::Density::Even}, {"conserved", Fibres::Density::Conserved}}}},
         standard("even"),
         "the law's stress everywhere; or the same fibres from end to end: times the length of the "
         "array's vectors, or the flux of the field, whose mean is 1"});
    return table;
  }();
  return kTable;
}

const KeyTable& sheet_fibres_keys() {
  static const KeyTable kTable{"fibres of a sheet", fibre_direction_keys()};
  return kTable;
}

Fibres read_fibres(const Node& node, const KeyTable& keys, const Context& context) {
  const TableReader table(node, keys, "fibres");
  const auto region = [&](const Node& n) { return read_region(n, context); };
  Fibres fibres;
  fibres.where = node.where;
  const bool has_density = table.knows("density");
  if (table.find("from") != nullptr || table.find("to") != nullptr) {
    table.refuse({"direction", "array"}, "the fibres run between two regions");
    fibres.along = FibresBetween{region(table.at("from")), region(table.at("to"))};
    if (has_density) table.read("density", fibres.density);
    return fibres;
  }
  table.exactly_one({"direction", "array"});
  table.read("direction", fibres.along,
             [&](const Node& n) { return context.point(read_direction(n)); });
  table.read("array", fibres.along, [](const Node& n) { return FibreArray{read_text(n)}; });
  if (!has_density) return fibres;
  if (std::holds_alternative<FibreArray>(fibres.along))
    table.read("density", fibres.density);
  else
    table.refuse({"density"}, "fibres of one direction are alike everywhere");
  return fibres;
}

const form::Variants& material_variants() {
  static const form::Variants kVariants =
      variants_of_laws(std::make_index_sequence<std::size(kLaws)>());
  return kVariants;
}

TissueMaterial read_material(const Node& node) {
  const TableReader table(node, material_variants(), "material");
  const Law law = read_law_name(table.at("law"));
  static const std::vector<Body> no_bodies;  // regions of its fibres are those of this body alone
  const Context of_this_body{{}, no_bodies, nullptr};
  TissueMaterial material;
  material.where = node.where;
  try {
    material.law = std::make_shared<const fem::AnyMaterial>(read_law(table, law));
  } catch (const std::invalid_argument& error) {
    throw InputError(node.where, fmt::format("material: {}", error.what()));
  }
  if (law == Law::TransverselyIsotropic || law == Law::Muscle)
    material.fibres = read_fibres(table.at("fibres"), material_fibres_keys(), of_this_body);
  table.read("element", material.element);
  table.read("mass_damping", material.mass_damping);
  table.read("stiffness_damping", material.stiffness_damping);
  if (table.knows("relaxation")) table.read("relaxation", material.relaxation, read_relaxation);
  return material;
}

}  // namespace articular::sim
