#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/evaluation_counters.hpp"
#include "sim/contact/body_sweep.hpp"
#include "sim/contact/penetration_search.hpp"
#include "sim/gap/face_bounds.hpp"
#include "sim/model/configuration.hpp"
#include "sim/model/near_contacts.hpp"
#include "sim/model/step_settings.hpp"

/// Who may touch whom during the next step: from penetrations with a margin to
/// pairs of a surface triangle and a facing face of the other body.
namespace articular::sim {

/// A triangle of the contact's non-mortar side may touch a face of the other.
struct ContactCandidate {
  int triangle = 0, face = 0;
  double reach = 0;  // [m] up to this depth the triangle came in through this face
};

struct CandidateList {
  ContactId contact = 0;
  std::vector<ContactCandidate> pairs;
};

/// A triangle and a face that move with the same rigid body, or share a node, do not touch: tissue
/// tied to a rigid body, or neighbours in one tissue.
bool are_tied(const Collider& a, int triangle, const Collider& b, int face);

/// Whether they are the two sides of one part of a body: at the start the triangle lay behind the
/// face, opposite it, at most two elements deep. However thin the body gets there, the triangle has
/// not come in through that face: it would be pressed back through the body, and thin edges shut.
/// @param part  of each node, see fem::parts_of_nodes()
bool are_two_sides(const Collider& body, std::span<const int> part, int triangle, int face);

/// The depths of a side's triangles behind another's faces that count. Deeper than an element of
/// either side it was not this face that was crossed.
DepthRange depth_range(const Collider& triangles, const Collider& faces, bool averaged);

struct SearchCounts {
  std::int64_t tree_updates = 0;
  std::int64_t reported_pairs = 0;  // within the margin
  std::int64_t narrow_tests = 0;
  std::int64_t deep_pairs = 0;  // candidates deeper than depth_range() reaches
  EvaluationCounts evaluations;
  double update_seconds = 0, traversal_seconds = 0, narrow_seconds = 0;
};

class ContactSearch {
 public:
  ContactSearch(const Model& model, const StepSettings& settings);

  /// The first three lines of Listing 1.5.1's loop body: all bodies where they are now, tissues
  /// against each other, then each against itself where the scene asks for it.
  /// @param margin  [m] how much nearer than now things may come: pairs are found that are nearer
  ///                than this and the depth in front of a face at which surfaces count
  void find(const Configuration& configuration, double margin);

  /// The lists that have pairs, in the order of the contacts; until the next find().
  std::span<const CandidateList> candidates() const { return {lists_.data(), num_lists_}; }
  const SearchCounts& counts() const { return counts_; }
  SearchCounts& counts() { return counts_; }

  /// Between the two, some pair of bodies that meet on the way move past each other farther than a
  /// face can be found behind a triangle: one could be through the other at the end.
  bool passes_unseen(const Configuration& from, const Configuration& to);

  /// Of the last find() [m].
  double margin() const { return margin_; }

  /// Largest distance of a node of any collider from where find() had it [m].
  double motion_since(const Configuration& configuration) const;

 private:
  struct Moving {
    int body = 0;
    std::size_t index = 0;         // its own
    std::optional<double> margin;  // [m] of the last update; none yet
    Positions x;                   // where it was found
    std::vector<FaceBounds> faces;
    std::vector<int> part;  // of each node, of a body that touches itself
  };
  void update(Moving& moving, const Configuration& configuration, double margin);
  /// What a body needs that may touch another: done once a detection, if at all.
  void fit(Moving& moving);
  bool needs_update(const Moving& moving, double margin) const;
  bool moves(const Moving& moving) const;
  /// One of the two bodies of a contact, whose triangles look for the other's faces.
  struct Side {
    const Moving *body = nullptr, *other = nullptr;
    Penetrations found;  // triangles of the body in tetrahedra of the other
    std::vector<ContactCandidate> near, deep;
  };
  /// What near bodies are asked: both sides, or the one of a body and itself.
  struct Question {
    ContactId contact = 0;
    ContactModel pair;
    Side a, b;
    bool is_self() const { return pair.a == pair.b; }
  };
  /// Of one thread.
  struct Scratch {
    /// Per face: when it was paired last; of each triangle of each side there is another time.
    std::vector<std::int64_t> seen;
    std::int64_t now = 0;
    /// Triangles that may lie deeper in the other body than the range reaches, with what was found
    /// of each: found[begin .. end).
    struct DeepTriangle {
      std::size_t begin = 0, end = 0;
    };
    std::vector<DeepTriangle> deep;
  };
  void ask(ContactId contact, PenetrationCost& cost);
  void answer(const Question& question);
  void collect(Question& question, bool of_b, Scratch& scratch) const;
  bool may_touch(const Moving& a, int triangle, const Moving& b, int face) const;
  void add_deep_pairs(const DepthRange& range, const Scratch& scratch, Side& side) const;

  const Model& model_;
  std::vector<Moving> moving_;                       // one a collider
  std::unique_ptr<PenetrationSearch> penetrations_;  // of them
  std::vector<int> moving_of_body_;                  // index into moving_, or -1
  Moving& moving_of(int body) {
    return moving_[static_cast<std::size_t>(moving_of_body_[static_cast<std::size_t>(body)])];
  }
  NearContacts near_;
  // Scratch of a question, by body: where they are, or all the way that they go.
  std::vector<collision::Aabb> boxes_;
  std::vector<BodySweep> sweeps_;
  std::vector<CandidateList> lists_;  // never shrinks: the first ones are candidates
  std::size_t num_lists_ = 0;
  double margin_ = 0;                // [m]
  double open_depth_ = 0;            // [m] largest of all sides that are averaged over
  std::vector<Question> questions_;  // never shrinks: the first ones are of this find()
  std::size_t num_questions_ = 0;
  std::vector<Scratch> scratch_;  // by worker
  SearchCounts counts_;
};

}  // namespace articular::sim
