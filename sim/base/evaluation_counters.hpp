#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace articular::sim {

/// What a step may have to evaluate.
enum class Term {
  // Forces and matrices, each time for one tissue, line, load or side of a contact pair:
  ElasticForce,
  ElasticStiffness,
  FibreMuscle,  // of these, where a muscle activates the fibres
  TissueDamping,
  Relaxation,
  Sheet,
  LineMuscle,
  Ligament,
  Gravity,  // once for all
  Load,
  Inertia,  // once for all: rates, products with the masses, matrices that have them
  ContactForce,
  ContactStiffness,
  Friction,
  ContactDamping,
  // Detection:
  BodyUpdate,  // of the collision mesh of a body that moves
  FixedBodyUpdate,
  BoxTest,    // of two bodies that can meet
  TreeFit,    // of the tree of a body that moves, once in a detection, if at all
  PairQuery,  // of two bodies' trees
  SelfQuery,  // of a body's tree with itself
  Count
};

inline constexpr std::size_t kNumTerms = static_cast<std::size_t>(Term::Count);

/// For results: "elastic_force".
std::string_view name_of(Term term);

/// How often each was evaluated: it says what a scene costs, and that what it does not have costs
/// nothing.
class EvaluationCounts {
 public:
  std::int64_t& operator[](Term term) { return counts_[static_cast<std::size_t>(term)]; }
  std::int64_t operator[](Term term) const { return counts_[static_cast<std::size_t>(term)]; }
  EvaluationCounts& operator+=(const EvaluationCounts& other);
  EvaluationCounts& operator-=(const EvaluationCounts& other);

 private:
  std::array<std::int64_t, kNumTerms> counts_{};
};

}  // namespace articular::sim
