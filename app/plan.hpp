#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/classify.hpp"
#include "model/mobility.hpp"
#include "model/wall_contact.hpp"

namespace kinetix {

/// What a scene needs to compute, decided before anything is computed.
struct Plan {
  Classification family;
  std::optional<Mobility> mobility;      ///< empty for structures too large to be worth it
  std::optional<ThetaRange> free_range;  ///< theta without walls touching; empty outside the exact families
  std::vector<std::string> why;          ///< one sentence per decision
};

Plan make_plan(const Structure& structure);

}  // namespace kinetix
