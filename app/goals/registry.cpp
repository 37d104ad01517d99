#include "app/goals/registry.hpp"

#include "app/goals/curve/curve_kind.hpp"
#include "app/goals/display/display_kind.hpp"
#include "app/goals/fold/fold_kind.hpp"
#include "app/goals/helmet/helmet_kind.hpp"
#include "app/goals/outline/outline_kind.hpp"
#include "app/goals/space_block/space_block_kind.hpp"
#include "app/goals/space_curve/space_curve_kind.hpp"
#include "app/goals/surface/surface_kind.hpp"

namespace kinetix::app {
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
