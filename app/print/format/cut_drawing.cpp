#include "app/print/format/cut_drawing.hpp"

#include <boost/polygon/polygon.hpp>
#include <map>

#include "app/print/format/sheet_drawing.hpp"
#include "targets/drawing/cut_sheet.hpp"

namespace kinetix::app {
namespace {

namespace bp = boost::polygon;
using Eigen::Vector2d;
using CutRing = std::vector<Vector2d>;
using Area = bp::polygon_set_data<int>;

constexpr int closed_steps = 2;         // of the grid: ends of walls and bridges may be one step apart
constexpr double straight_steps = 5;    // of the grid: corners that leave a line by less are rounding
constexpr double engraved_share = 0.6;  // of a wall's thickness: height of numbers, so that they stay within
constexpr double engraved_room = 0.9;   // of a half wall's length, for a number
constexpr double least_engraved_mm = 0.8;  // mm: beams of 0.2 mm blur smaller digits
constexpr double stroke_width = 0.5;       // of a digit's height
constexpr double stroke_step = 0.75;       // of a digit's height, from one to the next

/// Strokes of a digit, a bit each: top, upper right, lower right, bottom, lower left, upper left, middle.
constexpr unsigned strokes_of[10] = {0x3f, 0x06, 0x5b, 0x4f, 0x66, 0x6d, 0x7d, 0x07, 0x7f, 0x6f};

/// Returns the ends of a stroke. Digits are 1 high.
std::pair<Vector2d, Vector2d> stroke(int k) {
  const double w = stroke_width;
  const Vector2d corners[] = {{0, 1}, {w, 1}, {w, 0.5}, {w, 0}, {0, 0}, {0, 0.5}};
  return k == 6 ? std::pair(corners[5], corners[2]) : std::pair(corners[k], corners[(k + 1) % 6]);
}

/// Returns the width of a text of digits and points over its height.
double engraved_width(const std::string& text) {
  return stroke_step * static_cast<double>(text.size() - 1) + stroke_width;
}

/// Engraves digits and points as single lines. @param middle of the text, mm   @param right unit vector
void engrave(const std::string& text, const Vector2d& middle, const Vector2d& right, double height,
             CutDrawing& drawing) {
  const Vector2d up(-right.y(), right.x());
  double x = -engraved_width(text) / 2;
  const auto add = [&](const Vector2d& from, const Vector2d& to) {
    const auto at = [&](const Vector2d& p) {
      return Vector2d(middle + height * ((x + p.x()) * right + (p.y() - 0.5) * up));
    };
    drawing.scores.push_back({at(from), at(to)});
  };
  for (const char c : text) {
    if (c == '.') add({stroke_width / 2, 0}, {stroke_width / 2, 0.1});
    for (int k = 0; k < 7 && c != '.'; ++k)
      if (strokes_of[c - '0'] >> k & 1) add(stroke(k).first, stroke(k).second);
    x += stroke_step;
  }
}

bp::polygon_data<int> polygon_of(const CutRing& ring, double grid_mm) {
  std::vector<bp::point_data<int>> points;
  for (const Vector2d& p : ring)
    points.emplace_back(static_cast<int>(std::lround(p.x() / grid_mm)),
                        static_cast<int>(std::lround(p.y() / grid_mm)));
  bp::polygon_data<int> polygon;
  bp::set_points(polygon, points.begin(), points.end());
  return polygon;
}

CutRing ring_on_grid(const auto& polygon, double grid_mm) {
  CutRing ring;
  for (const auto& p : polygon) ring.push_back(grid_mm * Vector2d(p.x(), p.y()));
  return ring;
}

std::vector<CutRing> cut_rings(const Area& area, double grid_mm) {
  std::vector<bp::polygon_with_holes_data<int>> polygons;
  area.get(polygons);
  std::vector<CutRing> rings;
  for (const auto& polygon : polygons) {
    rings.push_back(ring_on_grid(polygon, grid_mm));
    for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
      rings.push_back(ring_on_grid(*hole, grid_mm));
  }
  return rings;
}

/// Returns a ring without corners that rounding leaves on straight lines.
CutRing without_steps(const CutRing& ring, double grid_mm) {
  const double straight_mm = straight_steps * grid_mm;
  CutRing apart, out;
  for (const Vector2d& p : ring)
    if (apart.empty() || (p - apart.back()).norm() > straight_mm) apart.push_back(p);
  if ((apart.front() - apart.back()).norm() <= straight_mm) apart.pop_back();
  const std::size_t count = apart.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2d &before = out.empty() ? apart[count - 1] : out.back(), &after = apart[(k + 1) % count];
    const Vector2d along = (after - before).normalized();
    if (std::abs(model::cross(along, apart[k] - before)) > straight_mm) out.push_back(apart[k]);
  }
  return out;
}

bool is_hole(const CutRing& ring) { return signed_area(ring) < 0; }

/// Returns bodies and bridges of a flat sheet together, in outlines whose corners are far apart: offsets of steps of
/// one grid unit would be turned inside out.
Area whole_area(const SheetDrawing& sheet, double grid_mm) {
  Area parts, whole;
  for (const auto* list : {&sheet.bodies, &sheet.soft})
    for (const SheetDrawing::Part& part : *list)
      for (const CutRing& ring : part.rings) parts.insert(polygon_of(ring, grid_mm));
  parts.resize(closed_steps);
  for (const CutRing& ring : cut_rings(parts, grid_mm))
    whole.insert(polygon_of(without_steps(ring, grid_mm), grid_mm), is_hole(ring));
  return whole;
}

const model::ArmSolid& cut_arm(const PrintSheet& sheet, int body, int hinge) {
  const auto& arms = sheet.bodies[body].arms;
  return *std::find_if(arms.begin(), arms.end(), [&](const auto& arm) { return arm.hinge == hinge; });
}

/// Engraves the number of a hinge on the longer of its half walls.
void engrave_number(const PrintSheet& sheet, int h, CutDrawing& drawing) {
  const std::string text = sheet.marks.empty() ? std::to_string(h + 1) : sheet.marks[h];
  const model::RestHinge& hinge = sheet.linkage.hinges[h];
  double room = 0;
  Vector2d middle, right;
  for (const int body : {hinge.lower, hinge.upper}) {
    const model::ArmSolid& arm = cut_arm(sheet, body, h);
    const double from = arm.start, to = arm.edge.dot(arm.point({-arm.end.wall_end, 0}, 0));
    if (to - from <= room) continue;
    room = to - from;
    right = arm.edge.head<2>();
    middle = sheet.linkage.rest_position(body).head<2>() + (from + to) / 2 * right;
  }
  const double height =
      std::min(engraved_share * sheet.linkage.size.thickness_mm, engraved_room * room / engraved_width(text));
  if (height < least_engraved_mm) return;
  const bool is_upside_down = right.x() < -1e-9 || (right.x() < 1e-9 && right.y() < 0);
  engrave(text, middle, is_upside_down ? Vector2d(-right) : right, height, drawing);
}

/// Lines as a graph of their ends, from which ways are taken one after the other.
class LineChains {
 public:
  explicit LineChains(const std::vector<targets::DrawnLine>& lines) : lines_(lines), is_done_(lines.size()) {
    for (std::size_t k = 0; k < lines.size(); ++k)
      for (const Vector2d& end : {lines[k].from, lines[k].to}) at_[key(end)].push_back(k);
  }

  /// Returns the longest way through ends of two lines that holds a line; empty if it was taken before.
  CutRing take(std::size_t first) {
    if (is_done_[first]) return {};
    is_done_[first] = true;
    CutRing back{lines_[first].from}, way{lines_[first].from, lines_[first].to};
    extend(way);
    if (way.front() == way.back()) return way;
    extend(back);
    std::reverse(back.begin(), back.end());
    back.insert(back.end(), way.begin() + 1, way.end());
    return back;
  }

 private:
  static std::pair<double, double> key(const Vector2d& p) { return {p.x(), p.y()}; }

  void extend(CutRing& way) {
    for (;;) {
      const std::vector<std::size_t>& lines = at_[key(way.back())];
      const auto next = std::find_if(lines.begin(), lines.end(), [&](std::size_t k) { return !is_done_[k]; });
      if (lines.size() != 2 || next == lines.end()) return;
      is_done_[*next] = true;
      way.push_back(lines_[*next].from == way.back() ? lines_[*next].to : lines_[*next].from);
    }
  }

  const std::vector<targets::DrawnLine>& lines_;
  std::vector<bool> is_done_;
  std::map<std::pair<double, double>, std::vector<std::size_t>> at_;
};

CutDrawing drawing_of_cuts(const targets::CutSheet& sheet) {
  CutDrawing drawing;
  Eigen::AlignedBox2d box;
  const bool has_green = targets::has_green_cuts(sheet.lines);
  std::vector<targets::DrawnLine> cuts;
  for (const targets::DrawnLine& line : sheet.lines) {
    box.extend(line.from).extend(line.to);
    if (is_crease(line, has_green))
      drawing.scores.push_back({line.from, line.to});
    else
      cuts.push_back(line);
  }
  LineChains chains(cuts);
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    CutRing way = chains.take(k);
    if (way.empty()) continue;
    const bool is_closed = way.size() > 3 && way.front() == way.back();
    if (is_closed) way.pop_back();
    (is_closed ? drawing.cuts : drawing.slits).push_back(std::move(way));
  }
  drawing.pieces = 1 + sheet.loose;
  drawing.low = box.min();
  drawing.high = box.max();
  return drawing;
}

}  // namespace

double CutDrawing::length_mm() const {
  double sum = 0;
  for (const CutRing& slit : slits)
    for (std::size_t k = 1; k < slit.size(); ++k) sum += (slit[k] - slit[k - 1]).norm();
  for (const CutRing& ring : cuts)
    for (std::size_t k = 0; k < ring.size(); ++k) sum += (ring[(k + 1) % ring.size()] - ring[k]).norm();
  return sum;
}

CutDrawing cut_drawing(const PrintSheet& sheet) {
  if (sheet.cuts) return drawing_of_cuts(*sheet.cuts);
  const SheetDrawing parts = sheet_drawing(sheet);
  const double reach = std::max(parts.low.lpNorm<Eigen::Infinity>(), parts.high.lpNorm<Eigen::Infinity>());
  const double grid_mm = grid_step_mm(reach + sheet.process.kerf_mm);
  Area area = whole_area(parts, grid_mm);
  const int half_kerf = static_cast<int>(std::lround(sheet.process.kerf_mm / 2 / grid_mm));
  if (half_kerf > closed_steps) area.resize(half_kerf - closed_steps);
  CutDrawing drawing;
  std::vector<CutRing> outlines;
  Eigen::AlignedBox2d box;
  for (const CutRing& rounded : cut_rings(area, grid_mm)) {
    CutRing ring = without_steps(rounded, grid_mm);
    for (const Vector2d& p : ring) box.extend(p);
    (is_hole(ring) ? drawing.cuts : outlines).push_back(std::move(ring));
  }
  drawing.pieces = static_cast<int>(outlines.size());
  std::move(outlines.begin(), outlines.end(), std::back_inserter(drawing.cuts));
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) engrave_number(sheet, h, drawing);
  drawing.low = box.min();
  drawing.high = box.max();
  return drawing;
}

}  // namespace kinetix::app
