#pragma once

#include <array>

#include "model/hinge/hinge_energy.hpp"

/// The stretch energy of a hinge with play. The gap g_i of each of its two points, the reach to either side of
/// the hinge point along the axis, has a part across the axis, |g_i - (g_i . c) c|, and one along it, g_i . c,
/// with c the axis half way between what the two bodies carry. Within the play p neither pulls; beyond it each
/// does as without play by what its distance exceeds:
///
///     E = sum_i  r E_p(|g_i - (g_i . c) c|) + along E_p(|g_i . c|) + 1/2 loose r |g_i|^2,   r = axial = shear
///     E_p(d) = 1/2 (d - p)_+^2
///
/// in units of k_point edge^2, gaps in cell edges. The corner of E_p is rounded over played_width of the play, so
/// that second derivatives are continuous; beyond it, forces are those above. `loose` keeps bodies from lying
/// anywhere within the play, where no equilibrium is a point of its own. The mismatch of the axis needs no term:
/// two points with play p tilt by 2 asin(p / 2 reach).
namespace kinetix::model {

/// Of the play, in which the pull begins: half before it and half behind.
constexpr double played_width = 0.1;
/// Of a point's stiffness across the axis, within the play: a thousandth of the energy that the whole play would
/// take stays below friction, and Newton's method has a tangent 1e5 times softer than its stiffest.
constexpr double played_loose = 1e-5;

/// What a point does at a distance, per stiffness; distances in cell edges.
struct PlayResponse {
  double energy = 0, force = 0, stiffness = 0;  ///< force and stiffness are both 0 or neither is
};
PlayResponse play_response(double distance, double play);

/// Stretch energy alone, k_point edge^2.
double play_energy(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower, const Pose& upper,
                   double edge_mm);
/// Adds it with its derivatives.
void add_play(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower, const Pose& upper,
              double edge_mm, Element& element);
/// Adds its derivatives, along twists as in hinge_gradients. By the clearance there is none.
void add_play_gradients(const RestHinge& hinge, const Stiffness& stiffness, const Pose& lower,
                        const Pose& upper, double edge_mm, const Vector12& along,
                        HingeGradients& derivatives);

/// A distance that pulls: how far, and its gradient by the twists of the two bodies, ordered as in Element.
struct PlayedDistance {
  double distance = 0;  ///< cell edges
  double weight = 0;    ///< of the stiffness, over k_point
  Vector12 gradient = Vector12::Zero();
};
/// Across the axis and along it, of one of the two points. The gradient is 0 where the distance is.
/// @param side -1 or 1
std::array<PlayedDistance, 2> played_distances(const RestHinge& hinge, const Stiffness& stiffness,
                                               const Pose& lower, const Pose& upper, double edge_mm,
                                               double side);

}  // namespace kinetix::model
