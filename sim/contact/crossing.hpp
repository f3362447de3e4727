#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/contact/contact_response.hpp"
#include "sim/model/configuration.hpp"

/// Do surfaces go through each other from one accepted state to the next?
///
/// Contact keeps apart what it finds at a shallow depth. What a step has carried farther into
/// another body, or through it, meets no face that opposes it: there it ends without a force. So
/// each step is looked at as a whole. A point of a surface that moves straight from its place at
/// the start to that at the end has crossed the surface of another body when it
///
/// - came in through a face, or lay behind it at the start, no deeper than contact was, and
/// - is at the end farther behind that face than half the reach,
/// - has left through a face that looks the other way, or is now nearest to one. Of a body that is
///   a surface alone it has crossed too when it lies below the shell, and
/// - half-way to there lay deeper than a quarter of the reach: what slid along a surface did not.
///
/// A body that is pressed deeply into a thick one has not: the way out still leads back, and the
/// search follows (ContactSearch). Nor has a path that cuts a corner, as those of long steps do. A
/// body that touches itself has no inside that can be told by the nearest face: there a point that
/// came in counts where it lies deeper than the reach, and one that lay in a fold where it left
/// through the other side.
///
/// Points are the nodes, and the middles of edges and faces. Bars one element thick that pass
/// crosswise between them are not seen. Nor is what moves in and out within a step.
namespace articular::sim {

struct Crossing {
  int body = 0, through = 0;  // a point of the first went through the surface of the second
  Vec3 place = Vec3::Zero();  // where it came in [m]
  double depth = 0;           // [m] behind that face at the end
};

class CrossingSearch {
 public:
  explicit CrossingSearch(const Model& model);
  ~CrossingSearch();

  /// The deepest between two states.
  /// @param depths  of any point at the start, ContactResponse::point_depths(). Pairs that move by
  ///                too little to cross at this depth are passed over
  std::optional<Crossing> find(const Configuration& from, const Configuration& to,
                               const ContactDepths& depths);

  /// Pairs of bodies whose points were looked at one by one, since it was made.
  std::int64_t pairs_looked_at() const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

/// "`a` goes through `b` at (1.000 2.000 3.000) mm, by 4 mm".
std::string words_for(const Model& model, const Crossing& crossing);

}  // namespace articular::sim
