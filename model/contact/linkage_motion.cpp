#include "model/contact/linkage_motion.hpp"

#include <algorithm>
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

LinkageMotion::LinkageMotion(const Linkage& structure, const std::vector<TurnLaw>& turns)
    : structure(structure), chains(structure), middle(middle_body(structure)), links(chains.tree(middle)) {
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

int LinkageMotion::loose_body() const {
  std::vector<bool> is_joined(structure.bodies.size());
  is_joined[middle] = true;
  for (const HingeChains::Link& link : links) is_joined[link.body] = true;
  const auto loose = std::find(is_joined.begin(), is_joined.end(), false);
  return loose == is_joined.end() ? -1 : static_cast<int>(loose - is_joined.begin());
}

double LinkageMotion::margin_mm(std::size_t hinges, double gap, double off) const {
  const double steps = static_cast<double>(hinges) + 1;
  return edge() * steps * (gap + off * 2 * steps * longest_arm);
}

}  // namespace kinetix::model
