#include "model/contact/linkage_plates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace kinetix::model {
namespace {

int middle_body(const Linkage& structure) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const LinkageBody& body : structure.bodies) middle += body.position;
  middle /= static_cast<double>(structure.bodies.size());
  const auto nearer = [&](const LinkageBody& a, const LinkageBody& b) {
    return (a.position - middle).squaredNorm() < (b.position - middle).squaredNorm();
  };
  const auto& bodies = structure.bodies;
  return static_cast<int>(std::min_element(bodies.begin(), bodies.end(), nearer) - bodies.begin());
}

}  // namespace

LinkagePlates::LinkagePlates(const Linkage& structure, const std::vector<TurnLaw>& turns, double growth_mm)
    : structure(structure),
      walls(half_walls(structure)),
      at_rest(structure),
      plates_of(structure.bodies.size()),
      reach(structure.bodies.size()),
      chains(structure),
      middle(middle_body(structure)),
      links(chains.tree(middle)) {
  for (int k = 0; k < static_cast<int>(walls.size()); ++k) {
    HalfWall& wall = walls[k];
    // A slanted end that moves out by this moves further along the edge.
    wall.box.half += growth_mm * Eigen::Vector3d(std::hypot(1, wall.box.slant), 1, 1);
    plates_of[wall.body].push_back(k);
    reach[wall.body] = std::max(reach[wall.body], wall.box.center.norm() + radius(wall.box));
  }
  std::map<std::pair<double, double>, int> known;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const auto [at, is_new] = known.try_emplace({turns[h].p, turns[h].q}, static_cast<int>(laws.size()));
    if (is_new) laws.push_back(turns[h]);
    law_of.push_back(at->second);
    senses.push_back(hinge_sense(structure, h));
    const RestHinge& hinge = structure.hinges[h];
    longest_arm = std::max({longest_arm, hinge.lower_arm.norm(), hinge.upper_arm.norm()});
  }
}

bool LinkagePlates::can_touch(const WallPair& pair) const {
  return walls[pair.first].hinge != walls[pair.second].hinge &&
         !std::binary_search(at_rest.touching_at_rest().begin(), at_rest.touching_at_rest().end(), pair);
}

int LinkagePlates::loose_body() const {
  std::vector<bool> is_joined(structure.bodies.size());
  is_joined[middle] = true;
  for (const HingeChains::Link& link : links) is_joined[link.body] = true;
  const auto loose = std::find(is_joined.begin(), is_joined.end(), false);
  return loose == is_joined.end() ? -1 : static_cast<int>(loose - is_joined.begin());
}

}  // namespace kinetix::model
