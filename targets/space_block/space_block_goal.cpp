#include "targets/space_block/space_block_goal.hpp"

namespace kinetix::targets {

Eigen::Vector3d block_lengths(const BlockSides& sides) {
  Eigen::Vector3d out;
  for (int d = 0; d < 3; ++d) {
    std::array<double, 2> at = {};
    for (int side = 0; side < 2; ++side) {
      for (const Eigen::Vector3d& p : sides[d][side]) at[side] += p[d];
      at[side] /= static_cast<double>(sides[d][side].size());
    }
    out[d] = at[1] - at[0];
  }
  return out;
}

SpaceBlockError space_block_error(const SpaceBlockGoal& goal, const Eigen::Vector3d& rest,
                                  const Eigen::Vector3d& pressed) {
  const Eigen::Vector3d factors = pressed.cwiseQuotient(rest);
  return {factors, (factors - goal.factors).cwiseAbs().maxCoeff()};
}

namespace {

// Range of a pressed length over the length at rest: at 0 nothing is left, at 1 nothing happens.
const Bounds shrinks = between(0, 1);
// Range of lengths, mm: from the size of a fingertip to that of a hall.
const Bounds lengths = from_to(1, 100'000, "mm");

Eigen::Vector3d three_numbers(const Node& list, const std::string& what, const Bounds& bounds) {
  const std::vector<Node> items = list.list_of(3, what);
  return {items[0].number(bounds), items[1].number(bounds), items[2].number(bounds)};
}

}  // namespace

const KeyTable& space_block_target_keys() {
  static const KeyTable keys({
      goal_kind_key("space_block"),
      {"factor",
       value::either({value::number(shrinks), value::list(value::number(shrinks), "`[x, y, z]`", 3, 3)}),
       needed,
       "its length when it is pressed over that at rest: in all directions, or along x, y and z; no "
       "direction "
       "can shrink by more than the two others together"},
      {"size_mm", value::list(value::number(lengths), "`[x, y, z]` in mm", 3, 3), no_default,
       "size of the block at rest, from the outermost rotors. Number and size of the cells follow from it"},
  });
  return keys;
}

SpaceBlockGoal read_space_block(const Section& target) {
  SpaceBlockGoal goal;
  const Node factor =
      target.required("factor",
                      "length of the pressed block relative to its length at rest: in all directions, or "
                      "along x, y and z. No direction can shrink by more than the sum of the other two");
  if (factor.kind() == Node::Kind::list)
    goal.factors = three_numbers(factor, "[x, y, z]", shrinks);
  else
    goal.factors.setConstant(factor.number(shrinks));
  const auto size = target.optional("size_mm");
  if (!size) return goal;
  goal.size_mm = three_numbers(*size, "[x, y, z] in mm", lengths);
  return goal;
}

}  // namespace kinetix::targets
