#include "model/hinge/elasticity.hpp"

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
}

double energy_unit(const Elasticity& e, double edge_mm) { return e.k_point * edge_mm * edge_mm; }

Stiffness relative(const Elasticity& e, double edge_mm) {
  return {e.k_turn / (e.k_point * edge_mm * edge_mm), e.reach_mm / edge_mm, e.k_contact / e.k_point, e.law};
}

}  // namespace kinetix::model
