#pragma once

#include <optional>
#include <vector>

#include "model/contact/near_pairs.hpp"
#include "model/elastic/contact/piece_surface.hpp"
#include "model/hinge/element.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// A point of one piece pressed into another one through a face.
struct PieceTouch {
  int piece = 0, point = 0;  ///< which of its points
  int other = 0,
      face = 0;      ///< the piece that it is in, and the face of that one's surface that is nearest to it
  double depth = 0;  ///< cell edges, > 0
};

/// Contact of bodies of any shape by their convex pieces, energies in units of k_point edge^2, stiffnesses of k_point: points of
/// each piece - its corners, and others along its edges and over its faces - inside pieces of other bodies, with the energy
/// 1/2 weight contact depth^2 a point. The depth is that to the nearest face on the other body's surface, as of walls (ContactModel):
/// linear in the carried point. Edges that cross between two points are not seen.
class PieceContact {
 public:
  PieceContact(const ConvexBodies& bodies, double edge_mm);

  /// Points in contact, in a fixed order. Empty for poses that are not finite.
  const std::vector<PieceTouch>& find(const State& state);

  /// Whether a point went through a piece between two states, or came in through one face and would be pushed out through another: then
  /// the step between them was too long for contact to stop it. @pre both states are finite
  bool passed_through(const State& before, const State& after);

  int body(int piece) const { return surfaces_[piece].body; }
  /// a is the body of the point, b that of the face.
  Element element(const PieceTouch& touch, double stiffness, const State& state) const;
  double energy(const std::vector<PieceTouch>& touches, double stiffness) const;

 private:
  using PiecePair = std::pair<int, int>;

  /// Pairs that are nearer than a margin by the balls round them. @param margins of each body, cell edges
  std::vector<PiecePair> pairs_within(const State& state, const std::vector<double>& margins);
  bool may_touch(const PiecePair& pair) const;
  /// By how much the points of each body have moved at most, cell edges.
  std::vector<double> moved(const State& from, const State& to) const;
  bool has_left(const State& state) const;
  bool are_apart(int piece, int other, const State& state) const;
  void add_points_inside(int piece, int other, const State& state);
  bool went_through(int piece, int other, const State& before, const State& after) const;
  /// A body's frame as another one sees it, cell edges.
  Pose seen_from(int other, int piece, const State& state) const;

  double edge_mm_;
  std::vector<PieceSurface> surfaces_;
  std::vector<PiecePair> passing_;
  std::vector<double>
      reach_;           ///< of each body: the furthest of its corners from its rest position, cell edges
  double largest_ = 0;  ///< radius of a piece, cell edges
  std::vector<PiecePair> near_;  ///< in near_state_
  State near_state_;
  std::vector<PieceTouch> found_;
  State found_state_;
  NearPairs finder_;
};

}  // namespace kinetix::model
