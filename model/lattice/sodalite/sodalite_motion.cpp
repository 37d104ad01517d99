#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/sodalite/sodalite.hpp"
#include "model/linkage/make_drive.hpp"
#include "model/linkage/probe_thetas.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double closed = 1e-9;     // cell edges: rings that do not close exceed it by far at some probe
constexpr double same_axis = 1e-9;  // rad: tolerance as in validate_hinges
constexpr double one_row = 1e-9;    // cell edges: rounding separates rotors of one layer by as much

/// Path over a gusset from one rotor to the next, with its two hinges.
struct Bridge {
  int from = 0, to = 0, gusset = 0;  ///< rotors, and the gusset's number
  /// To the first hinge, on to the second one, and to that one from its rotor
  Vector3d from_arm, over, to_arm;
  Vector3d to_middle;  ///< from the first hinge to the gusset's middle
};

/// Tree of bridges from rotor 0, and the remaining bridges.
struct Walk {
  std::vector<Bridge> tree, rest;
};

Bridge bridge(const SodaliteStructure& s, const Linkage& linkage, int gusset, int from) {
  const int first = s.gussets[gusset][0] == from ? 0 : 1;
  const RestHinge &a = linkage.hinges[2 * gusset + first], &b = linkage.hinges[2 * gusset + 1 - first];
  return {from, b.lower, gusset, a.lower_arm, b.upper_arm - a.upper_arm, b.lower_arm, -a.upper_arm};
}

Walk walk(const SodaliteStructure& s) {
  const Linkage linkage = s;
  std::vector<std::vector<int>> at(s.rotors.size());
  for (int k = 0; k < static_cast<int>(s.gussets.size()); ++k)
    for (const int rotor : s.gussets[k]) at[rotor].push_back(k);
  std::vector<bool> met(s.rotors.size()), used(s.gussets.size());
  std::vector<int> queue = {0};
  met[0] = true;
  Walk out;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int k : at[queue[next]]) {
      if (used[k]) continue;
      used[k] = true;
      const Bridge b = bridge(s, linkage, k, queue[next]);
      (met[b.to] ? out.rest : out.tree).push_back(b);
      if (met[b.to]) continue;
      met[b.to] = true;
      queue.push_back(b.to);
    }
  return out;
}

Matrix3d turn_of(const SodaliteRotor& rotor, double theta) {
  return Eigen::AngleAxisd(2 * rotor.sign * theta, Vector3d::Unit(rotor.axis)).toRotationMatrix();
}

/// Returns the position of a bridge's second rotor.
Vector3d over(const Bridge& b, const State& state) {
  return state[b.from].p + state[b.from].R * b.from_arm + b.over - state[b.to].R * b.to_arm;
}

/// Returns the state at theta, in cell edges.
State folded(const SodaliteStructure& s, const Walk& walk, double theta) {
  const int rotors = static_cast<int>(s.rotors.size());
  State state(rotors + s.gussets.size());
  for (int r = 0; r < rotors; ++r) state[r].R = turn_of(s.rotors[r], theta);
  state[0].p = sodalite_place(s, 0);
  for (const Bridge& b : walk.tree) state[b.to].p = over(b, state);
  for (const std::vector<Bridge>* part : {&walk.tree, &walk.rest})
    for (const Bridge& b : *part)
      state[rotors + b.gusset].p = state[b.from].p + state[b.from].R * b.from_arm + b.to_middle;
  return state;
}

State in_mm(State state, double edge_mm) {
  for (Pose& pose : state) pose.p *= edge_mm;
  return state;
}

/// Returns the largest misfit of the walk, cell edges.
double misfit(const SodaliteStructure& s, const Walk& walk) {
  double most = 0;
  for (const double theta : probe_thetas) {
    const State state = folded(s, walk, theta);
    for (const Bridge& b : walk.rest) most = std::max(most, (over(b, state) - state[b.to].p).norm());
  }
  return most;
}

/// Returns a hinge that leans from its rotor's axis, about which it would have to turn; -1 if there is none.
int off_its_axis(const SodaliteStructure& s) {
  const Linkage linkage = s;
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const SodaliteRotor& rotor = s.rotors[linkage.hinges[h].lower];
    if (!((linkage.hinges[h].axis - rotor.sign * Vector3d::Unit(rotor.axis)).norm() <= same_axis)) return h;
  }
  return -1;
}

GrippedRows outer_rotors(const SodaliteStructure& s, Axis axis) {
  const int d = component(axis);
  double low = 0, high = 0;
  for (int r = 0; r < static_cast<int>(s.rotors.size()); ++r) {
    const double at = sodalite_place(s, r)[d];
    low = r == 0 ? at : std::min(low, at);
    high = r == 0 ? at : std::max(high, at);
  }
  GrippedRows rows;
  for (int r = 0; r < static_cast<int>(s.rotors.size()); ++r) {
    const double at = sodalite_place(s, r)[d];
    if (at < low + one_row) rows[0].push_back(r);
    if (at > high - one_row) rows[1].push_back(r);
  }
  return rows;
}

/// Theta and turns of hinges apart by rounding: as the bodies of plates have it.
void check_between_plates(const LinkageDrive& drive, const Linkage& linkage, const State& state) {
  if (!drive.has_plates()) return;
  if (planes_of(drive.gripped, state).off_plane <= 1e-8 * linkage.size.edge_mm) return;
  throw InvalidInput("plates would hold rotors in a plane that leave it in the lattice's exact motion",
                     {"", 0, 0, "drive.axis"});
}

}  // namespace

ExactMotion exact_motion(const SodaliteStructure& structure) {
  const auto s = std::make_shared<const SodaliteStructure>(structure);
  const auto way = std::make_shared<const Walk>(walk(*s));
  if (const double gap = misfit(*s, *way); !(gap <= closed))
    return {{},
            "none",
            "no exact family: rings of rotors and gussets do not close; they are off by " + number_text(gap) +
                " cell edges"};
  if (const int h = off_its_axis(*s); h >= 0)
    return {{},
            "none",
            "no exact family: the hinge on wall [" + std::to_string(hinged_wall(*s, h).lower) + ", " +
                std::to_string(hinged_wall(*s, h).upper) + "] has not the axis of its rotor"};
  const auto at = [s, way](double theta) { return in_mm(folded(*s, *way, theta), s->size.edge_mm); };
  const auto theta = [s, at](const LinkageDrive& drive) {
    const Linkage linkage = *s;
    check_between_plates(drive, linkage, at(probe_thetas[1]));
    return theta_of(drive, linkage, at);
  };
  return {at, "sodalite",
          "sodalite: rotors turn by 2 theta about the axes of space, gussets keep their direction", theta};
}

LinkageDrive plate_drive(const SodaliteStructure& structure, Axis axis, double compression, int branch) {
  validate_hinges(structure);
  return plates_between(outer_rotors(structure, axis), axis, compression, branch,
                        static_cast<int>(structure.rotors.size() + structure.gussets.size()));
}

LinkageDrive hinge_drive(const SodaliteStructure& structure, int hinge, double angle) {
  validate_hinges(structure);
  return turned_hinge(hinge, 1, angle);
}

LinkageDrive drive_to(const SodaliteStructure& structure, double theta) {
  require("theta", theta, std::abs(theta) < pi / 2, "in (-pi/2, pi/2) rad");
  const ExactMotion exact = exact_motion(structure);
  if (!exact) return hinge_drive(structure, 0, turn_at_theta(1, theta));
  LinkageDrive drive = plate_drive(structure, Axis::y, 0, theta < 0 ? -1 : 1);
  const Linkage linkage = structure;
  drive.compression = 1 - planes_of(drive.gripped, exact.at(theta)).distance /
                              planes_of(drive.gripped, rest_state(linkage)).distance;
  return drive;
}

}  // namespace kinetix::model
