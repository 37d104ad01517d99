#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/contact/wall_contact.hpp"

namespace kinetix::optim {

/// Looks at states on the way of a fold for walls that overlap, some at once.
class LooksOnTheWay {
 public:
  /// @param structure with the walls that must not overlap   @param state at a theta, rad; called from any of the threads
  /// @param threads > 0
  LooksOnTheWay(const model::Linkage& structure, std::function<model::State(double)> state, int threads);

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
  std::vector<model::WallContact> contacts_;  ///< one a thread
};

}  // namespace kinetix::optim
