#pragma once

#include "app/files/hinge_parts.hpp"

namespace kinetix::app {

/// What a goal allows its drive and its hinges to bear; nothing: any.
struct HingeLimits {
  /// Share of a limit that a search keeps to, so that the run from flat with its own steps keeps it too.
  static constexpr double in_hand = 0.99;

  std::optional<double> force_N;  ///< tolerance.force_N: most on the drive, N, > 0
  std::optional<double>
      strain;  ///< tolerance.strain: most of a hinge made as a block or film, ratio, (0, 10]

  bool any() const { return force_N || strain; }
};

/// The keys `force_N` and `strain` of a `tolerance:` section. @param instead what a search does where it has to
/// @param usual_strain where the file gives none
std::vector<targets::Key> hinge_limit_keys(const std::string& instead,
                                           const targets::Default& usual_strain = {});
/// @throws InvalidInput for a strain where no hinges are blocks or films, and for more than their materials bear
HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts = {});

}  // namespace kinetix::app
