// The material of a tissue: its law with the constants, its fibres and its damping.
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "fem/material/any_material.hpp"
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
Law read_law_name(const Node& node) {
  return read_choice<Law>(node, {{"linear", Law::Linear},
                                 {"corotated", Law::Corotated},
                                 {"st-venant-kirchhoff", Law::StVenantKirchhoff},
                                 {"neo-hookean", Law::NeoHookean},
                                 {"coupled-neo-hookean", Law::CoupledNeoHookean},
                                 {"holmes-mow", Law::HolmesMow},
                                 {"isochoric-neo-hookean", Law::IsochoricNeoHookean},
                                 {"mooney-rivlin", Law::MooneyRivlin},
                                 {"yeoh", Law::Yeoh},
                                 {"ogden", Law::Ogden},
                                 {"veronda-westmann", Law::VerondaWestmann},
                                 {"transversely-isotropic", Law::TransverselyIsotropic},
                                 {"muscle", Law::Muscle}});
}

/// Those that a law has, beside what every tissue may have.
std::vector<std::string_view> keys_of(Law law) {
  switch (law) {
    case Law::Linear:
    case Law::Corotated:
    case Law::StVenantKirchhoff:
    case Law::NeoHookean:
    case Law::CoupledNeoHookean:
      return {"young_modulus", "poisson_ratio"};
    case Law::HolmesMow:
      return {"young_modulus", "poisson_ratio", "beta"};
    case Law::IsochoricNeoHookean:
      return {"young_modulus", "poisson_ratio", "volumetric"};
    case Law::MooneyRivlin:
      return {"c10", "c01", "bulk_modulus", "volumetric"};
    case Law::Yeoh:
      return {"c10", "c20", "bulk_modulus", "volumetric"};
    case Law::Ogden:
      return {"terms", "bulk_modulus", "volumetric"};
    case Law::VerondaWestmann:
      return {"c1", "c2", "bulk_modulus", "volumetric"};
    case Law::TransverselyIsotropic:
      return {"c10",           "c01",          "c3",           "c4",         "c5",    "toe_end",
              "active_stress", "force_length", "bulk_modulus", "volumetric", "fibres"};
    case Law::Muscle:
      return {"max_stress",   "p1",  "p2",           "toe_end",    "optimal_stretch", "shear_along",
              "shear_across", "c10", "bulk_modulus", "volumetric", "fibres"};
  }
  return {};
}

void refuse_other_keys(const TableReader& table, Law law,
                       std::initializer_list<std::string_view> keys) {
  std::vector<std::string_view> known = keys_of(law);
  known.insert(known.end(), {"law", "element", "mass_damping", "stiffness_damping", "relaxation"});
  for (const std::string_view key : keys)
    if (std::find(known.begin(), known.end(), key) == known.end())
      table.refuse({key}, fmt::format("the law is {}", found(table.at("law"))));
}

double stress(const TableReader& table, std::string_view key) {
  return read_quantity(table.at(key), kStress, kNotNegative);
}
double stress_or(const TableReader& table, std::string_view key, double otherwise) {
  table.may(key, otherwise, as_quantity(kStress, kNotNegative));
  return otherwise;
}
double number(const TableReader& table, std::string_view key) {
  return read_number(table.at(key), kPositive);
}
double number_or(const TableReader& table, std::string_view key, double otherwise) {
  table.may(key, otherwise, as_number(kPositive));
  return otherwise;
}

fem::ForceLength read_force_length(const Node& node) {
  const TableReader table(node, "force_length",
                          {"sarcomere_length", "zero_length", "b", "calcium", "max_calcium"});
  fem::ForceLength::Constants c;  // as published
  table.may("sarcomere_length", c.sarcomere_length, as_quantity(kLength, kPositive));
  table.may("zero_length", c.zero_length, as_quantity(kLength, kPositive));
  table.may("b", c.b, as_quantity(kPerLength, kPositive));
  table.may("calcium", c.calcium, as_number(kPositive));
  table.may("max_calcium", c.max_calcium, as_number(kPositive));
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
  fem::ActiveFibre::Constants c{.stress = stress_or(table, "active_stress", 0), .force_length = {}};
  if (c.stress == 0)
    table.refuse({"force_length"}, "without `active_stress` there is nothing that depends on it");
  table.may("force_length", c.force_length, read_force_length);
  return fem::ActiveFibre(c);
}

std::vector<fem::OgdenTerm> read_ogden_terms(const Node& node) {
  std::vector<fem::OgdenTerm> terms;
  for (const Node& element :
       read_list(node, "a list of terms such as [{ c = \"10 kPa\", m = 2.5 }, ...]")) {
    const TableReader table(element, "term of `terms`", {"c", "m"});
    terms.push_back({.c = read_quantity(table.at("c"), kStress, kPositive),
                     .m = read_number(table.at("m"), kAny)});
    try {
      (void)fem::IsochoricOgden(std::vector{terms.back()});
    } catch (const std::invalid_argument& error) {
      fail(table.at("m"), error.what());
    }
  }
  return terms;
}

fem::MuscleFibre read_muscle_fibre(const TableReader& table) {
  const fem::MuscleFibre::Constants published;
  return fem::MuscleFibre(
      {.max_stress = stress_or(table, "max_stress", published.max_stress),
       .p1 = number_or(table, "p1", published.p1),
       .p2 = number_or(table, "p2", published.p2),
       .toe_end = number_or(table, "toe_end", published.toe_end),
       .optimal_stretch = number_or(table, "optimal_stretch", published.optimal_stretch)});
}

/// Laws with a volumetric energy κ/2 Θ².
template <fem::DilatationMeasure Theta>
fem::AnyMaterial read_split_law(const TableReader& table, Law law) {
  switch (law) {
    case Law::MooneyRivlin:
      return fem::MooneyRivlin<Theta>(stress(table, "c10"), stress_or(table, "c01", 0),
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
      return fem::TransverselyIsotropic<Theta>(stress(table, "c10"), stress_or(table, "c01", 0),
                                               read_collagen(table), stress(table, "bulk_modulus"),
                                               read_active_fibre(table));
    case Law::Muscle: {
      const typename fem::BlemkerMuscle<Theta>::Constants published;
      return fem::BlemkerMuscle<Theta>(
          read_muscle_fibre(table), {.G1 = stress_or(table, "shear_along", published.G1),
                                     .G2 = stress_or(table, "shear_across", published.G2),
                                     .c10 = stress_or(table, "c10", published.c10),
                                     .kappa = stress_or(table, "bulk_modulus", published.kappa)});
    }
    default: {
      const auto [mu, lambda] =
          fem::lame_parameters(read_quantity(table.at("young_modulus"), kStress, kPositive),
                               read_number(table.at("poisson_ratio"), kPoissonRange));
      return fem::MooneyRivlin<Theta>(mu / 2, 0, lambda + 2 * mu / 3);
    }
  }
}

/// Laws of Young's modulus and Poisson's ratio with a change of volume of their own.
std::optional<fem::AnyMaterial> read_coupled_law(const TableReader& table, Law law) {
  const auto E = [&] { return read_quantity(table.at("young_modulus"), kStress, kPositive); };
  const auto nu = [&] { return read_number(table.at("poisson_ratio"), kPoissonRange); };
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
  bool logarithmic = law == Law::Muscle;  // as published
  table.may("volumetric", logarithmic, [](const Node& n) {
    return read_choice<bool>(n, {{"quadratic", false}, {"logarithmic", true}});
  });
  return logarithmic ? read_split_law<fem::LogVolumeChange>(table, law)
                     : read_split_law<fem::VolumeChange>(table, law);
}

Fibres read_fibres(const Node& node) {
  const TableReader table(node, "fibres", {"direction", "array", "from", "to"});
  static const std::vector<Body> no_bodies;  // their regions are those of this body alone
  const Context context{{}, no_bodies};
  const auto region = [&](const Node& n) { return read_region(n, context); };
  Fibres fibres;
  fibres.where = node.where;
  if (table.find("from") != nullptr || table.find("to") != nullptr) {
    table.refuse({"direction", "array"}, "the fibres run between two regions");
    fibres.along = FibresBetween{region(table.at("from")), region(table.at("to"))};
    return fibres;
  }
  table.exactly_one({"direction", "array"});
  table.may("direction", fibres.along, read_direction);
  table.may("array", fibres.along, [](const Node& n) { return FibreArray{read_text(n)}; });
  return fibres;
}

std::vector<fem::PronyTerm> read_relaxation(const Node& node) {
  std::vector<fem::PronyTerm> terms;
  double sum = 0;
  for (const Node& element :
       read_list(node, "a list of terms such as [{ weight = 0.3, time = \"50 ms\" }, ...]")) {
    const TableReader table(element, "term of `relaxation`", {"weight", "time"});
    terms.push_back({.weight = read_number(table.at("weight"), kPositive),
                     .time = read_quantity(table.at("time"), kTime, kPositive)});
    sum += terms.back().weight;
  }
  if (!(sum < 1))
    fail(node, fmt::format("the weights sum up to {:.4g}, which must be below 1: nothing would be "
                           "left of the stress",
                           sum));
  return terms;
}

}  // namespace

TissueMaterial read_material(const Node& node) {
  const std::initializer_list<std::string_view> keys = {"law",
                                                        "young_modulus",
                                                        "poisson_ratio",
                                                        "beta",
                                                        "terms",
                                                        "bulk_modulus",
                                                        "volumetric",
                                                        "c10",
                                                        "c01",
                                                        "c20",
                                                        "c1",
                                                        "c2",
                                                        "c3",
                                                        "c4",
                                                        "c5",
                                                        "toe_end",
                                                        "active_stress",
                                                        "force_length",
                                                        "max_stress",
                                                        "p1",
                                                        "p2",
                                                        "optimal_stretch",
                                                        "shear_along",
                                                        "shear_across",
                                                        "fibres",
                                                        "element",
                                                        "mass_damping",
                                                        "stiffness_damping",
                                                        "relaxation"};
  const TableReader table(node, "material", keys);
  const Law law = read_law_name(table.at("law"));
  refuse_other_keys(table, law, keys);
  TissueMaterial material;
  material.where = node.where;
  try {
    material.law = std::make_shared<const fem::AnyMaterial>(read_law(table, law));
  } catch (const std::invalid_argument& error) {
    throw InputError(node.where, fmt::format("material: {}", error.what()));
  }
  if (law == Law::TransverselyIsotropic || law == Law::Muscle)
    material.fibres = read_fibres(table.at("fibres"));
  table.may("element", material.element, [](const Node& n) {
    return read_choice<TissueMaterial::Element>(n,
                                                {{"plain", TissueMaterial::Element::Plain},
                                                 {"smoothed", TissueMaterial::Element::Smoothed}});
  });
  table.may("mass_damping", material.mass_damping, as_quantity(kRate, kNotNegative));
  table.may("stiffness_damping", material.stiffness_damping, as_quantity(kTime, kNotNegative));
  table.may("relaxation", material.relaxation, read_relaxation);
  if (law == Law::Linear)
    table.refuse({"relaxation"},
                 "the law is \"linear\", whose stress does not turn with rotations");
  return material;
}

}  // namespace articular::sim
