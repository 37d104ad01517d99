#include "model/lattice/trial_drives.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/lines.hpp"
#include "model/linkage/actuators.hpp"

namespace kinetix::model {
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
    add("hinge at the rim, wall " + wall_name(sheet_, rim), [&, h = rim] { return hinge(h); });
    add("cord along the middle row", [&] { return cord(Axis::y); });
    add("cord along the middle column", [&] { return cord(Axis::x); });
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
    if (exact_) drive.compression = 1 - way_of(still, linkage_, folded_) / way_of(still, linkage_, rest_);
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
    return cord_drive(linkage_, through, rest - now, theta_ < 0 ? -1 : 1);
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
