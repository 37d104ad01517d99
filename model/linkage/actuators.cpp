#include "model/linkage/actuators.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

bool have_common_body(const RestHinge& a, const RestHinge& b) {
  return a.lower == b.lower || a.lower == b.upper || a.upper == b.lower || a.upper == b.upper;
}

bool can_shorten(const Linkage& linkage, const std::vector<int>& through) {
  for (std::size_t k = 1; k < through.size(); ++k)
    if (!have_common_body(linkage.hinges[through[k - 1]], linkage.hinges[through[k]])) return true;
  return false;
}

[[noreturn]] void refuse_cord(const std::string& why) {
  throw InvalidInput(why, {"", 0, 0, "drive.through"});
}

void check_cord(const Linkage& linkage, const std::vector<int>& through) {
  if (through.size() < 2) refuse_cord("a cord runs through the hinges of at least two walls");
  for (std::size_t k = 1; k < through.size(); ++k)
    if (through[k] == through[k - 1])
      refuse_cord("wall " + linkage.wall_name(through[k]) + " is named twice in a row");
  if (!can_shorten(linkage, through))
    refuse_cord(
        "each two neighbouring walls share a vertex, whose rigid body carries both hinge points: no drive "
        "shortens this "
        "cord; name walls that face each other, e.g. [[[0, 0], [0, 1]], [[1, 0], [1, 1]], ...], or every "
        "other one");
}

}  // namespace

Eigen::Vector3d hinge_point(const Linkage& linkage, int hinge, const State& state) {
  const RestHinge& h = linkage.hinges[hinge];
  const Pose &lower = state[h.lower], &upper = state[h.upper];
  return (lower.p + upper.p + linkage.size.edge_mm * (lower.R * h.lower_arm + upper.R * h.upper_arm)) / 2;
}

double cord_length(const Linkage& linkage, const std::vector<int>& through, const State& state) {
  double sum = 0;
  for (std::size_t k = 1; k < through.size(); ++k)
    sum += (hinge_point(linkage, through[k], state) - hinge_point(linkage, through[k - 1], state)).norm();
  return sum;
}

LinkageDrive cord_drive(const Linkage& linkage, const std::vector<int>& through, double shorten_mm,
                        int branch) {
  check_cord(linkage, through);
  require("drive.branch", branch, branch == 1 || branch == -1, "1 or -1");
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::cord;
  drive.through = through;
  drive.branch = branch;
  drive.rest_mm = cord_length(linkage, through, rest_state(linkage));
  drive.shorten_mm = shorten_mm;
  if (shorten_mm >= 0 && shorten_mm < drive.rest_mm) return drive;
  throw InvalidInput(number_text(shorten_mm) +
                         " is out of range; allowed: a number from 0 and below the cord's length, " +
                         number_text(drive.rest_mm) + " mm",
                     {"", 0, 0, "drive.shorten_mm"});
}

LinkageDrive shape_memory_drive(const Linkage& linkage, std::vector<int> hinges, double k_turn,
                                double angle) {
  require("drive.k_turn", k_turn, k_turn >= 1e-30 && k_turn <= 1e30, "positive, from 1e-30 to 1e30 N mm/rad");
  require("drive.angle", angle, std::abs(angle) < pi, "in (-pi, pi) rad");
  if (hinges.empty()) {
    hinges.resize(linkage.hinges.size());
    std::iota(hinges.begin(), hinges.end(), 0);
  }
  std::sort(hinges.begin(), hinges.end());
  if (const auto twice = std::adjacent_find(hinges.begin(), hinges.end()); twice != hinges.end())
    throw InvalidInput("wall " + linkage.wall_name(*twice) + " is named twice", {"", 0, 0, "drive.walls"});
  LinkageDrive drive;
  drive.kind = LinkageDrive::Kind::shape_memory;
  drive.springs = std::move(hinges);
  drive.k_spring = k_turn;
  drive.angle = angle;
  return drive;
}

}  // namespace kinetix::model
