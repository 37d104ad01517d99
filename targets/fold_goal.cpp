#include "targets/fold_goal.hpp"

#include <algorithm>
#include <utility>

#include "model/invalid_input.hpp"
#include "targets/net_layout.hpp"

namespace kinetix {

FoldGoal box_goal(const std::array<int, 3>& edges, std::optional<int> open, int columns) {
  for (const int edge : edges)
    if (edge < 1 || edge > max_face_side)
      throw InvalidInput("an edge of the box is " + std::to_string(edge) + " cells long; allowed are 1 to " +
                         std::to_string(max_face_side));
  FoldGoal goal{edges, open, box_unfoldings(edges, open)};
  for (FoldNet& net : goal.nets)
    for (FoldCrease& crease : net.creases) crease.columns = columns;
  return goal;
}

FoldGoal net_goal(FoldNet net) {
  validate(net);
  std::vector<int> columns;
  for (const FoldCrease& crease : net.creases) columns.push_back(std::max(crease.columns, 1));
  lay_out(net, columns);
  return {{}, {}, {std::move(net)}};
}

}  // namespace kinetix
