#include "model/sheet/sheet_motion.hpp"

#include <cmath>

#include "model/assembly/assembly_motion.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "model/lattice/square/family/drive.hpp"
#include "model/lattice/square/family/planar_sheet.hpp"
#include "model/linkage/actuators.hpp"
#include "model/linkage/make_drive.hpp"

namespace kinetix::model {
namespace {

Drive square_drive(const Structure& sheet, const SheetDrive& drive) {
  Drive out;
  out.kind = drive.kind;
  out.axis = drive.axis;
  out.compression = drive.compression;
  out.branch = drive.branch;
  out.grip = drive.grip;
  out.press = drive.press;
  if (drive.kind == LinkageDrive::Kind::hinge) out.wall = sheet.hinges.at(drive.hinge).wall;
  out.angle = drive.angle;
  return out;
}

LinkageDrive planar_drive(const PlanarStructure& sheet, const SheetDrive& drive) {
  if (drive.kind == LinkageDrive::Kind::hinge) return hinge_drive(sheet, drive.hinge, drive.angle);
  LinkageDrive out = plate_drive(sheet, drive.axis, drive.compression, drive.branch);
  out.press = drive.press;
  return out;
}

LinkageDrive block_drive(const SodaliteStructure& block, const SheetDrive& drive) {
  if (drive.kind == LinkageDrive::Kind::hinge) return hinge_drive(block, drive.hinge, drive.angle);
  LinkageDrive out = plate_drive(block, drive.axis, drive.compression, drive.branch);
  out.press = drive.press;
  return out;
}

/// A hinge of imported bodies that is turned. @param hinge -1: that which turns most in the first motion
LinkageDrive turned(const Linkage& bodies, int hinge, double angle) {
  if (hinge < 0) hinge = first_motion(bodies).fastest;
  if (hinge < 0)
    throw InvalidInput(
        "nothing moves: no hinge turns in a first motion; `drive: {hinge: NAME, ...}` says which to turn");
  return turned_hinge(hinge, bodies.bodies[bodies.hinges[hinge].lower].sense, angle);
}

constexpr double probe =
    0.01;  // rad: so near flat, a cord that pulls to a side is shorter by a hundredth of a cell
constexpr double as_short = 1e-9;  // of the cord: both sides are alike, but for rounding

/// The side of flat to which a cord pulls from the first where the sheet moves exactly; else, and where both are alike, the
/// drive's own.
int side_of(const Sheet& sheet, const LinkageDrive& cord) {
  const ExactMotion exact = exact_motion(sheet);
  if (!exact) return cord.branch;
  const double forth = cord_length(sheet, cord.through, exact.at(probe)),
               back = cord_length(sheet, cord.through, exact.at(-probe));
  if (std::abs(forth - back) <= as_short * cord.rest_mm) return cord.branch;
  return forth < back ? 1 : -1;
}

LinkageDrive pull(const Sheet& sheet, const SheetDrive& drive) {
  LinkageDrive cord = cord_drive(sheet, drive.through, drive.shorten_mm, drive.branch);
  cord.branch = side_of(sheet, cord);
  return cord;
}

/// Of any lattice alike.
LinkageDrive drive_on_hinges(const Sheet& sheet, const SheetDrive& drive) {
  validate_hinges(sheet);
  return drive.kind == LinkageDrive::Kind::cord
             ? pull(sheet, drive)
             : shape_memory_drive(sheet, drive.springs, drive.k_turn, drive.angle);
}

Sheet between(const Sheet& before, const Sheet& after, double part) {
  if (part >= 1) return after;
  Sheet out = after;
  const auto mix = [part](double a, double b) { return a + part * (b - a); };
  for (int k = 0; k < out.hinges(); ++k) {
    const HingeParameters& a = before.hinge(k);
    HingeParameters& p = out.hinge(k);
    p = {mix(a.t, p.t), mix(a.alpha, p.alpha), mix(a.beta, p.beta), mix(a.offset, p.offset)};
  }
  return out;
}

}  // namespace

PlanarStructure planar_structure(const Sheet& sheet) {
  if (const Structure* squares = sheet.squares()) return planar_structure(*squares);
  if (sheet.sodalite()) throw InvalidInput("a sodalite lattice is not a planar sheet");
  if (sheet.assembly()) throw InvalidInput("imported bodies are no planar sheet");
  return *sheet.planar();
}

void place_hinges(const Redrawing& y, Sheet& sheet) {
  if (Structure* squares = sheet.squares()) return place_hinges(y, *squares);
  place_hinges(y, *sheet.planar());
}

ExactMotion exact_motion(const Sheet& sheet) {
  if (const Structure* squares = sheet.squares()) return exact_motion(*squares);
  if (const SodaliteStructure* block = sheet.sodalite()) return exact_motion(*block);
  if (sheet.assembly()) return {{}, "none", "imported bodies have no closed form"};
  return exact_motion(*sheet.planar());
}

LinkageDrive drive_on(const Sheet& sheet, const SheetDrive& drive) {
  if (drive.kind == LinkageDrive::Kind::cord || drive.kind == LinkageDrive::Kind::shape_memory)
    return drive_on_hinges(sheet, drive);
  if (const Structure* squares = sheet.squares()) return square_drive(*squares, drive).on(*squares);
  if (const SodaliteStructure* block = sheet.sodalite()) return block_drive(*block, drive);
  if (sheet.assembly()) return turned(sheet, drive.hinge, drive.angle);
  return planar_drive(*sheet.planar(), drive);
}

LinkageDrive drive_to(const Sheet& sheet, double theta) {
  if (const Structure* squares = sheet.squares()) return drive_to(*squares, theta).on(*squares);
  if (const SodaliteStructure* block = sheet.sodalite()) return drive_to(*block, theta);
  if (sheet.assembly()) return turned(sheet, -1, 0).to(theta);
  return drive_to(*sheet.planar(), theta);
}

std::function<DrivenLinkage(double)> changing(const Sheet& before, const Sheet& after,
                                              const LinkageDrive& drive) {
  return [=](double part) {
    const Sheet sheet = between(before, after, part);
    return DrivenLinkage{sheet, drive, exact_motion(sheet)};
  };
}

}  // namespace kinetix::model
