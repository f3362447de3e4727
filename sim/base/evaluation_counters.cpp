#include "sim/base/evaluation_counters.hpp"

namespace articular::sim {

std::string_view name_of(Term term) {
  constexpr std::array<std::string_view, kNumTerms> kNames{"elastic_force",     "elastic_stiffness",
                                                           "fibre_muscle",      "tissue_damping",
                                                           "relaxation",        "sheet",
                                                           "line_muscle",       "ligament",
                                                           "gravity",           "load",
                                                           "inertia",           "contact_force",
                                                           "contact_stiffness", "friction",
                                                           "contact_damping",   "body_update",
                                                           "fixed_body_update", "box_test",
                                                           "tree_fit",          "pair_query",
                                                           "self_query"};
  static_assert(!kNames.back().empty());
  return kNames[static_cast<std::size_t>(term)];
}

EvaluationCounts& EvaluationCounts::operator+=(const EvaluationCounts& other) {
  for (std::size_t i = 0; i < kNumTerms; ++i) counts_[i] += other.counts_[i];
  return *this;
}

EvaluationCounts& EvaluationCounts::operator-=(const EvaluationCounts& other) {
  for (std::size_t i = 0; i < kNumTerms; ++i) counts_[i] -= other.counts_[i];
  return *this;
}

}  // namespace articular::sim
