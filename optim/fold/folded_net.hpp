#pragma once

#include "model/base/geometry.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/family/net.hpp"
#include "targets/fold/fold_error.hpp"

namespace kinetix::optim {

/// A net with the hinges that fold it, and its error.
struct FoldedNet {
  targets::FoldNet net;
  targets::NetLayout layout;
  model::Structure structure;
  model::NetTree tree;       ///< of the structure, from the middle of the first face
  std::vector<double> tilt;  ///< of each crease, rad, >= 0: size of the tilt of all its walls
  double theta = 0;          ///< rad
  targets::FoldError error;  ///< of the closed form at theta
};

/// Returns the net with each crease's fold spread evenly over its columns. Tilts follow from tan(fold / 2k) =
/// tan(tilt) sin(theta) and are cut off at `max_tilt`.
/// @param columns k of each crease, >= 1   @param theta rad, (0, pi / 2)   @param max_tilt rad, (0, pi / 2)
/// @throws InvalidInput for columns with which the net overlaps itself
FoldedNet fold_to(const targets::FoldNet& net, const std::vector<int>& columns, double theta,
                  const model::CellSize& size, double max_tilt);

/// Returns the part of the net of each body: its face, or the number of faces plus the index of the crease
/// with the body between its columns.
std::vector<int> parts_of_bodies(const FoldedNet& folded);

/// "face `lid`" or "crease `base-lid`"
std::string part_name(const targets::FoldNet& net, int part);

/// Two faces that are too close.
struct FaceCrossing {
  int first = 0, second = 0;  ///< indices of the faces
  double theta = 0;           ///< rad; the faces are apart up to here
};

/// Checks whether faces without a common crease stay apart from flat to theta, with the thickness and height
/// of their walls. Steps of theta are short enough to miss no motion between them: the gap of two faces over
/// a bound of their closing speed. The bound contains the derivatives of the creases between them times the
/// length of net that these carry, the shortening of the lattice and the turn of the bodies.
/// @return the first two faces whose walls come within a fiftieth of the cell edge
std::optional<FaceCrossing> first_face_crossing(const FoldedNet& folded);

/// Rad of theta between checked states: contact that begins and ends within one step is missed.
inline constexpr double sample_step = 1 * radians_per_degree;

/// Returns the theta values to check on the path from flat to theta, rad, > 0: at most sample_step apart, the
/// last at theta.
std::vector<double> sample_thetas(double theta);

/// Checks states on the path of a fold for overlapping walls, several in parallel.
class MotionOverlapSearch {
 public:
  /// @param clearance added to the thickness and height of walls for the checks, cell edges.
  /// @param state at a theta, rad; called from any of the threads   @param threads >= 0; 0 = all cores
  MotionOverlapSearch(model::Linkage structure, double clearance, std::function<model::State(double)> state,
                      int threads);

  /// Returns the pairs that overlap or touch in the flat state.
  const std::vector<model::WallPair>& touching_at_rest() const { return contacts_[0].touching_at_rest(); }

  struct Overlap {
    int sample = 0;        ///< index in the requested angles
    model::WallPair pair;  ///< the first pair that WallContact reports there
  };
  /// Returns the first of these angles, rad, in their order, at which walls overlap. Independent of the
  /// number of threads.
  std::optional<Overlap> first_overlap(const std::vector<double>& thetas);

 private:
  std::function<model::State(double)> state_;
  const int most_;                            ///< threads
  std::vector<model::WallContact> contacts_;  ///< one per thread used so far
};

}  // namespace kinetix::optim
