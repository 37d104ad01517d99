#include "model/classify.hpp"

#include <algorithm>
#include <cmath>

namespace kinetix {
namespace {

std::string name(const Wall& wall) {
  const auto vertex = [](Vertex v) { return "[" + std::to_string(v.i) + ", " + std::to_string(v.j) + "]"; };
  return "wall [" + vertex(wall.from) + ", " + vertex(wall.to()) + "]";
}

/// Design that each column's and row's first hinge suggests.
ExactDesign<double> suggested_design(const Structure& s) {
  int columns = 0, rows = 0;
  for (const Cell& c : s.cells) {
    columns = std::max(columns, c.i + 1);
    rows = std::max(rows, c.j + 1);
  }
  auto design = ExactDesign<double>::basic(columns, rows);
  for (auto hinge = s.hinges.rbegin(); hinge != s.hinges.rend(); ++hinge) {
    const auto [i, j] = hinge->wall.from;
    const HingeParameters& p = hinge->parameters;
    const double of_class_a = fraction_from_lower(p.t, hinge->wall.from);
    if (hinge->wall.axis == Axis::x) {
      design.beta[i] = (j & 1) ? -p.beta : p.beta;
      design.t[i] = of_class_a;
    } else {
      design.gamma = (i & 1) ? -p.beta : p.beta;
      design.s[j] = of_class_a;
    }
  }
  return design;
}

/// Empty where the hinge keeps the family's rule; otherwise the rule it breaks.
class Rule {
 public:
  Rule(Family family, const ExactDesign<double>& design, double tolerance)
      : family_(family), design_(design), tolerance_(tolerance) {}

  std::string broken_by(const Hinge& hinge, const HingeParameters& asked) const {
    const HingeParameters& p = hinge.parameters;
    const bool along_x = hinge.wall.axis == Axis::x;
    if (!same(p.alpha, pi / 2)) return "exact motion needs alpha = 90 deg";
    if (family_ == Family::F1 && !same(p.beta, 0)) return "planar motion (F1) needs beta = 0";
    if (family_ != Family::F1 && !along_x && !same(p.t, 0.5))
      return "a bending sheet needs t = 1/2 on the walls along its rows";
    if (family_ == Family::F2 && !along_x && !same(p.beta, 0))
      return "a cylindrical sheet (F2) needs beta = 0 on the walls along its rows";
    if (along_x && !same(p.t, 0.5) && (family_ == Family::F3 || (family_ == Family::F2 && !same(p.beta, 0))))
      return "a bending column needs t = 1/2";
    if (!same(p.beta, asked.beta))
      return along_x ? "all tilts of a column must be equal, with the sign alternating from row to row"
                     : "all rows must share one tilt, with the sign alternating from column to column";
    if (!same(p.t, asked.t))
      return "all hinges of a column (or row) of walls must give the same fraction to their class-A vertex";
    return {};
  }

 private:
  bool same(double a, double b) const { return std::abs(a - b) <= tolerance_; }

  Family family_;
  const ExactDesign<double>& design_;
  double tolerance_;
};

std::string praise(Family family, bool transposed) {
  const std::string along = transposed ? " (folding along y)" : "";
  switch (family) {
    case Family::F1:
      return "F1: all axes vertical, hinge fractions by column and row: planar, one degree of freedom";
    case Family::F2:
      return "F2: basic rows, every column bends or shears: cylindrical sheet" + along;
    case Family::F3:
      return "F3: rows tilted alike, every column bends" + along;
    case Family::none:
      break;
  }
  return "no exact family";
}

struct Attempt {
  Family family;
  bool transposed;
  int breaking = -1;
  std::string rule;
};

Attempt attempt(Family family, const Structure& s, const ExactDesign<double>& design, double tolerance) {
  Structure asked = s;
  apply(design, asked);
  const Rule rule(family, design, tolerance);
  for (std::size_t k = 0; k < s.hinges.size(); ++k) {
    std::string broken = rule.broken_by(s.hinges[k], asked.hinges[k].parameters);
    if (!broken.empty()) return {family, false, static_cast<int>(k), std::move(broken)};
  }
  return {family, false, -1, {}};
}

Vertex swapped(Vertex v) { return {v.j, v.i}; }

/// Mirror image with x and y exchanged. A tilt changes its sign, a fraction and an in-plane angle do not.
Structure transposed(const Structure& s) {
  std::vector<Cell> cells;
  for (const Cell& c : s.cells) cells.push_back({c.j, c.i});
  Structure out = make_structure(std::move(cells), s.size);
  for (const Hinge& h : s.hinges) {
    const Wall wall{swapped(h.wall.from), h.wall.axis == Axis::x ? Axis::y : Axis::x};
    HingeParameters& p = out.hinges[*out.hinge_at(wall)].parameters;
    p = h.parameters;
    p.beta = -p.beta;
  }
  return out;
}

Pose swapped(const Pose& pose) {
  const Eigen::Matrix3d swap =
      Eigen::PermutationMatrix<3>(Eigen::Vector3i(1, 0, 2)).toDenseMatrix().cast<double>();
  return {swap * pose.R * swap, swap * pose.p};
}

}  // namespace

std::string to_string(Family family) {
  switch (family) {
    case Family::F1:
      return "F1";
    case Family::F2:
      return "F2";
    case Family::F3:
      return "F3";
    case Family::none:
      break;
  }
  return "none";
}

Classification classify(const Structure& structure, double tolerance) {
  const auto design = suggested_design(structure);
  Attempt best{Family::none, false, -1, {}};
  const auto try_families = [&](const Structure& s, const ExactDesign<double>& d, bool is_transposed) {
    for (const Family family : {Family::F1, Family::F2, Family::F3}) {
      Attempt a = attempt(family, s, d, tolerance);
      a.transposed = is_transposed;
      if (a.breaking >= 0 && is_transposed) {
        const Wall& wall = s.hinges[a.breaking].wall;
        a.breaking = *structure.hinge_at({swapped(wall.from), wall.axis == Axis::x ? Axis::y : Axis::x});
      }
      if (best.family == Family::none || a.breaking < 0 || a.breaking > best.breaking) best = std::move(a);
      if (best.breaking < 0) return true;
    }
    return false;
  };
  if (try_families(structure, design, false))
    return {best.family, false, design, -1, praise(best.family, false)};
  const Structure mirrored = transposed(structure);
  const auto mirrored_design = suggested_design(mirrored);
  if (try_families(mirrored, mirrored_design, true))
    return {best.family, true, mirrored_design, -1, praise(best.family, true)};

  const Hinge& hinge = structure.hinges[best.breaking];
  return {Family::none,
          false,
          {},
          best.breaking,
          "not exactly mobile: hinge " + std::to_string(best.breaking) + " on " + name(hinge.wall) + ": " +
              best.rule};
}

State fold(const Classification& classification, const Structure& structure, double theta) {
  auto design = classification.design;
  design.theta = classification.transposed ? -theta : theta;
  if (!classification.transposed) return fold(design, structure);
  State lattice;
  fold(design, structure.size.edge_mm, lattice);
  State state;
  for (const Vertex& v : structure.bodies) state.push_back(swapped(lattice[v.j * (design.rows() + 1) + v.i]));
  return state;
}

}  // namespace kinetix
