#pragma once

#include <array>
#include <functional>
#include <optional>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// Adds the lock that keeps a sheet folded: posts or eyes on two bodies, and the clip over the posts. The bodies are
/// those whose distance shrinks most from flat to the fold, of those that leave room. Posts and eyes keep the clearance
/// of all parts along the path. Clip and strap are straight in the fold, and nothing else is there.
/// @param kind not LockKind::none
/// @pre the sheet without a lock has its clearance.
/// @throws InvalidInput, one sentence, if no two bodies leave room, the fold is not known, or the sheet is cut
void add_lock(PrintSheet& sheet, LockKind kind);

/// Adds a clip, else a strap, that its hinges do not break. It tries few pairs of bodies. Sheets that are cut have no
/// posts.
/// @return whether there is one; else the sheet stays as it is
bool add_default_lock(PrintSheet& sheet);

/// Equilibrium of a folded sheet that a lock holds against its hinges.
struct HeldFold {
  model::State state;    ///< mm
  double length_mm = 0;  ///< distance of the posts
  double force_N = 0;    ///< force on the lock, > 0
};

/// Finds the length at which a lock between two bodies holds a sheet at the mean theta of its fold. Soft hinges also
/// stretch, so that the posts are then nearer than in the fold. With E the elastic energy and d the length, the state
/// is an equilibrium of E + force d.
/// @param bodies with the posts.
/// @param length_mm distance of the posts in a state.
/// @return empty for a sheet whose hinges turn freely, and if there is no stable state near the fold
std::optional<HeldFold> find_held_fold(const PrintSheet& sheet, const std::array<int, 2>& bodies,
                                       const std::function<double(const model::State&)>& length_mm);

}  // namespace kinetix::app
