#pragma once

#include <functional>
#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Closed form of a linkage that moves exactly, from its lattice.
struct ExactMotion {
  std::function<State(double theta)> at;  ///< state, mm, at fold parameter theta, rad; empty if none is known
  std::string name;                       ///< name of the family
  std::string why;  ///< one sentence: the family's rule, or the reason why there is no closed form
  /// First theta from flat, rad, at which the motion reaches a drive's target. Set if `at` is set.
  /// @throws InvalidInput for a drive that the motion never meets, or that would block it earlier
  std::function<double(const LinkageDrive& drive)> theta_of = {};

  explicit operator bool() const { return static_cast<bool>(at); }
};

/// A linkage under a drive, with its closed form if there is one.
struct DrivenLinkage {
  Linkage linkage;
  LinkageDrive drive;
  ExactMotion exact;
};

}  // namespace kinetix::model
