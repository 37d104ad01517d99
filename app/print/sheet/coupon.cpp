#include "app/print/sheet/coupon.hpp"

#include <fmt/format.h>
#include <numeric>

#include "app/print/sheet/fold_motion.hpp"

namespace kinetix::app {
namespace {

constexpr int gaps = 6;              // of 0.1, 0.2, ... 0.6 mm: around the 0.25 and 0.3 of SLA and FDM
constexpr double gap_step_mm = 0.1;  // mm: typical difference between printers
constexpr double tilts_deg[] = {0, 30, 60};  // degrees from upright: layers step sideways by their tangent
constexpr double edge_mm = 26;               // mm, of a wall with room for the largest knuckle and its number
constexpr double flat = 1e-9;                // of a unit vector: less is rounding
constexpr double wall_mm = 0.8;              // mm: as in the shipped targets
constexpr double height_mm = 8;              // mm: room for three knuckles
constexpr double column_mm = 32, row_mm = 20;  // mm, from one hinge to the next: walls stay apart

/// Adds a wall of two bodies. @param from of its lower body, mm   @param beta rad   @return its index
int add_wall(const Eigen::Vector3d& from, double beta, model::Linkage& linkage) {
  const Eigen::Vector3d at = from / edge_mm;
  model::HingedWall wall;
  wall.lower = static_cast<int>(linkage.bodies.size());
  wall.upper = wall.lower + 1;
  wall.edge = Eigen::Vector3d::UnitX();
  wall.hinge.beta = beta;
  linkage.bodies.push_back({at, 1});
  linkage.bodies.push_back({at + wall.edge, -1});
  for (const model::Plate& plate : plates(wall, static_cast<int>(linkage.hinges.size())))
    linkage.plates.push_back(plate);
  linkage.hinges.push_back(rest_hinge(wall));
  return static_cast<int>(linkage.hinges.size()) - 1;
}

/// Makes the solids of a coupon whose hinges are known.
void finish_coupon(PrintSheet& sheet) {
  sheet.path = {rest_state(sheet.linkage)};
  sheet.thetas = {0};
  sheet.no_path_reason = "a coupon's hinges each turn by themselves";
  make_solids(sheet);
}

/// Adds a hinge. @param column index of its gap   @param row index of its tilt
void add_hinge(int column, int row, const model::Process& process, PrintSheet& sheet) {
  add_wall({column * column_mm, row * row_mm, 0}, tilts_deg[row] * radians_per_degree, sheet.linkage);
  model::ManufacturedHinge pin;
  pin.kind = model::HingeKind::pin;
  pin.material = *model::find_material("pa12");
  pin.diameter_mm = process.min_pin_mm;
  pin.clearance_mm = gap_step_mm * (column + 1);
  pin.height_mm = height_mm;
  sheet.hinges.push_back(with_faces({.made = pin, .knuckle_wall_mm = process.min_wall_mm}, process));
}

std::string coupon_hinge_name(int hinge) {
  const int row = hinge % static_cast<int>(std::size(tilts_deg)),
            column = hinge / static_cast<int>(std::size(tilts_deg));
  return fmt::format("{:.1f} mm, {:g} degrees", gap_step_mm * (column + 1), tilts_deg[row]);
}

/// Raises the gap's number on the side of the fork's wall that looks up, or to the front.
void add_number(int hinge, PrintSheet& sheet) {
  const int body = sheet.linkage.hinges[hinge].lower;
  const model::ArmSolid& arm = sheet.bodies[body].arms.front();
  const double from = arm.start, to = arm.edge.dot(arm.point({-arm.end.wall_end, 0}, 0));
  const double side = arm.normal.z() > flat || (arm.normal.z() > -flat && arm.normal.y() < 0) ? 1 : -1;
  const Eigen::Vector3d outwards = side * arm.normal;
  const TextFace face{(from + to) / 2 * arm.edge + arm.size.thickness_mm / 2 * outwards,
                      arm.up.cross(outwards), arm.up};
  raise_text(fmt::format("{:.1f}", sheet.hinges[hinge].made.clearance_mm), face, sheet.meshes[body]);
}

/// Cuts the coupon into tiles. Both bodies of a hinge are on one tile.
Tiles coupon_tiles(const PrintSheet& sheet, const Eigen::Vector2d& bed_mm) {
  std::vector<Eigen::AlignedBox2d> pairs(sheet.hinges.size());
  const int bodies = static_cast<int>(sheet.meshes.size());
  for (int b = 0; b < bodies; ++b)
    for (const Eigen::Vector3d& p : placed_body(sheet, sheet.path.front(), b).points)
      pairs[b / 2].extend(p.head<2>());
  Tiles tiles = cut_into_tiles(pairs, bed_mm);
  const std::vector<int> of_pair = std::move(tiles.of_body);
  tiles.of_body.clear();
  for (int b = 0; b < bodies; ++b) tiles.of_body.push_back(of_pair[b / 2]);
  return tiles;
}

using Eigen::Vector2d;
using Eigen::Vector3d;
using model::Polyhedron;

constexpr int rows = 5;              // squares, of a letter's height: as the figures below are drawn
constexpr double flat_mm = 1e-7;     // mm: corners of one face differ by rounding only
constexpr double start_angle = 0.1;  // rad: start of merging two outlines; no edge of upright text has it

/// Digits of seven strokes on 3 x 5 squares, from the top. No two squares touch only at a corner.
constexpr const char* digits[10] = {
    "111101101101111", "001001001001001", "111001111100111", "111001111001111", "101101111001001",
    "111100111001111", "111100111101111", "111001001001001", "111101111101111", "111101111001111"};

/// Returns the squares of a text, [row from below][column].
std::vector<std::vector<bool>> squares_of(std::string_view text) {
  std::vector<std::vector<bool>> out(rows);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool point = text[k] == '.';
    if (!point && (text[k] < '0' || text[k] > '9'))
      throw std::invalid_argument("text of digits and points alone");
    const char* shape = point ? "00001" : digits[text[k] - '0'];
    const int width = point ? 1 : 3;
    for (int row = 0; row < rows; ++row) {
      if (k > 0) out[row].push_back(false);
      for (int column = 0; column < width; ++column)
        out[row].push_back(shape[(rows - 1 - row) * width + column] == '1');
    }
  }
  if (text.empty()) throw std::invalid_argument("no text to raise");
  return out;
}

class Raised {
 public:
  Raised(std::string_view text, const TextFace& face, Polyhedron& solid)
      : face_(face),
        squares_(squares_of(text)),
        columns_(static_cast<int>(squares_[0].size())),
        solid_(solid) {}

  void raise() {
    const std::vector<int> outer = take_out_face();
    std::vector<int> inner = rim();
    check_room(outer, inner);
    fill_between(outer, inner);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns_; ++column) add_square(column, row);
  }

 private:
  Vector3d outwards() const { return face_.right.cross(face_.up); }

  Vector2d flat(int point) const {
    const Vector3d d = solid_.points[point] - face_.middle;
    return {d.dot(face_.right), d.dot(face_.up)};
  }

  bool is_on_face(int point) const {
    return std::abs((solid_.points[point] - face_.middle).dot(outwards())) < flat_mm;
  }

  /// Removes the triangles of the face. @return its outline, counter-clockwise
  std::vector<int> take_out_face() {
    std::map<std::pair<int, int>, int> edges;
    const auto on_face = [&](const std::array<int, 3>& t) {
      return is_on_face(t[0]) && is_on_face(t[1]) && is_on_face(t[2]);
    };
    for (const auto& t : solid_.triangles)
      if (on_face(t))
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    solid_.triangles.erase(std::remove_if(solid_.triangles.begin(), solid_.triangles.end(), on_face),
                           solid_.triangles.end());
    std::map<int, int> next;
    for (const auto& [edge, count] : edges)
      if (!edges.count({edge.second, edge.first})) next[edge.first] = edge.second;
    if (next.empty()) throw std::invalid_argument("no face to raise text from");
    std::vector<int> loop{next.begin()->first};
    while (loop.size() < next.size()) loop.push_back(next.at(loop.back()));
    if (next.at(loop.back()) != loop.front()) throw std::invalid_argument("the face for a text is not one");
    return loop;
  }

  /// Returns a corner of the grid of squares, on the face or raised. It is made once.
  int corner(int column, int row, bool raised) {
    const auto [at, is_new] = corners_.try_emplace({column, row, raised ? 1 : 0}, 0);
    if (!is_new) return at->second;
    const double x = (column - columns_ / 2.0) * face_.pixel_mm, y = (row - rows / 2.0) * face_.pixel_mm;
    return at->second = solid_.add_point(face_.middle + x * face_.right + y * face_.up +
                                         (raised ? face_.raised_mm : 0) * outwards());
  }

  /// Returns the outline of all squares together, counter-clockwise.
  std::vector<int> rim() {
    std::vector<int> out;
    for (int c = 0; c < columns_; ++c) out.push_back(corner(c, 0, false));
    for (int r = 0; r < rows; ++r) out.push_back(corner(columns_, r, false));
    for (int c = columns_; c > 0; --c) out.push_back(corner(c, rows, false));
    for (int r = rows; r > 0; --r) out.push_back(corner(0, r, false));
    return out;
  }

  void check_room(const std::vector<int>& outer, const std::vector<int>& inner) const {
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const Vector2d from = flat(outer[k]), along = flat(outer[(k + 1) % outer.size()]) - from;
      for (const int p : inner) {
        const Vector2d d = flat(p) - from;
        if (!(along.x() * d.y() - along.y() * d.x() > flat_mm))
          throw std::invalid_argument("the face is smaller than its text");
      }
    }
  }

  /// Returns the direction of an outline's edge, rad from start_angle on, [0, 2 pi).
  double direction(const std::vector<int>& loop, std::size_t k) const {
    const Vector2d d = flat(loop[(k + 1) % loop.size()]) - flat(loop[k % loop.size()]);
    const double angle = std::atan2(d.y(), d.x()) - start_angle;
    return angle < 0 ? angle + 2 * pi : angle;
  }

  /// Returns an outline that starts with its edge of least direction.
  std::vector<int> started(std::vector<int> loop) const {
    std::size_t first = 0;
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (direction(loop, k) + pi < direction(loop, k + loop.size() - 1)) first = k;  // where they wrap
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
    return loop;
  }

  /// Fills the area between two convex outlines, one inside the other. Edges of both are taken by their directions,
  /// like the sides of the convex hull of the two in parallel planes.
  void fill_between(const std::vector<int>& around, const std::vector<int>& within) {
    const std::vector<int> outer = started(around), inner = started(within);
    std::size_t o = 0, i = 0;
    while (o < outer.size() || i < inner.size()) {
      const int at_outer = outer[o % outer.size()], at_inner = inner[i % inner.size()];
      const bool takes_outer =
          i == inner.size() || (o < outer.size() && direction(outer, o) <= direction(inner, i));
      if (takes_outer)
        solid_.triangles.push_back({at_outer, outer[++o % outer.size()], at_inner});
      else
        solid_.triangles.push_back({at_inner, at_outer, inner[++i % inner.size()]});
    }
  }

  bool is_raised(int column, int row) const {
    return column >= 0 && column < columns_ && row >= 0 && row < rows && squares_[row][column];
  }

  void add_square(int c, int r) {
    const bool up = is_raised(c, r);
    solid_.add_face({corner(c, r, up), corner(c + 1, r, up), corner(c + 1, r + 1, up), corner(c, r + 1, up)});
    if (!up) return;
    add_side(c, r, c + 1, r, is_raised(c, r - 1));
    add_side(c + 1, r, c + 1, r + 1, is_raised(c + 1, r));
    add_side(c + 1, r + 1, c, r + 1, is_raised(c, r + 1));
    add_side(c, r + 1, c, r, is_raised(c - 1, r));
  }

  void add_side(int c, int r, int next_c, int next_r, bool goes_on) {
    if (goes_on) return;
    solid_.add_face({corner(c, r, false), corner(next_c, next_r, false), corner(next_c, next_r, true),
                     corner(c, r, true)});
  }

  const TextFace& face_;
  const std::vector<std::vector<bool>> squares_;
  const int columns_;
  Polyhedron& solid_;
  std::map<std::array<int, 3>, int> corners_;
};

constexpr int bridges = 7;              // of 0.4, 0.6, ... 1.6 mm: around the 0.5 mm of laser
constexpr double thinnest_mm = 0.4;     // mm: thinner than the 0.5 mm of laser
constexpr double bridge_step_mm = 0.2;  // mm: typical difference between cutters
constexpr double bridge_mm = 6;         // mm, from tab to tab: their corners meet beyond a right angle
constexpr double tab_mm = 6;            // mm, width of a tab: room for its number
constexpr double tabs_apart_mm = 10;    // mm, from one bridge to the next: pieces stay apart

double bridge_width_mm(int bridge) { return thinnest_mm + bridge_step_mm * bridge; }

std::string bridge_name(int bridge) { return fmt::format("{:.1f}", bridge_width_mm(bridge)); }

void add_bridge(int bridge, PrintSheet& sheet) {
  const int wall = add_wall({0, bridge * tabs_apart_mm, 0}, 0, sheet.linkage);
  model::ManufacturedHinge film;
  film.kind = model::HingeKind::film;
  film.material = *model::find_material(sheet.process.film);
  film.gap_mm = bridge_mm;
  film.thickness_mm = bridge_width_mm(bridge);
  film.height_mm = sheet.process.sheet_mm;
  sheet.hinges.push_back({.made = film});
  sheet.marks.push_back(bridge_name(wall));
}

/// Makes the coupon of a process that cuts sheets.
PrintSheet bridge_coupon(const model::Process& process, const std::optional<Eigen::Vector2d>& bed_mm) {
  PrintSheet sheet;
  sheet.name = "coupon";
  sheet.process = process;
  sheet.linkage.size = {edge_mm, tab_mm, process.sheet_mm};
  std::string turns;
  for (int bridge = 0; bridge < bridges; ++bridge) {
    add_bridge(bridge, sheet);
    turns +=
        fmt::format("{}{:.0f}", bridge == 0 ? "" : ", ", to_degrees(largest_turn(sheet.hinges.back().made)));
  }
  sheet.linkage.wall_name = [](int hinge) { return bridge_name(hinge) + " mm"; };
  sheet.linkage.vertex_name = [](int body) {
    return bridge_name(body / 2) + (body % 2 == 0 ? " mm, left" : " mm, right");
  };
  sheet.warnings = {fmt::format(
      "bridges 0.4 to 1.6 mm wide and {:g} mm long, with their widths on the tabs. Bend each by hand. The "
      "strain limit of {} allows {} degrees. The narrowest bridge that stays whole is the limit of your "
      "cutter: `process: {{base: {}, min_film_mm: ...}}`. Tabs are {:g} mm wide if `kerf_mm` is right",
      bridge_mm, process.film, turns, process.name, tab_mm)};
  finish_coupon(sheet);
  if (bed_mm) sheet.tiles = coupon_tiles(sheet, *bed_mm);
  if (sheet.tiles.count() > 1)
    throw BedTooSmall(fmt::format("the coupon is one drawing, and a bed of {:g} x {:g} mm does not hold it",
                                  bed_mm->x(), bed_mm->y()));
  return sheet;
}

}  // namespace

PrintSheet make_coupon(const model::Process& process, const std::optional<Eigen::Vector2d>& bed_mm) {
  if (process.cuts_sheets()) return bridge_coupon(process, bed_mm);
  PrintSheet sheet;
  sheet.name = "coupon";
  sheet.process = process;
  sheet.linkage.size = {edge_mm, std::max(wall_mm, process.min_wall_mm), height_mm};
  for (int column = 0; column < gaps; ++column)
    for (int row = 0; row < static_cast<int>(std::size(tilts_deg)); ++row)
      add_hinge(column, row, process, sheet);
  sheet.linkage.wall_name = coupon_hinge_name;
  sheet.linkage.vertex_name = [](int body) {
    return coupon_hinge_name(body / 2) + (body % 2 == 0 ? ", fork" : ", eye");
  };
  sheet.warnings = {
      "gaps from 0.1 to 0.6 mm per side, from left to right, with their widths next to them. Rows are tilted "
      "by 0, 30 and 60 degrees. Use the smallest gap that turns for --clearance"};
  finish_coupon(sheet);
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) add_number(h, sheet);
  if (bed_mm) sheet.tiles = coupon_tiles(sheet, *bed_mm);
  return sheet;
}

void raise_text(std::string_view text, const TextFace& face, Polyhedron& solid) {
  Polyhedron out = solid;
  Raised(text, face, out).raise();
  solid = std::move(out);
}

int raised_squares(std::string_view text) {
  const auto squares = squares_of(text);
  return std::accumulate(squares.begin(), squares.end(), 0, [](int sum, const std::vector<bool>& row) {
    return sum + static_cast<int>(std::count(row.begin(), row.end(), true));
  });
}

}  // namespace kinetix::app
