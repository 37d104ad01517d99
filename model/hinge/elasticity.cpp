#include "model/hinge/elasticity.hpp"

#include <algorithm>
#include <sstream>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

// N/mm, N mm/rad, mm: products and ratios of three such numbers are far from the ends of double.
constexpr double least = 1e-30, most = 1e30;

void check_positive(const char* field, double value) {
  if (value >= least && value <= most) return;
  std::ostringstream message;
  message << field << " is " << value << ", must be positive, from " << least << " to " << most;
  throw InvalidInput(message.str());
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
  for (const Elasticity& hinge : each) hinge.validate();
}

double Stiffness::least_turn() const {
  double least = each.empty() ? turn : each.front().turn;
  for (const Stiffness& hinge : each) least = std::min(least, hinge.turn);
  return least;
}

double energy_unit(const Elasticity& e, double edge_mm) { return e.k_point * edge_mm * edge_mm; }

void Stiffness::check_count(std::size_t hinges) const {
  if (each.empty() || each.size() == hinges) return;
  std::ostringstream message;
  message << "each has " << each.size() << " entries, must be empty or have " << hinges << ", one a hinge";
  throw InvalidInput(message.str());
}

namespace {

/// One hinge in the units of another k_point.
Stiffness relative_to(double k_point, const Elasticity& e, double edge_mm) {
  const double k = e.k_point / k_point;
  return {.turn = e.k_turn / (k_point * edge_mm * edge_mm),
          .reach = e.reach_mm / edge_mm,
          .contact = e.k_contact / k_point,
          .law = e.law,
          .ratios = {e.ratios.axial * k, e.ratios.shear * k, e.ratios.along * k}};
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
          .ratios = {k.axial / largest, k.shear / largest, k.along / largest}};
}

HingeStiffness stiffness_of(const Elasticity& e) {
  const double both = 2 * e.k_point;
  return {both * e.ratios.axial, both * e.ratios.shear, both * e.ratios.along, e.k_turn};
}

}  // namespace kinetix::model
