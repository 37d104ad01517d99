#include "model/lattice/nearest_design.hpp"

#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/planar/exact_designs.hpp"
#include "model/lattice/square/changed_cells.hpp"
#include "model/lattice/square/crease.hpp"

namespace kinetix::model {
namespace {

constexpr double same = 1e-12;  // rad or cell edges: less is no change

/// Returns one of the values, so that as few hinges as possible change.
double upper_median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double change(const HingeParameters& a, const HingeParameters& b) {
  const Eigen::Vector4d d(a.t - b.t, a.alpha - b.alpha, a.beta - b.beta, a.offset - b.offset);
  return d.squaredNorm();
}

NearestDesign compared(Lattice sheet, const Lattice& with) {
  NearestDesign out{std::move(sheet), {}};
  for (int h = 0; h < with.hinges(); ++h)
    if (change(out.sheet.hinge(h), with.hinge(h)) > same * same) out.changed.push_back(h);
  return out;
}

double distance(const Lattice& a, const Lattice& b) {
  double sum = 0;
  for (int h = 0; h < a.hinges(); ++h) sum += change(a.hinge(h), b.hinge(h));
  return sum;
}

/// Gives the walls across one crease one tilt; upright walls get one hinge position.
void align(Structure& structure, const Crease& crease, bool tilted) {
  Hinge first = structure.hinges[crease.hinges.front()];
  std::vector<double> tilts, places;
  for (const int h : crease.hinges) {
    const Hinge& hinge = structure.hinges[h];
    tilts.push_back(alternation(hinge.wall) * hinge.parameters.beta);
    places.push_back(carried_to(first.wall, hinge).t);
  }
  const double tilt = tilted ? upper_median(std::move(tilts)) : 0;
  set_tilt(structure, crease, tilt);
  if (tilt != 0) return;
  first.parameters.t = upper_median(std::move(places));
  for (const int h : crease.hinges)
    structure.hinges[h].parameters.t = carried_to(structure.hinges[h].wall, first).t;
}

enum class Tilted { both, along_x, along_y };

/// @param centred true: walls without tilt have their hinges in the middle
Structure aligned(Structure structure, Tilted which, bool centred) {
  for (const Crease& crease : find_creases(structure).list) {
    const bool along_x = crease.axis == Axis::x;
    const bool tilted = which == Tilted::both || (which == Tilted::along_x) == along_x;
    align(structure, crease, tilted);
    if (!tilted && centred) set_tilt(structure, crease, 0);
  }
  return structure;
}

Lattice upright(Lattice sheet) {
  for (int h = 0; h < sheet.hinges(); ++h) {
    sheet.hinge(h).alpha = pi / 2;
    sheet.hinge(h).beta = 0;
  }
  const PlanarStructure closed = nearest_exact(planar_structure(sheet));
  for (int h = 0; h < sheet.hinges(); ++h) sheet.hinge(h) = closed.hinges[h];
  return sheet;
}

std::vector<Lattice> candidates(const Lattice& sheet) {
  std::vector<Lattice> all;
  if (const Structure* squares = sheet.squares())
    for (const Tilted which : {Tilted::both, Tilted::along_x, Tilted::along_y})
      for (const bool centred : {false, true}) all.push_back(aligned(*squares, which, centred));
  else
    all.push_back(nearest_exact(*sheet.planar()));
  all.push_back(upright(sheet));
  return all;
}

}  // namespace

std::optional<NearestDesign> nearest_design(const Lattice& sheet) {
  if (exact_motion(sheet)) return NearestDesign{sheet, {}};
  std::vector<Lattice> all = candidates(sheet);
  const auto nearer = [&](const Lattice& a, const Lattice& b) {
    return distance(a, sheet) < distance(b, sheet);
  };
  std::stable_sort(all.begin(), all.end(), nearer);
  for (Lattice& one : all)
    if (exact_motion(one)) return compared(std::move(one), sheet);
  return std::nullopt;
}

}  // namespace kinetix::model
