#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/base/angle.hpp"
#include "model/contact/wall_contact.hpp"

namespace kinetix::optim {

/// Rad of theta between looks: walls that meet and part again within one are missed.
inline constexpr double look_step = 1 * radians_per_degree;

/// Where to look on the way from flat to theta, rad, > 0: no further apart than that, the last at theta itself.
std::vector<double> looks_up_to(double theta);

/// Looks at states on the way of a fold for walls that overlap, some at once.
class LooksOnTheWay {
 public:
  /// @param clearance by which walls are looked at thicker and higher than they are, cell edges   @param state at a theta, rad;
  /// called from any of the threads   @param threads >= 0; 0 = all cores
  LooksOnTheWay(model::Linkage structure, double clearance, std::function<model::State(double)> state,
                int threads);

  /// Pairs that overlap or touch in the flat state.
  const std::vector<model::WallPair>& touching_at_rest() const { return contacts_[0].touching_at_rest(); }

  struct Overlap {
    int look = 0;          ///< of those asked for
    model::WallPair pair;  ///< the first that WallContact names there
  };
  /// The first of these angles, rad, where walls overlap. Their order counts, the number of threads does not.
  std::optional<Overlap> first_overlap(const std::vector<double>& thetas);

 private:
  std::function<model::State(double)> state_;
  const int most_;                            ///< threads
  std::vector<model::WallContact> contacts_;  ///< one a thread that has been used
};

}  // namespace kinetix::optim
