#include "app/formats/all_keys.hpp"

#include "app/files/bodies_section.hpp"
#include "app/files/design_file.hpp"
#include "app/goals/registry.hpp"
#include "app/imports/hinge_choices.hpp"
#include "app/sweep/plan/doe_file.hpp"

namespace kinetix::app {

std::vector<KeyList> all_keys() {
  std::vector<KeyList> lists;
  for (const GoalKind* kind : goal_kinds())
    lists.push_back({"target " + std::string(kind->name), &kind->table()});
  lists.push_back({"design", &design_keys()});
  lists.push_back({"assembly", &bodies_keys()});
  lists.push_back({"hinges", &hinge_choice_keys()});
  lists.push_back({"doe", &doe_keys()});
  for (const targets::KeyTable* shared : {&hinge_keys(), &physics_keys()})
    lists.push_back({shared->title(), shared});
  return lists;
}

}  // namespace kinetix::app
