#pragma once

#include <optional>

#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `hinge:` section: what the hinges are made of.
struct HingeSection {
  enum class Model { rotary, elastic };

  Model model = Model::rotary;
  double k_point = 1000;                 ///< N/mm, > 0
  double k_turn = 0.1;                   ///< N mm/rad, > 0; 0 is allowed where rotary
  std::optional<double> reach_mm;        ///< half distance of the two constraint points, (0, 10] cell edges
  std::optional<double> k_contact = {};  ///< of two walls pressed together, N/mm, > 0; nothing: 10 k_point

  bool operator==(const HingeSection&) const = default;
};

/// Keys of the section, and those where hinges are elastic whether the file says so or not.
const targets::KeyTable& hinge_keys();
targets::KeyTable elastic_hinge_keys();

/// @param root the whole document; @param edge_mm cell edge, for the range of reach_mm
HingeSection read_hinge_section(const targets::Section& root, double edge_mm);
/// The same where hinges are elastic whether the file says so or not. @throws InvalidInput also for model:
/// rotary
HingeSection read_elastic_hinge_section(const targets::Section& root, double edge_mm);

}  // namespace kinetix::app
