#pragma once

#include <cstdio>

#include "tests/support/elastic_runs.hpp"
#include "tests/support/hard/hard_cases.hpp"

/// Tools of the hard cases. Each theme has a separate file.
namespace kinetix::testing {

using HardCases = std::vector<HardCase>;

HardCases bifurcation_cases();
HardCases range_cases();
HardCases near_flat_cases();
HardCases size_cases();
HardCases mobility_cases();
HardCases wall_cases();
HardCases sameness_cases();
HardCases input_cases();
HardCases planar_lattice_cases();
HardCases crease_cases();
HardCases block_cases();
HardCases made_hinge_cases();
HardCases linkage_sameness_cases();

inline constexpr double deg = radians_per_degree;  ///< rad, so that angles of cases read in degrees

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char out[300];
  std::snprintf(out, sizeof out, format, numbers...);
  return out;
}

/// Scene of a hard case: a structure under a drive.
struct HardScene {
  model::Structure structure;
  model::Drive drive;
  model::Elasticity elasticity;
  bool contact = false;

  double theta() const { return drive_on(structure, drive).theta(); }  ///< rad
};

/// Scene of any lattice under a drive, with its closed form if it has one.
struct LinkageScene {
  model::DrivenLinkage driven;
  model::Elasticity elasticity;
  model::EquilibriumPathOptions options = without_contact();
};

/// Elasticity of stiffness ratio k_turn / (k_point L^2) for the default cell of 10 mm.
model::Elasticity of_ratio(double ratio);

model::EquilibriumPath followed(const HardScene& scene, model::EquilibriumPathOptions options = {});
/// Follows a path in steps so short that the trapezoidal rule gives the work of the drive.
model::EquilibriumPath followed_finely(const HardScene& scene);

/// Returns the energy of a state, N mm.
double energy_of(const HardScene& scene, const model::State& state);
/// Returns the work of the drive during the motion, N mm. A path of equilibria without jumps stores it all.
double work_of(const HardScene& scene, const model::EquilibriumPath& path);

/// Formats the path as "reached: E 1.2 N mm, gap 3e-7", then events, then `found`.
std::string describe_path(const model::EquilibriumPath& path, const std::string& found);
/// Returns the answer for a path. An unstable equilibrium is never right.
HardAnswer answer(const HardScene& scene, const model::EquilibriumPath& path, bool right,
                  const std::string& found);

/// Follows the closed form, right within `allowed`, rms in cell edges.
HardAnswer follow_closed_form(const HardScene& scene, double allowed);
HardCase closed_form_case(std::string name, std::function<HardScene()> scene, double allowed);

/// Follows a path, right if the drive's work is the energy stored, to a part `allowed` of it.
HardAnswer follow_strained(const HardScene& scene, double allowed);

model::EquilibriumPath followed(const LinkageScene& scene);
/// Returns the answer for a path, without the equilibrium that another program could search for.
HardAnswer answer(const model::EquilibriumPath& path, bool right, const std::string& found);
/// Follows a path, right if the drive's work is the energy stored, to a part `allowed` of it.
HardAnswer follow_strained(LinkageScene scene, double allowed);
double work_of(const LinkageScene& scene, const model::EquilibriumPath& path);
/// Returns the energy of the turning springs in a state, N mm. A closed form stores no other.
double turning_energy(const LinkageScene& scene, const model::State& state);

/// Judges a path that ended off its closed form, by more than 0.1 rad of a hinge. If the path reports the departure, a
/// right answer becomes diagnosed; otherwise the answer is wrong.
void check_branching(const LinkageScene& scene, const model::EquilibriumPath& path, HardAnswer& answer);

inline constexpr const char* expected_first_order =
    "distance from the closed form, and energy missing from its, 10 times those of ratio 1e9, to 1 %";
/// Checks that springs bend a closed form in proportion to their stiffness ratio, to first order.
/// @param scene of a stiffness ratio   @param theta at which the closed form has the drive's value
HardAnswer follow_softly(const std::function<LinkageScene(double ratio)>& scene, double theta);

/// Checks a closed form alone: right if `worst` is at most `allowed`.
HardAnswer closed_to(double worst, double allowed, const std::string& what);
/// Returns a right answer if the model refuses what is not exact. @param exact answer of the model
HardAnswer check_distinct(bool right, const std::string& exact, const std::string& found);

}  // namespace kinetix::testing
