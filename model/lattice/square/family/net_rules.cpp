#include "model/lattice/square/family/net_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "model/base/lower_median.hpp"
#include "model/lattice/square/crease.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "model/lattice/square/family/family_rules.hpp"
#include "model/lattice/square/family/net.hpp"
#include "model/linkage/probe_thetas.hpp"

namespace kinetix::model {
namespace {

/// Tilt, and fraction at sublattice A, of most walls of a crease.
struct CreaseParameters {
  double tilt = 0, t = 0.5;
};

double fraction_of(const Hinge& hinge) { return fraction_from_lower(hinge.parameters.t, hinge.wall.from); }

CreaseParameters parameters_of(const Structure& structure, const Crease& crease) {
  std::vector<double> tilts, fractions;
  for (const int h : crease.hinges) {
    tilts.push_back(tilt_in_crease(structure.hinges[h]));
    fractions.push_back(fraction_of(structure.hinges[h]));
  }
  return {lower_median(std::move(tilts)), lower_median(std::move(fractions))};
}

class Rules {
 public:
  Rules(const Structure& structure, double tolerance)
      : structure_(structure), tolerance_(tolerance), creases_(find_creases(structure)) {
    for (const Crease& crease : creases_.list) parameters_.push_back(parameters_of(structure, crease));
    is_beside_bend_.resize(creases_.list.size(), false);
    is_hindered_.resize(creases_.list.size(), false);
    for (std::size_t c = 0; c < structure.cells.size(); ++c) examine(c);
  }

  std::string broken_by(const Hinge& hinge, int index) const {
    const int crease = creases_.of_hinge[index];
    const CreaseParameters& own = parameters_[crease];
    if (!same(hinge.parameters.alpha, pi / 2)) return "exact motion needs alpha = 90 deg";
    if (!same(hinge.parameters.offset, 0)) return off_the_wall;
    if (!same(tilt_in_crease(hinge), own.tilt))
      return "all tilts of a crease must be equal, with the sign alternating along it";
    if (!same(fraction_of(hinge), own.t))
      return "all hinges of a column (or row) of walls must give the same fraction to their class-A vertex";
    if (folds(own) && !same(own.t, 0.5)) return "a crease that bends needs t = 1/2";
    if (is_hindered_[crease])
      return "a crease cannot cross another that bends where four cells meet, unless their two columns or "
             "their two rows have one tilt";
    if (is_beside_bend_[crease] && !same(own.t, 0.5)) return "walls beside a crease that bends need t = 1/2";
    return {};
  }

 private:
  bool same(double a, double b) const { return std::abs(a - b) <= tolerance_; }
  bool folds(const CreaseParameters& p) const { return !same(p.tilt, 0); }

  const CreaseParameters& of(int hinge) const { return parameters_[creases_.of_hinge[hinge]]; }

  void examine(std::size_t index) {
    const auto& hinges = structure_.cell_members[index].hinges;
    const bool x_folds = folds(of(hinges[0])), y_folds = folds(of(hinges[1]));
    if (y_folds) is_beside_bend_[creases_.of_hinge[hinges[0]]] = true;
    if (x_folds) is_beside_bend_[creases_.of_hinge[hinges[1]]] = true;
    if (!x_folds || !y_folds || !is_in_hindered_block(structure_.cells[index])) return;
    for (const int k : {0, 1}) is_hindered_[creases_.of_hinge[hinges[k]]] = true;
  }

  bool is_in_hindered_block(const Cell& cell) const {
    for (const int di : {-1, 1})
      for (const int dj : {-1, 1})
        if (is_hindered(cell, {cell.i + di, cell.j + dj})) return true;
    return false;
  }

  /// Returns true if the four cells between two opposite ones exist and cannot move together.
  bool is_hindered(const Cell& a, const Cell& b) const {
    const auto near = hinges_of(a), far = hinges_of(b);
    if (!near || !far || !hinges_of({a.i, b.j}) || !hinges_of({b.i, a.j})) return false;
    return !same(of((*near)[0]).tilt, of((*far)[0]).tilt) && !same(of((*near)[1]).tilt, of((*far)[1]).tilt);
  }

  std::optional<std::array<int, 4>> hinges_of(const Cell& cell) const {
    const auto at = std::lower_bound(structure_.cells.begin(), structure_.cells.end(), cell);
    if (at == structure_.cells.end() || *at != cell) return {};
    return structure_.cell_members[at - structure_.cells.begin()].hinges;
  }

  const Structure& structure_;
  double tolerance_;
  Creases creases_;
  std::vector<CreaseParameters> parameters_;
  std::vector<bool> is_beside_bend_;  ///< per crease: it runs through a cell of a crease that bends
  std::vector<bool> is_hindered_;     ///< per crease: it and one that crosses it bend, which is impossible
};

/// Returns a hinge that opens during the motion, or -1. The axes count too, because aligned fold lines keep hinge
/// points together for any tilts.
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
            "creases around a hole must let it close: alike where they lie in line, and not crossing in it"};
  return check;
}

}  // namespace kinetix::model
