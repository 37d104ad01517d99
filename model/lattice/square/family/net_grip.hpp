#pragma once

#include <optional>

#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/grip.hpp"

namespace kinetix::model {

/// Part of a net that plates grip, and the direction of the plates.
struct NetGrip {
  Grip grip;
  Axis axis = Axis::y;  ///< normal of the plates
};

/// Returns the part of a net (family F4) that plates grip best; empty if there is none. A candidate is a flat panel
/// of basic cells between plates along its longer side. Another is a spine of any length, one cell wide, between
/// plates along it, in which it bends. The choice is the rectangle with the least total distance of all bodies,
/// counted in walls, because they all swing with it.
std::optional<NetGrip> find_net_grip(const Structure& structure);

/// Checks that plates can hold the gripped rows during an exact motion (keeps_between_plates). Other structures are
/// not checked. @throws InvalidInput if they cannot
void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const std::optional<Grip>& grip);
/// Checks rows that the plates hold. @param what part of the structure bounded by the rows, for the message
void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const GrippedRows& rows, const std::string& what);

}  // namespace kinetix::model
