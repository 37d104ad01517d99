#pragma once

#include <functional>
#include <string>

#include "model/linkage/linkage.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The closed form of a linkage that moves exactly, from the lattice that knows one.
struct ExactMotion {
  std::function<State(double theta)> at;  ///< state, mm, at fold parameter theta, rad; empty: none is known
  std::string name;                       ///< of the family
  std::string why;                        ///< in a sentence: the family's rule, or why there is none
  /// theta, rad, at which it has what a drive asks for, the first one from flat. Set where `at` is.
  /// @throws InvalidInput for a drive that the motion never meets, or that would hold it back on the way
  std::function<double(const LinkageDrive& drive)> theta_of = {};

  explicit operator bool() const { return static_cast<bool>(at); }
};

/// A linkage under a drive, with its closed form where there is one.
struct DrivenLinkage {
  Linkage linkage;
  LinkageDrive drive;
  ExactMotion exact;
};

}  // namespace kinetix::model
