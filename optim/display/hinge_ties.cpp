#include "optim/display/hinge_ties.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/lattice/square/symmetry.hpp"

namespace kinetix::optim {
namespace {

using Eigen::VectorXd;

constexpr int unseen = -2;  // marks a hinge that no motion has reached yet; -1 is `centred`

model::PlaneMotion motion_of(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::mirror_x:
      return model::PlaneMotion::mirror_x;
    case Symmetry::mirror_y:
      return model::PlaneMotion::mirror_y;
    case Symmetry::rotate_2:
      return model::PlaneMotion::half_turn;
    case Symmetry::rotate_4:
      return model::PlaneMotion::quarter_turn;
    case Symmetry::none:
      break;
  }
  return model::PlaneMotion::none;
}

}  // namespace

HingeTies hinge_ties(const model::Structure& panel, Symmetry symmetry) {
  const model::PlaneMotion motion = motion_of(symmetry);
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
      const auto [next, turned] = image(panel, panel.hinges[h], motion);
      h = static_cast<std::size_t>(next);
      reversed ^= turned;
    } while (h != first);
    const int variable = reversed ? HingeTies::centred : ties.variables++;
    for (const std::size_t member : orbit) ties.variable[member] = variable;
  }
  return ties;
}

HingeTies untied(int hinges) {
  HingeTies ties;
  ties.variable.resize(static_cast<std::size_t>(hinges));
  std::iota(ties.variable.begin(), ties.variable.end(), 0);
  ties.reversed.assign(ties.variable.size(), false);
  ties.variables = hinges;
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

VectorXd HingeTies::to_one_side(VectorXd t) const {
  VectorXd first = VectorXd::Zero(variables);  // off the middle
  for (std::size_t h = 0; h < variable.size(); ++h) {
    if (variable[h] == centred) continue;
    const double off = reversed[h] ? 0.5 - t[h] : t[h] - 0.5;
    double& of_first = first[variable[h]];
    if (of_first == 0) of_first = off;
    if (of_first * off < 0) t[h] = 1 - t[h];
  }
  return t;
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

}  // namespace kinetix::optim
