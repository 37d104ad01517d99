#pragma once

#include "model/hinge/hinge_energy.hpp"

/// Stretch energy of a hinge with clearance. Its two points are at +- reach from the hinge point along the
/// axis. The gap g_i of each point has a part across the axis, |g_i - (g_i . c) c|, and a part along it,
/// g_i . c. The unit vector c is the axis half way between the axes that the two bodies carry. Within the
/// clearance p neither part resists. Beyond it, the excess over p resists as without clearance:
///
///     E = sum_i  r E_p(|g_i - (g_i . c) c|) + along E_p(|g_i . c|) + 1/2 loose r |g_i|^2,   r = axial = shear
///     E_p(d) = 1/2 (d - p)_+^2
///
/// Units: k_point edge^2, gaps in cell edges. The corner of E_p is rounded over the width corner_width p, so
/// that second derivatives are continuous; beyond it, forces are those above. The term with `loose` makes the
/// equilibrium within the clearance unique. The mismatch of the axis needs no term: two points with clearance
/// p tilt by 2 asin(p / 2 reach).
namespace kinetix::model {

/// Fraction of the clearance over which the force sets in: half before the edge of the clearance, half beyond
/// it.
constexpr double corner_width = 0.1;
/// Fraction of a point's stiffness across the axis that acts within the clearance. Its energy stays below
/// friction, and the softest tangent of Newton's method is only 1e5 times softer than the stiffest one.
constexpr double loose_stiffness = 1e-5;

/// Response of a point at a distance, per stiffness; distances in cell edges.
struct ClearanceResponse {
  double energy = 0, force = 0, stiffness = 0;  ///< force and stiffness: both are 0 or neither is
};
ClearanceResponse clearance_response(double distance, double play);

/// Returns the stretch energy, k_point edge^2.
double clearance_energy(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                        const Pose& upper, double edge_mm);
/// Adds the stretch energy with its derivatives to `element`.
void add_clearance(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower, const Pose& upper,
                   double edge_mm, Element& element);
/// Adds the derivatives of the stretch energy, along twists as in hinge_gradients(). The clearance has no
/// derivative.
void add_clearance_gradients(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                             const Pose& upper, double edge_mm, const Vector12& along,
                             HingeGradients& derivatives);

/// Distance that resists, with its gradient by the twists of the two bodies, ordered as in Element.
struct ResistingDistance {
  double distance = 0;  ///< cell edges
  double weight = 0;    ///< stiffness over k_point
  Vector12 gradient = Vector12::Zero();
};
/// Returns the distances of one of the two points across the axis and along it. The gradient of a zero
/// distance is 0.
/// @param side -1 or 1
std::array<ResistingDistance, 2> resisting_distances(const RestHinge& hinge, const Stiffness& stiffness,
                                                     const Pose& lower, const Pose& upper, double edge_mm,
                                                     double side);

}  // namespace kinetix::model
