#include "targets/fold/fold_goal.hpp"

#include <algorithm>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"
#include "targets/fold/fold_error.hpp"

namespace kinetix::targets {

FoldGoal box_goal(const std::array<int, 3>& edges, std::optional<int> open, int columns) {
  for (const int edge : edges)
    if (edge < 1 || edge > max_face_side)
      throw InvalidInput("an edge of the box is " + std::to_string(edge) + " cells long; allowed: 1 to " +
                         std::to_string(max_face_side));
  FoldGoal goal{edges, {}, open, box_unfoldings(edges, open)};
  for (FoldNet& net : goal.nets)
    for (FoldCrease& crease : net.creases) crease.columns = columns;
  return goal;
}

FoldGoal net_goal(FoldNet net) {
  validate(net);
  std::vector<int> columns;
  for (const FoldCrease& crease : net.creases) columns.push_back(std::max(crease.columns, 1));
  const int open = open_crease(net, lay_out(net, columns));
  if (open >= 0)
    throw InvalidInput("the ring of faces with crease " + in_ticks(crease_name(net, net.creases[open])) +
                       " does not close when it folds; creases in one line need the same angle");
  return {{}, {}, {}, {std::move(net)}};
}

}  // namespace kinetix::targets
