#include "model/net_rules.hpp"

#include <algorithm>
#include <cmath>

#include "model/crease.hpp"
#include "model/exact_family.hpp"
#include "model/net.hpp"

namespace kinetix {
namespace {

constexpr double probe_thetas[] = {0.2, 0.5, 0.9};

/// Tilt and class-A fraction that most walls of a crease have.
struct CreaseParameters {
  double tilt = 0, t = 0.5;
};

double middle(std::vector<double> values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double tilt_of(const Hinge& hinge) { return alternation(hinge.wall) * hinge.parameters.beta; }

double fraction_of(const Hinge& hinge) { return fraction_from_lower(hinge.parameters.t, hinge.wall.from); }

CreaseParameters parameters_of(const Structure& structure, const Crease& crease) {
  std::vector<double> tilts, fractions;
  for (const int h : crease.hinges) {
    tilts.push_back(tilt_of(structure.hinges[h]));
    fractions.push_back(fraction_of(structure.hinges[h]));
  }
  return {middle(std::move(tilts)), middle(std::move(fractions))};
}

class Rules {
 public:
  Rules(const Structure& structure, double tolerance)
      : structure_(structure), tolerance_(tolerance), creases_(find_creases(structure)) {
    for (const Crease& crease : creases_.list) parameters_.push_back(parameters_of(structure, crease));
    crossed_by_.resize(creases_.list.size(), -1);
    for (const CellHinges& cell : structure.cell_members) {
      mark_crossing(cell.hinges[0], cell.hinges[1]);
      mark_crossing(cell.hinges[1], cell.hinges[0]);
    }
  }

  std::string broken_by(const Hinge& hinge, int index) const {
    const int crease = creases_.of_hinge[index];
    const CreaseParameters& own = parameters_[crease];
    if (!same(hinge.parameters.alpha, pi / 2)) return "exact motion needs alpha = 90 deg";
    if (!same(tilt_of(hinge), own.tilt))
      return "all tilts of a crease must be equal, with the sign alternating along it";
    if (!same(fraction_of(hinge), own.t))
      return "all hinges of a column (or row) of walls must give the same fraction to their class-A vertex";
    if (folds(own) && !same(own.t, 0.5)) return "a crease that bends needs t = 1/2";
    if (crossed_by_[crease] < 0) return {};
    if (folds(own)) return "a crease cannot cross another that bends";
    if (!same(own.t, 0.5)) return "walls beside a crease that bends need t = 1/2";
    return {};
  }

 private:
  bool same(double a, double b) const { return std::abs(a - b) <= tolerance_; }
  bool folds(const CreaseParameters& p) const { return !same(p.tilt, 0); }

  void mark_crossing(int hinge, int other) {
    const int crease = creases_.of_hinge[other];
    if (folds(parameters_[crease])) crossed_by_[creases_.of_hinge[hinge]] = crease;
  }

  const Structure& structure_;
  double tolerance_;
  Creases creases_;
  std::vector<CreaseParameters> parameters_;
  std::vector<int> crossed_by_;
};

/// Fold lines in line with each other keep hinge points together whatever their tilts: the axes count too.
/// A hinge that opens along the motion, or -1.
int open_hinge(const Structure& structure, double tolerance) {
  const NetTree tree = make_net_tree(structure);
  const double allowed = tolerance * static_cast<double>(structure.bodies.size());
  for (const double theta : probe_thetas) {
    const HingeGaps gaps = hinge_gaps(structure, fold_net(tree, structure, theta));
    if (!(gaps.max <= allowed)) return gaps.worst_hinge;
    if (!(gaps.axis_max <= allowed)) return gaps.worst_axis;
  }
  return -1;
}

}  // namespace

NetCheck check_net(const Structure& structure, double tolerance) {
  const Rules rules(structure, tolerance);
  NetCheck check;
  for (std::size_t h = 0; h < structure.hinges.size(); ++h) {
    std::string rule = rules.broken_by(structure.hinges[h], static_cast<int>(h));
    if (rule.empty()) continue;
    if (check.broken++ > 0) continue;
    check.breaking_hinge = static_cast<int>(h);
    check.rule = std::move(rule);
  }
  if (check.broken > 0) return check;
  const int open = open_hinge(structure, tolerance);
  if (open >= 0)
    return {1, open,
            "creases around a hole must let it close: along one axis only, and alike where they lie in line"};
  return check;
}

}  // namespace kinetix
