#include "model/hinge/elasticity.hpp"

#include <cmath>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {

TurnResponse SetHinge::at(double turn, double k_turn) const {
  return LinearHinge().at(std::remainder(turn - set_, 2 * pi), k_turn);
}

const std::shared_ptr<const HingeLaw>& linear_hinge() {
  static const std::shared_ptr<const HingeLaw> law = std::make_shared<LinearHinge>();
  return law;
}

namespace {

// N/mm, N mm/rad, mm: products and ratios of three such numbers stay far from the limits of double.
constexpr double least = 1e-30, most = 1e30;

void check_positive(const char* field, double value) {
  require(field, value, value >= least && value <= most, "positive, from 1e-30 to 1e+30");
}

void check_clearance(const Elasticity& e) {
  require("play_mm", e.play_mm, e.play_mm >= 0 && e.play_mm <= e.reach_mm,
          "from 0 to the reach, which is " + std::to_string(e.reach_mm) + " mm");
  if (e.play_mm > 0 && !(e.ratios.axial == e.ratios.shear && e.tilt.are_by_reach()))
    throw InvalidInput("play_mm is " + number_text(e.play_mm) +
                       ", which only applies to a hinge that is equally stiff along and across its wall and "
                       "tilts by its reach");
}

}  // namespace

void Elasticity::validate() const {
  check_positive("k_point", k_point);
  check_positive("k_turn", k_turn);
  check_positive("reach_mm", reach_mm);
  check_positive("k_contact", k_contact);
  check_positive("ratios.axial", ratios.axial);
  check_positive("ratios.shear", ratios.shear);
  check_positive("ratios.along", ratios.along);
  if (tilt.rock) check_positive("tilt.rock", *tilt.rock);
  if (tilt.twist) check_positive("tilt.twist", *tilt.twist);
  check_clearance(*this);
  for (const Elasticity& hinge : each) hinge.validate();
}

double Stiffness::min_turn() const {
  double least = each.empty() ? turn : each.front().turn;
  for (const Stiffness& hinge : each) least = std::min(least, hinge.turn);
  return least;
}

double Stiffness::twist_weight() const {
  return tilt.twist ? *tilt.twist / 2 : ratios.shear * (reach * reach);
}

double Stiffness::rock_beyond_twist() const {
  if (tilt.are_by_reach()) return (ratios.axial - ratios.shear) * (reach * reach);
  return (tilt.rock ? *tilt.rock / 2 : ratios.axial * (reach * reach)) - twist_weight();
}

void Stiffness::drop_tilt() {
  reach = 0;
  tilt = {};
}

double energy_unit(const Elasticity& e, double edge_mm) { return e.k_point * edge_mm * edge_mm; }

void Stiffness::check_count(std::size_t hinges) const {
  if (each.empty() || each.size() == hinges) return;
  throw InvalidInput("each has " + std::to_string(each.size()) + " entries, must be empty or have " +
                     std::to_string(hinges) + ", one per hinge");
}

namespace {

/// Converts one hinge to relative units, with the given k_point (N/mm) as the unit of stiffness.
Stiffness relative_to(double k_point, const Elasticity& e, double edge_mm) {
  const double k = e.k_point / k_point, unit = k_point * edge_mm * edge_mm;
  const auto over_unit = [&](const std::optional<double>& tilt) -> std::optional<double> {
    if (!tilt) return {};
    return *tilt / unit;
  };
  return {.turn = e.k_turn / unit,
          .reach = e.reach_mm / edge_mm,
          .contact = e.k_contact / k_point,
          .law = e.law,
          .ratios = {e.ratios.axial * k, e.ratios.shear * k, e.ratios.along * k},
          .tilt = {over_unit(e.tilt.rock), over_unit(e.tilt.twist)},
          .play = e.play_mm / edge_mm};
}

}  // namespace

Stiffness relative(const Elasticity& e, double edge_mm) {
  Stiffness whole = relative_to(e.k_point, e, edge_mm);
  whole.each.reserve(e.each.size());
  for (const Elasticity& hinge : e.each) {
    whole.each.push_back(relative_to(e.k_point, hinge, edge_mm));
    whole.each.back().contact = whole.contact;
  }
  return whole;
}

Elasticity elasticity_of(const HingeStiffness& k, double reach_mm) {
  const double largest = std::max({k.axial, k.shear, k.along});
  return {.k_point = largest / 2,
          .k_turn = k.turn,
          .reach_mm = reach_mm,
          .k_contact = 5 * largest,
          .ratios = {k.axial / largest, k.shear / largest, k.along / largest},
          .tilt = {k.rock, k.twist}};
}

HingeStiffness stiffness_of(const Elasticity& e) {
  const double both = 2 * e.k_point;
  return {both * e.ratios.axial, both * e.ratios.shear, both * e.ratios.along, e.k_turn,
          e.tilt.rock,           e.tilt.twist};
}

}  // namespace kinetix::model
