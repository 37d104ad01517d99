#include "app/goals/registry.hpp"

namespace kinetix::app {

extern const GoalKind curve_kind, display_kind, fold_kind, helmet_kind, outline_kind, space_block_kind,
    space_curve_kind, surface_kind;

namespace {

std::vector<const GoalKind*>& kinds() {
  static std::vector<const GoalKind*> all = {
      // One a line.
      &curve_kind,        //
      &display_kind,      //
      &fold_kind,         //
      &helmet_kind,       //
      &outline_kind,      //
      &space_block_kind,  //
      &space_curve_kind,  //
      &surface_kind,
  };
  return all;
}

}  // namespace

const std::vector<const GoalKind*>& goal_kinds() { return kinds(); }

void add_goal_kind(const GoalKind& kind) { kinds().push_back(&kind); }

}  // namespace kinetix::app
