#pragma once

#include "model/base/geometry.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::optim {

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
