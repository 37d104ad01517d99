#include "app/print/format/strips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinetix::app {
namespace {

using Eigen::Vector2d;

constexpr double knife_mm = 3;     // mm, between strips: room for a knife
constexpr double tab_share = 0.5;  // of the way to the nearest hinge, or of the wall's height
constexpr double chamfer = 0.3;    // of a tab's length: narrower at its end, so that no two meet in a corner

constexpr double label_share = 0.4;  // of a wall's height: labels stand about its middle

/// Of one wall, in its own plane: x from the lower vertex along the wall, y up from its foot. mm
struct Wall {
  double hinge_x, length, height;
  Vector2d axis;  ///< of the hinge, in the wall's plane
};

const model::ArmSolid& arm_at(const PrintSheet& sheet, int body, int hinge) {
  const auto& arms = sheet.bodies[body].arms;
  return *std::find_if(arms.begin(), arms.end(), [&](const auto& arm) { return arm.hinge == hinge; });
}

Wall wall_of(const PrintSheet& sheet, int h) {
  const model::RestHinge& hinge = sheet.linkage.hinges[h];
  const model::ArmSolid& arm = arm_at(sheet, hinge.lower, h);
  const double edge = sheet.linkage.size.edge_mm;
  const Eigen::Vector3d lower = edge * hinge.lower_arm, upper = edge * hinge.upper_arm;
  return {lower.dot(arm.edge),
          (lower - upper).dot(arm.edge),
          arm.size.height_mm,
          {hinge.axis.dot(arm.edge), hinge.axis.dot(arm.up)}};
}

/// The hinge's line as far as the wall reaches.
std::pair<Vector2d, Vector2d> score(const Wall& wall) {
  const Vector2d middle(wall.hinge_x, wall.height / 2), most(wall.length, wall.height);
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (int k = 0; k < 2; ++k) {
    if (wall.axis[k] == 0) continue;
    const auto [from, to] = std::minmax({-middle[k] / wall.axis[k], (most[k] - middle[k]) / wall.axis[k]});
    low = std::max(low, from);
    high = std::min(high, to);
  }
  return {middle + low * wall.axis, middle + high * wall.axis};
}

class StripMaker {
 public:
  explicit StripMaker(const PrintSheet& sheet) : sheet_(sheet) {
    for (int h = 0; h < hinges(); ++h) measure(h);
  }

  Strips made() {
    const double wide = longest_ + 2 * tab_ + knife_mm, high = highest_ + knife_mm;
    // As many in a column as make the page about square.
    const int rows = std::max(1, static_cast<int>(std::ceil(std::sqrt(hinges() * wide / high))));
    for (int h = 0; h < hinges(); ++h)
      add(h, {(h / rows) * wide + knife_mm + tab_, (h % rows) * high + knife_mm});
    out_.size = {std::ceil(static_cast<double>(hinges()) / rows) * wide + knife_mm, rows * high + knife_mm};
    return std::move(out_);
  }

 private:
  int hinges() const { return static_cast<int>(sheet_.hinges.size()); }

  void measure(int h) {
    const Wall wall = wall_of(sheet_, h);
    longest_ = std::max(longest_, wall.length);
    highest_ = std::max(highest_, wall.height);
    tab_ = std::min(
        {tab_, tab_share * wall.hinge_x, tab_share * (wall.length - wall.hinge_x), tab_share * wall.height});
  }

  bool meets_others(int body) const { return sheet_.bodies[body].arms.size() > 1; }

  void add(int h, const Vector2d& at) {
    const Wall wall = wall_of(sheet_, h);
    const model::RestHinge& hinge = sheet_.linkage.hinges[h];
    const bool first = meets_others(hinge.lower), last = meets_others(hinge.upper);
    std::vector<Vector2d> cut{at};
    add_end(cut, at + Vector2d(wall.length, 0), wall.height, last ? tab_ : 0);
    add_end(cut, at + Vector2d(0, wall.height), -wall.height, first ? -tab_ : 0);
    cut.pop_back();  // where it began
    out_.cuts.push_back(cut);
    const auto [low, high] = score(wall);
    out_.folds.emplace_back(at + low, at + high);
    out_.numbers.push_back({at + low + label_share * (high - low), std::to_string(h + 1)});
    for (const auto& [body, x] : {std::pair{hinge.lower, 0.0}, {hinge.upper, wall.length}})
      out_.vertices.push_back(
          {at + Vector2d(x, label_share * wall.height), sheet_.linkage.vertex_name(body)});
  }

  /// The edge from `from` up by `rise`, with a tab beyond it. @param tab mm, along x; 0: none
  void add_end(std::vector<Vector2d>& cut, const Vector2d& from, double rise, double tab) {
    const Vector2d to = from + Vector2d(0, rise);
    cut.push_back(from);
    if (tab != 0) {
      const double narrow = std::copysign(chamfer * std::abs(tab), rise);
      cut.push_back(from + Vector2d(tab, narrow));
      cut.push_back(to + Vector2d(tab, -narrow));
      out_.folds.emplace_back(from, to);
    }
    cut.push_back(to);
  }

  const PrintSheet& sheet_;
  double longest_ = 0, highest_ = 0, tab_ = std::numeric_limits<double>::infinity();
  Strips out_;
};

}  // namespace

Strips strips(const PrintSheet& sheet) { return StripMaker(sheet).made(); }

}  // namespace kinetix::app
