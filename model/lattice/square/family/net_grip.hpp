#pragma once

#include <optional>

#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/grip.hpp"

namespace kinetix::model {

/// Where plates grip a net, and how they stand.
struct NetGrip {
  Grip grip;
  Axis axis = Axis::y;  ///< normal of the plates
};

/// The part of a net (family F4) that plates grip best: a flat panel of basic cells, between plates along its
/// longer side, or a spine of any length, one cell wide, between plates along it, in which it bends: of all
/// such rectangles the one that the bodies are nearest to, counted in walls, since they all swing with it.
/// Nothing where there is none.
std::optional<NetGrip> find_net_grip(const Structure& structure);

/// @throws InvalidInput where plates cannot hold the rows that they grip all along an exact motion
/// (keeps_between_plates). Of other structures nothing is said.
void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const std::optional<Grip>& grip);
/// @param rows that the plates hold   @param what of the structure they are the rim of, for the message
void require_kept_rows(const Structure& structure, const Classification& kind, Axis axis,
                       const GrippedRows& rows, const std::string& what);

}  // namespace kinetix::model
