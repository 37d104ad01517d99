#include "optim/hinge_ties.hpp"

#include <algorithm>
#include <utility>

namespace kinetix {
namespace {

using Eigen::VectorXd;

constexpr int unseen = -2;

/// A motion of the plane onto itself that takes the panel to the panel.
Vertex image(Vertex v, Symmetry symmetry, Vertex corner) {
  switch (symmetry) {
    case Symmetry::mirror_x:
      return {corner.i - v.i, v.j};
    case Symmetry::mirror_y:
      return {v.i, corner.j - v.j};
    case Symmetry::rotate_2:
      return {corner.i - v.i, corner.j - v.j};
    case Symmetry::rotate_4:
      return {corner.j - v.j, v.i};
    case Symmetry::none:
      break;
  }
  return v;
}

/// The hinge on a wall's image, and whether the wall is turned end to end.
std::pair<int, bool> image(const Structure& panel, const Hinge& hinge, Symmetry symmetry, Vertex corner) {
  const Vertex from = image(hinge.wall.from, symmetry, corner), to = image(hinge.wall.to(), symmetry, corner);
  const Vertex low = std::min(from, to);
  return {*panel.hinge_at({low, from.j == to.j ? Axis::x : Axis::y}), low != from};
}

}  // namespace

HingeTies hinge_ties(const Structure& panel, Symmetry symmetry) {
  const Vertex corner = panel.bodies.back();
  HingeTies ties;
  ties.variable.assign(panel.hinges.size(), unseen);
  ties.reversed.assign(panel.hinges.size(), false);
  for (std::size_t first = 0; first < panel.hinges.size(); ++first) {
    if (ties.variable[first] != unseen) continue;
    std::vector<std::size_t> orbit;
    std::size_t h = first;
    bool reversed = false;
    do {
      orbit.push_back(h);
      ties.reversed[h] = reversed;
      const auto [next, turned] = image(panel, panel.hinges[h], symmetry, corner);
      h = static_cast<std::size_t>(next);
      reversed ^= turned;
    } while (h != first);
    const int variable = reversed ? HingeTies::centred : ties.variables++;
    for (const std::size_t member : orbit) ties.variable[member] = variable;
  }
  return ties;
}

VectorXd HingeTies::expand(const VectorXd& x) const {
  VectorXd t(static_cast<Eigen::Index>(variable.size()));
  for (std::size_t h = 0; h < variable.size(); ++h) {
    const double from = variable[h] == centred ? 0.5 : x[variable[h]];
    t[h] = reversed[h] ? 1 - from : from;
  }
  return t;
}

VectorXd HingeTies::gather(const VectorXd& by_t) const {
  VectorXd sum = VectorXd::Zero(variables);
  for (std::size_t h = 0; h < variable.size(); ++h)
    if (variable[h] != centred) sum[variable[h]] += reversed[h] ? -by_t[h] : by_t[h];
  return sum;
}

VectorXd HingeTies::nearest(const VectorXd& t) const {
  VectorXd sum = VectorXd::Zero(variables), count = VectorXd::Zero(variables);
  for (std::size_t h = 0; h < variable.size(); ++h) {
    if (variable[h] == centred) continue;
    sum[variable[h]] += reversed[h] ? 1 - t[h] : t[h];
    count[variable[h]] += 1;
  }
  return sum.cwiseQuotient(count);
}

}  // namespace kinetix
