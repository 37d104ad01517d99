#include "model/lattice/lattice_motion.hpp"

#include <cmath>

#include "model/assembly/assembly_motion.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/family/planar_sheet.hpp"
#include "model/linkage/actuators.hpp"
#include "model/linkage/make_drive.hpp"

namespace kinetix::model {
namespace {

/// Returns a drive that turns a hinge of imported bodies. @param hinge -1: the one with the largest turn in the first
/// motion
LinkageDrive turned(const Linkage& bodies, int hinge, double angle) {
  if (hinge < 0) hinge = first_motion(bodies).fastest;
  if (hinge < 0)
    throw InvalidInput(
        "nothing moves: no hinge turns in a first motion; `drive: {hinge: NAME, ...}` says which to turn");
  return turned_hinge(hinge, bodies.bodies[bodies.hinges[hinge].lower].sense, angle);
}

// Rad: near flat, where a one-sided tendon is already shorter by a hundredth of a cell
constexpr double probe = 0.01;
constexpr double as_short = 1e-9;  // relative to the tendon: rounding, both sides are equal.

/// Returns the side of flat to which a tendon pulls initially, if the sheet moves exactly. Otherwise, or if both
/// sides are equal, it returns the drive's side.
int side_of(const Lattice& sheet, const LinkageDrive& cord) {
  const ExactMotion exact = exact_motion(sheet);
  if (!exact) return cord.branch;
  const double forth = cord_length(sheet, cord.through, exact.at(probe)),
               back = cord_length(sheet, cord.through, exact.at(-probe));
  if (std::abs(forth - back) <= as_short * cord.rest_mm) return cord.branch;
  return forth < back ? 1 : -1;
}

/// Converts the drive of a file to bodies and hinges.
struct OnSheet {
  const Lattice& sheet;
  int side;  ///< side of flat if the drive has no branch

  LinkageDrive operator()(const Plates& plates) const {
    LinkageDrive out = plates_on(plates, plates.branch.value_or(side));
    out.press = plates.press;
    return out;
  }

  LinkageDrive operator()(const HingeTurn& turn) const {
    if (sheet.assembly()) return turned(sheet, turn.hinge, turn.angle);
    if (const Structure* squares = sheet.squares()) return hinge_drive(*squares, turn.hinge, turn.angle);
    if (const SodaliteStructure* block = sheet.sodalite()) return hinge_drive(*block, turn.hinge, turn.angle);
    return hinge_drive(*sheet.planar(), turn.hinge, turn.angle);
  }

  LinkageDrive operator()(const CordPull& pull) const {
    validate_hinges(sheet);
    LinkageDrive cord = cord_drive(sheet, pull.through, pull.shorten_mm, pull.branch.value_or(side));
    cord.branch = side_of(sheet, cord);
    return cord;
  }

  LinkageDrive operator()(const ShapeMemory& hot) const {
    validate_hinges(sheet);
    return shape_memory_drive(sheet, hot.springs, hot.k_turn, hot.angle);
  }

  LinkageDrive operator()(const BodyPull&) const { return {}; }

 private:
  LinkageDrive plates_on(const Plates& plates, int branch) const {
    if (const Structure* squares = sheet.squares())
      return plate_drive(*squares, plates.axis, plates.compression, branch, plates.grip);
    if (const SodaliteStructure* block = sheet.sodalite())
      return plate_drive(*block, plates.axis, plates.compression, branch);
    return plate_drive(*sheet.planar(), plates.axis, plates.compression, branch);
  }
};

/// Copies the end point of `shown` to a drive.
struct EndAt {
  const LinkageDrive& shown;

  void operator()(Plates& plates) const {
    plates.compression = shown.compression;
    plates.branch = shown.branch;
  }
  void operator()(HingeTurn& turn) const { turn.angle = shown.angle; }
  void operator()(CordPull& cord) const {
    cord.shorten_mm = shown.shorten_mm;
    cord.branch = shown.branch;
  }
  void operator()(ShapeMemory& hot) const { hot.angle = shown.angle; }
  void operator()(BodyPull&) const {}
};

Lattice between(const Lattice& before, const Lattice& after, double part) {
  if (part >= 1) return after;
  Lattice out = after;
  const auto mix = [part](double a, double b) { return a + part * (b - a); };
  for (int k = 0; k < out.hinges(); ++k) {
    const HingeParameters& a = before.hinge(k);
    HingeParameters& p = out.hinge(k);
    p = {mix(a.t, p.t), mix(a.alpha, p.alpha), mix(a.beta, p.beta), mix(a.offset, p.offset)};
  }
  return out;
}

}  // namespace

PlanarStructure planar_structure(const Lattice& sheet) {
  if (const Structure* squares = sheet.squares()) return planar_structure(*squares);
  if (sheet.sodalite()) throw InvalidInput("a sodalite lattice is not a planar sheet");
  if (sheet.assembly()) throw InvalidInput("imported bodies are no planar sheet");
  return *sheet.planar();
}

void place_hinges(const Redrawing& y, Lattice& sheet) {
  if (Structure* squares = sheet.squares()) return place_hinges(y, *squares);
  place_hinges(y, *sheet.planar());
}

ExactMotion exact_motion(const Lattice& sheet) {
  if (const Structure* squares = sheet.squares()) return exact_motion(*squares);
  if (const SodaliteStructure* block = sheet.sodalite()) return exact_motion(*block);
  if (sheet.assembly()) return {{}, "none", "imported bodies have no closed form"};
  return exact_motion(*sheet.planar());
}

LinkageDrive drive_on(const Lattice& sheet, const Drive& drive, double theta) {
  return std::visit(OnSheet{sheet, theta < 0 ? -1 : 1}, drive);
}

Drive as_far_as(const LinkageDrive& shown, Drive drive) {
  std::visit(EndAt{shown}, drive);
  return drive;
}

Drive scaled(Drive drive, double factor) {
  if (auto* cord = std::get_if<CordPull>(&drive)) cord->shorten_mm *= factor;
  return drive;
}

bool needs_elastic_hinges(const Drive& drive) {
  const auto* plates = std::get_if<Plates>(&drive);
  return plates ? plates->press : std::holds_alternative<ShapeMemory>(drive);
}

double spring_stiffness(const Drive& drive) {
  const auto* hot = std::get_if<ShapeMemory>(&drive);
  return hot ? hot->k_turn : 0;
}

DrivenLinkage driven(const Lattice& sheet, const Drive& drive) {
  return {sheet, drive_on(sheet, drive), exact_motion(sheet)};
}

std::vector<DrivenLinkage> driven(const Lattice& sheet, const std::vector<Drive>& drives) {
  std::vector<DrivenLinkage> all;
  for (const Drive& drive : drives) all.push_back(driven(sheet, drive));
  return all;
}

LinkageDrive drive_to(const Lattice& sheet, double theta) {
  if (const Structure* squares = sheet.squares()) return drive_on(sheet, drive_to(*squares, theta));
  if (const SodaliteStructure* block = sheet.sodalite()) return drive_to(*block, theta);
  if (sheet.assembly()) return turned(sheet, -1, 0).to(theta);
  return drive_to(*sheet.planar(), theta);
}

std::function<DrivenLinkage(double)> changing(const Lattice& before, const Lattice& after,
                                              const LinkageDrive& drive) {
  return [=](double part) {
    const Lattice sheet = between(before, after, part);
    return DrivenLinkage{sheet, drive, exact_motion(sheet)};
  };
}

}  // namespace kinetix::model
