#include "app/print/format/sheet_drawing.hpp"

#include <boost/polygon/polygon.hpp>

namespace kinetix::app {
namespace {

constexpr double number_share = 0.12;  // of the cell edge: height of a hinge's number

namespace bp = boost::polygon;
using Eigen::Vector2d;
using Ring = std::vector<Vector2d>;
using Points = std::vector<bp::point_data<int>>;

constexpr double least_grid_mm = 1e-5;   // mm: exact for sheets that reach 10 m from the origin
constexpr double most_grid_steps = 1e9;  // half of what `int` holds, since unions take differences

/// Returns the convex hull of corners, counter-clockwise and exact (Andrew's monotone chain).
Points hull(Points points) {
  Points out;
  std::sort(points.begin(), points.end());
  const auto left = [](const auto& a, const auto& b, const auto& c) {
    const auto wide = [](int x) { return static_cast<long long>(x); };
    return (wide(b.x()) - a.x()) * (wide(c.y()) - a.y()) - (wide(b.y()) - a.y()) * (wide(c.x()) - a.x());
  };
  const auto add = [&](const auto& p, std::size_t first) {
    while (out.size() >= first + 2 && left(out[out.size() - 2], out.back(), p) <= 0) out.pop_back();
    out.push_back(p);
  };
  for (const auto& p : points) add(p, 0);
  const std::size_t lower = out.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  out.pop_back();
  return out;
}

template <class Polygon>
Ring ring_of(const Polygon& polygon, double grid_mm) {
  Ring ring;
  for (const auto& p : polygon) ring.push_back(grid_mm * Vector2d(p.x(), p.y()));
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

/// Returns outlines of what convex solids cover, seen from above, mm. @param solids corners of each, mm
std::vector<Ring> united(const std::vector<Ring>& solids) {
  using namespace bp::operators;
  double reach = 0;
  for (const Ring& corners : solids)
    for (const Vector2d& p : corners) reach = std::max(reach, p.lpNorm<Eigen::Infinity>());
  const double grid_mm = grid_step_mm(reach);
  bp::polygon_set_data<int> set;
  for (const Ring& corners : solids) {
    Points points;
    for (const Vector2d& p : corners)
      points.emplace_back(static_cast<int>(std::lround(p.x() / grid_mm)),
                          static_cast<int>(std::lround(p.y() / grid_mm)));
    const Points shadow = hull(std::move(points));
    bp::polygon_data<int> polygon;
    bp::set_points(polygon, shadow.begin(), shadow.end());
    set += polygon;
  }
  std::vector<bp::polygon_with_holes_data<int>> polygons;
  set.get(polygons);
  std::vector<Ring> rings;
  for (const auto& polygon : polygons) {
    rings.push_back(ring_of(polygon, grid_mm));
    for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
      rings.push_back(ring_of(*hole, grid_mm));
  }
  return rings;
}

void find_bounds(SheetDrawing& drawing) {
  Eigen::AlignedBox2d box;
  for (const auto* parts : {&drawing.bodies, &drawing.soft})
    for (const SheetDrawing::Part& part : *parts)
      for (const Ring& ring : part.rings)
        for (const Vector2d& p : ring) box.extend(p);
  drawing.low = box.min();
  drawing.high = box.max();
}

constexpr double knife_mm = 3;     // mm, between strips: room for a knife
constexpr double tab_share = 0.5;  // of the distance to the nearest hinge, or of the wall's height
constexpr double chamfer = 0.3;    // of a tab's length: narrower at its end, so that no two meet in a corner

// Heights of labels in shares of the wall's height, widths in shares of the room. In little room they stay readable.
constexpr double most_high = 0.3, least_high = 0.1, most_wide = 0.9;
// Shares of a wall's height: middle of the lower and of the upper labels, and how far up and down they reach.
constexpr double lower_row = 0.28, upper_row = 0.72, half_row = 0.18;

/// Wall in its own plane, mm: x from the lower vertex along the wall, y up from its foot.
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

/// Returns the hinge's line within the wall.
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

/// Room of a wall next to its score, below or above its middle. A label there is clear of lines.
struct Room {
  double from, to;  ///< along the wall, mm
  double row;       ///< of the wall's height
  bool is_occupied = false;
  double width() const { return to - from; }
};

/// Returns the rooms on the left below and above, then on the right below and above.
std::array<Room, 4> rooms_of(const Wall& wall, const std::pair<Vector2d, Vector2d>& line) {
  const auto score_at = [&](double share) {
    const auto& [low, high] = line;
    const double along = (share * wall.height - low.y()) / (high.y() - low.y());
    return low.x() + std::clamp(along, 0.0, 1.0) * (high.x() - low.x());
  };
  std::array<Room, 4> rooms;
  for (int k = 0; k < 2; ++k) {
    const double row = k == 0 ? lower_row : upper_row;
    const auto [left, right] = std::minmax({score_at(row - half_row), score_at(row + half_row)});
    rooms[k] = {0, left, row};
    rooms[2 + k] = {right, wall.length, row};
  }
  return rooms;
}

Room& widest(std::span<Room> rooms) {
  return *std::max_element(rooms.begin(), rooms.end(), [](const Room& a, const Room& b) {
    return std::pair(!a.is_occupied, a.width()) < std::pair(!b.is_occupied, b.width());
  });
}

/// Places a label in a room. @param at lower left corner of the wall, mm
Strips::Label label_in(Room& room, const Vector2d& at, double wall_height, const std::string& text) {
  room.is_occupied = true;
  const double fitting = most_wide * room.width() / (digit_share * static_cast<double>(text.size()));
  const double height = std::clamp(fitting, least_high * wall_height, most_high * wall_height);
  const Vector2d middle((room.from + room.to) / 2, room.row * wall_height);
  return {at + middle - Vector2d(0, capital_share * height / 2), text, height};
}

class StripMaker {
 public:
  explicit StripMaker(const PrintSheet& sheet) : sheet_(sheet) {
    for (int h = 0; h < hinges(); ++h) measure(h);
  }

  Strips made() {
    const double wide = longest_ + 2 * tab_ + knife_mm, high = highest_ + knife_mm;
    // Enough rows per column to make the page about square.
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
    cut.pop_back();  // the first point again
    out_.cuts.push_back(cut);
    const std::pair<Vector2d, Vector2d> line = score(wall);
    out_.folds.emplace_back(at + line.first, at + line.second);
    add_labels(h, at, wall, rooms_of(wall, line));
  }

  void add_labels(int h, const Vector2d& at, const Wall& wall, std::array<Room, 4> rooms) {
    const model::RestHinge& hinge = sheet_.linkage.hinges[h];
    const std::span<Room> all = rooms;
    for (const auto& [body, side] : {std::pair{hinge.lower, all.first(2)}, {hinge.upper, all.last(2)}})
      out_.vertices.push_back(label_in(widest(side), at, wall.height, sheet_.linkage.vertex_name(body)));
    out_.numbers.push_back(label_in(widest(all), at, wall.height, std::to_string(h + 1)));
  }

  /// Adds the edge from `from` up by `rise`, with a tab beyond it. @param tab mm, along x; 0: none
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

double grid_step_mm(double reach_mm) { return std::max(least_grid_mm, reach_mm / most_grid_steps); }

double number_height_mm(const PrintSheet& sheet) { return number_share * sheet.linkage.size.edge_mm; }

namespace {

model::Pose at_rest(const PrintSheet& sheet, int body) {
  return {Eigen::Matrix3d::Identity(), sheet.linkage.rest_position(body)};
}

/// Returns corners at a place as they are seen from above, mm.
Ring seen_from_above(const std::vector<Eigen::Vector3d>& corners, const model::Pose& place) {
  Ring seen;
  for (const Eigen::Vector3d& p : corners) seen.push_back((place.R * p + place.p).head<2>());
  return seen;
}

/// Returns the shadow of a body at a place.
SheetDrawing::Part body_part(const PrintSheet& sheet, int body, const model::Pose& place) {
  std::vector<Ring> solids;
  for (const model::ConvexPiece& piece : convex_pieces(sheet.bodies[body]))
    solids.push_back(seen_from_above(piece.corners, place));
  return {"body " + sheet.linkage.vertex_name(body), united(solids)};
}

}  // namespace

SheetDrawing sheet_drawing(const PrintSheet& sheet) {
  SheetDrawing drawing;
  for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b) {
    if (sheet.meshes[b].points.empty()) continue;
    drawing.bodies.push_back(body_part(sheet, b, at_rest(sheet, b)));
  }
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    const Eigen::Vector3d lower = sheet.linkage.rest_position(hinge.lower),
                          place = lower + sheet.linkage.size.edge_mm * hinge.lower_arm;
    if (!sheet.soft[h].points.empty())
      drawing.soft.push_back({"hinge " + sheet.linkage.wall_name(h),
                              united({seen_from_above(sheet.soft[h].points, at_rest(sheet, hinge.lower))})});
    const bool pin = is_pin(sheet.hinges[h].made.kind);
    drawing.hinges.push_back({h + 1, place.head<2>(), pin ? sheet.hinges[h].made.diameter_mm / 2 : 0});
  }
  find_bounds(drawing);
  return drawing;
}

SheetDrawing sheet_view(const PrintSheet& sheet, const model::State& state, const Eigen::Matrix3d& turn) {
  std::vector<std::pair<double, SheetDrawing::Part>> seen;
  const auto turned = [&](const model::Pose& pose) { return model::Pose{turn * pose.R, turn * pose.p}; };
  for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b) {
    if (sheet.meshes[b].points.empty()) continue;
    const model::Pose place = turned(state[b]);
    seen.push_back({place.p.z(), body_part(sheet, b, place)});
  }
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
    if (sheet.soft[h].points.empty()) continue;
    const std::vector<Eigen::Vector3d> points = placed_soft(sheet, state, h).points;
    const model::Pose whole{turn, Eigen::Vector3d::Zero()};
    const Eigen::Vector3d middle = std::accumulate(points.begin(), points.end(), whole.p) / points.size();
    seen.push_back({(turn * middle).z(),
                    {"hinge " + sheet.linkage.wall_name(h), united({seen_from_above(points, whole)})}});
  }
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  SheetDrawing view;
  for (auto& [depth, part] : seen) view.bodies.push_back(std::move(part));
  find_bounds(view);
  return view;
}

Strips strips(const PrintSheet& sheet) { return StripMaker(sheet).made(); }

}  // namespace kinetix::app
