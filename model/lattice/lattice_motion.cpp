#include "model/lattice/lattice_motion.hpp"

#include "model/assembly/assembly_motion.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::model {
namespace {

/// Returns a drive that turns a hinge of imported bodies. @param hinge -1: the one with the largest turn in the first
/// motion
LinkageDrive turned(const Linkage& bodies, int hinge, double angle) {
  if (hinge < 0) hinge = first_motion(bodies).fastest;
  if (hinge < 0)
    throw InvalidInput(
        "nothing moves: no hinge turns in the first-order motion. Name a hinge by `drive: {hinge: NAME, "
        "...}`");
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

void place_hinges(const ParallelDrawing& y, Lattice& sheet) {
  if (Structure* squares = sheet.squares()) return place_hinges(y, *squares);
  place_hinges(y, *sheet.planar());
}

ExactMotion exact_motion(const Lattice& sheet) {
  if (const Structure* squares = sheet.squares()) return exact_motion(*squares);
  if (const SodaliteStructure* block = sheet.sodalite()) return exact_motion(*block);
  if (sheet.assembly()) return {{}, "none", "imported bodies have no analytic motion"};
  return exact_motion(*sheet.planar());
}

LinkageDrive drive_on(const Lattice& sheet, const Drive& drive, double theta) {
  return std::visit(OnSheet{sheet, theta < 0 ? -1 : 1}, drive);
}

Drive limited_to(const LinkageDrive& shown, Drive drive) {
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

namespace {

/// Adds the shifts of creases that bend and cross, whose fold angles differ
/// (model/lattice/square/family/fold_angles.hpp). In a net they replace theta; in the other families theta is half
/// the turn of the crease that defines it.
void add_shifts(const Structure& squares, std::vector<TurnLaw>& laws) {
  const Classification kind = classify(squares);
  const Creases creases = find_creases(squares);
  const std::vector<double> shifts = fold_shifts(make_fold_angle_tree(squares, creases), squares);
  double own = 1, local_shift = 0;
  if (kind.family != Family::F4) {
    const int defining = squares.cell_members.front().hinges[kind.transposed ? 0 : 1];
    own = laws[defining].p;
    local_shift = shifts[creases.of_hinge[defining]];
  }
  for (std::size_t h = 0; h < laws.size(); ++h)
    laws[h] = {laws[h].p / own, laws[h].p * (shifts[creases.of_hinge[h]] - local_shift)};
}

}  // namespace

std::vector<TurnLaw> turn_laws(const Lattice& sheet) {
  std::vector<TurnLaw> laws = usual_turn_laws(sheet);
  if (sheet.squares() && !all_vertical(*sheet.squares())) add_shifts(*sheet.squares(), laws);
  return laws;
}

namespace {

class Trials {
 public:
  Trials(const Lattice& sheet, const ExactMotion& exact, double theta)
      : sheet_(sheet),
        linkage_(sheet),
        exact_(exact),
        theta_(theta),
        rest_(rest_state(linkage_)),
        folded_(exact ? exact.at(theta) : State{}) {}

  std::vector<TrialDrive> all() {
    add("plates normal to y", [&] { return plates(Axis::y); });
    add("plates normal to x", [&] { return plates(Axis::x); });
    const auto [middle, rim] = extreme_hinges();
    add("hinge in the middle, wall " + wall_name(sheet_, middle), [&, h = middle] { return hinge(h); });
    add("hinge at the boundary, wall " + wall_name(sheet_, rim), [&, h = rim] { return hinge(h); });
    add("tendon along the middle row", [&] { return cord(Axis::y); });
    add("tendon along the middle column", [&] { return cord(Axis::x); });
    return std::move(trials_);
  }

 private:
  void add(std::string name, const std::function<LinkageDrive()>& make) {
    TrialDrive& trial = trials_.emplace_back();
    trial.name = std::move(name);
    try {
      trial.drive = make();
    } catch (const InvalidInput& e) {
      trial.why_not = e.reason();
    }
  }

  LinkageDrive plates(Axis axis) const {
    Plates drive{.axis = axis, .branch = theta_ < 0 ? -1 : 1};
    const LinkageDrive still = drive_on(sheet_, drive);
    drive.compression = 2 * std::pow(std::sin(theta_ / 2), 2);  // 1 - cos(theta) without its rounding
    if (exact_)
      drive.compression =
          1 - work_coordinate(still, linkage_, folded_) / work_coordinate(still, linkage_, rest_);
    if (!(drive.compression > 0)) throw InvalidInput("its rows go apart as the sheet folds");
    const LinkageDrive made = drive_on(sheet_, drive);
    if (exact_) exact_.theta_of(made);
    return made;
  }

  LinkageDrive hinge(int h) const {
    const int sense = linkage_.bodies[linkage_.hinges[h].lower].sense;
    const double angle = exact_ ? hinge_turn(linkage_, folded_, h) : turn_at_theta(sense, theta_);
    return drive_on(sheet_, HingeTurn{h, angle});
  }

  /// Returns the upright hinges nearest to and farthest from the middle of the sheet; of all hinges if none is
  /// upright.
  std::pair<int, int> extreme_hinges() const {
    std::vector<std::pair<double, int>> by_distance;
    for (const bool any : {false, true}) {
      for (int h = 0; h < static_cast<int>(linkage_.hinges.size()); ++h)
        if (any || is_vertical(linkage_.hinges[h]))
          by_distance.emplace_back((hinge_point(linkage_, h, rest_) - middle()).norm(), h);
      if (!by_distance.empty()) break;
    }
    const auto [near, far] = std::minmax_element(by_distance.begin(), by_distance.end());
    return {near->second, far->second};
  }

  Eigen::Vector3d middle() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Pose& pose : rest_) sum += pose.p;
    return sum / static_cast<double>(rest_.size());
  }

  /// Returns a tendon through the walls across the middle row (axis y) or column (axis x) of cells.
  LinkageDrive cord(Axis walls) const {
    const Structure* squares = sheet_.squares();
    if (!squares) throw InvalidInput("only a sheet of squares has rows and columns");
    std::vector<int> through = hinges_on_line(*squares, walls, line_count(*squares, walls) / 2);
    const int along = walls == Axis::y ? 0 : 1;
    std::sort(through.begin(), through.end(), [&](int a, int b) {
      return hinge_point(linkage_, a, rest_)[along] < hinge_point(linkage_, b, rest_)[along];
    });
    if (through.size() > 2 && through.size() % 2 == 0) through.pop_back();
    const double rest = cord_length(linkage_, through, rest_);
    const double now = exact_ ? cord_length(linkage_, through, folded_) : rest * std::cos(theta_);
    if (!(now < rest)) throw InvalidInput("it gets longer as the sheet folds to this side");
    const LinkageDrive made = cord_drive(linkage_, through, rest - now, theta_ < 0 ? -1 : 1);
    if (exact_ && exact_.theta_of(made) * theta_ < 0)
      throw InvalidInput("it folds the sheet to the other side");
    return made;
  }

  const Lattice& sheet_;
  const Linkage linkage_;
  const ExactMotion& exact_;
  const double theta_;
  const State rest_, folded_;
  std::vector<TrialDrive> trials_;
};

}  // namespace

std::vector<TrialDrive> trial_drives(const Lattice& sheet, const ExactMotion& exact, double theta) {
  require("theta", theta, theta != 0 && std::abs(theta) < pi / 2, "in (-pi/2, pi/2) rad, not 0");
  return Trials(sheet, exact, theta).all();
}

}  // namespace kinetix::model
