#include "optim/curve/curve_reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/hinge/crease_law.hpp"

namespace kinetix::optim {
namespace {

// Longest strip over the curve's length. A strip that is longer even when fully pressed has to wind about the
// curve.
constexpr double most_slack = 1.02;

void note_length(const CurveFit& fit, CurveReach& reach) {
  const double length = fit.goal().length();
  const int columns = fit.ties().columns();
  const AngleRange theta{fit.lower()[fit.ties().variables()], fit.upper()[fit.ties().variables()]};
  const double straight = columns * fit.cell_mm();
  reach.shortest_mm = straight * std::cos(theta.upper);
  reach.longest_mm = straight * std::cos(theta.lower);
  const bool too_short = reach.longest_mm < length;
  if (!too_short && !(reach.shortest_mm > most_slack * length)) return;
  reach.obstacles.push_back(fmt::format(
      "the curve is {:.1f} mm long; {} cells of {:.3g} mm span at most {:.1f} mm and, straight, at least "
      "{:.1f} mm (theta "
      "{:.1f} to {:.1f} deg): use {} cells or cell_mm {:.3g}",
      length, columns, fit.cell_mm(), reach.longest_mm, reach.shortest_mm, to_degrees(theta.lower),
      to_degrees(theta.upper),
      std::lround(length / (fit.cell_mm() * std::cos((theta.lower + theta.upper) / 2))),
      length / (columns * std::cos((theta.lower + theta.upper) / 2))));
}

void note_turn(const CurveFit& fit, CurveReach& reach) {
  const auto worst =
      std::max_element(reach.turns.begin(), reach.turns.end(),
                       [](const ColumnTurn& a, const ColumnTurn& b) { return a.excess < b.excess; });
  if (!(worst->excess > 0)) return;
  const auto count =
      std::count_if(reach.turns.begin(), reach.turns.end(), [](auto& t) { return t.excess > 0; });
  const Eigen::Vector2d at = fit.goal().at(worst->arc_mm);
  const double turn = std::abs(worst->needed);
  const bool too_little = turn > worst->allowed;
  const std::string others = count > 1 ? fmt::format(" ({} columns are out of bounds)", count) : "";
  const std::string bounds =
      too_little
          ? fmt::format(
                "the bounds allow {:.1f} deg at theta {:.1f} deg{}: allow larger tilts, a larger "
                "theta, or use smaller cells",
                to_degrees(worst->allowed), to_degrees(reach.theta), others)
          : fmt::format(
                "the bounds ask for at least {:.1f} deg more at theta {:.1f} deg{}: allow smaller tilts",
                to_degrees(worst->excess), to_degrees(reach.theta), others);
  reach.obstacles.push_back(fmt::format(
      "{:.1f} mm along the curve (x {:.1f}, z {:.1f}) column {} would need to turn {:.1f} deg to the {}, {}",
      worst->arc_mm, at.x(), at.y(), worst->column, to_degrees(turn), worst->needed < 0 ? "right" : "left",
      bounds));
}

}  // namespace

double needed_turn(const targets::Curve& goal, int column, int columns) {
  const double step = goal.length() / columns, arc = (column + 0.5) * step;
  const Eigen::Vector2d before = goal.at(arc) - goal.at(arc - step),
                        after = goal.at(arc + step) - goal.at(arc);
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

CurveReach analyse_reach(const CurveFit& fit) {
  const BendTies& ties = fit.ties();
  const int theta_at = ties.variables();
  const double length = fit.goal().length(), step = length / ties.columns();
  CurveReach reach;
  reach.theta = std::clamp(std::acos(std::min(step / fit.cell_mm(), 1.0)), fit.lower()[theta_at],
                           fit.upper()[theta_at]);
  for (int c = 0; c < ties.columns(); ++c) {
    const AngleRange range = ties.range[ties.variable[c]];
    const double lowest = model::crease_turn(range.lower, reach.theta),
                 highest = model::crease_turn(range.upper, reach.theta);
    const double arc = (c + 0.5) * step, needed = needed_turn(fit.goal(), c, ties.columns());
    reach.turns.push_back({c, arc, needed, std::max(0.0, needed < 0 ? -lowest : highest),
                           std::max({0.0, needed - highest, lowest - needed})});
  }
  note_length(fit, reach);
  note_turn(fit, reach);
  return reach;
}

}  // namespace kinetix::optim
