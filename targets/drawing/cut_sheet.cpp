#include "targets/drawing/cut_sheet.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>
#include <limits>
#include <tuple>

#include "model/base/algorithms.hpp"
#include "model/base/geometry.hpp"
#include "targets/drawing/join_lines.hpp"

namespace kinetix::targets {
namespace {

namespace bp = boost::polygon;
using namespace bp::operators;
using Eigen::Vector2d;
using model::FlatRing;
using SheetArea = bp::polygon_set_data<int>;
using SheetPiece = std::vector<FlatRing>;

constexpr double sheet_grid_mm = 1e-5;       // mm: areas are exact on this grid
constexpr double largest_sheet_mm = 20'000;  // mm: as far as whole numbers of grid steps reach
constexpr double dust_kerfs = 4;             // squared kerfs: smaller areas between lines fall out as dust
constexpr double straight_share = 3;         // grid steps: corners that leave a line by less are rounding
constexpr double least_relieved = 0.5;       // share of a piece that its bridges leave
constexpr double main_share = 0.9;    // of width and height: other pieces fall out of one that is as large
constexpr int max_joint_rounds = 20;  // of leaving out bridges that separate nothing
// Steps of comparing places with the outline of the sheet, some seconds.
constexpr std::size_t max_rim_steps = 2'000'000'000;
constexpr std::size_t max_sheet_pieces = 20'000;  // as many bodies as a motion is computed for
constexpr int green = 0x00FF00, yellow = 0xFFFF00;

/// Returns a strip along a segment, longer than it by half its width at both ends.
FlatRing strip(const Vector2d& from, const Vector2d& to, double width) {
  const Vector2d along = width / 2 * (to - from).normalized(), across = model::turned_by_90(along);
  return {from - along - across, to + along - across, to + along + across, from - along + across};
}

/// Whether a point is inside of a piece (even-odd rule).
bool is_within(const SheetPiece& piece, const Vector2d& p) {
  bool is_in = false;
  for (const FlatRing& ring : piece)
    for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++) {
      const Vector2d &a = ring[before], &b = ring[k];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        is_in = !is_in;
    }
  return is_in;
}

/// Returns the area of a piece, whose holes are clockwise.
double piece_area(const SheetPiece& piece) {
  double area = 0;
  for (const FlatRing& ring : piece) area += signed_area(ring);
  return area;
}

double distance_to_rings(const SheetPiece& piece, const Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const FlatRing& ring : piece)
    for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++)
      least = std::min(least, model::distance_to_wall(p, ring[before], ring[k]));
  return least;
}

class SheetCutter {
 public:
  SheetCutter(std::vector<DrawnLine> lines, const CutSettings& settings)
      : lines_(std::move(lines)), settings_(settings), has_green_(has_green_cuts(lines_)) {
    if (has_green_) std::erase_if(lines_, [](const DrawnLine& line) { return line.colour == yellow; });
    if (lines_.empty()) throw InvalidInput("the drawing has no lines. Draw each cut as a line");
    for (const DrawnLine& line : lines_) box_.extend(line.from).extend(line.to);
    if (!(box_.sizes().maxCoeff() <= largest_sheet_mm))
      throw InvalidInput("the sheet is larger than 20 m. Check the unit of the drawing");
  }

  CutSheet run() {
    split();
    if (!is_outlined()) {
      out_.is_outlined = false;
      add_rectangle();
      split();
    }
    find_joint_segments();
    for (int round = 0; take_apart() && round < max_joint_rounds;) ++round;
    keep_largest_group();
    refuse_burnt_bridges();
    relieve_pieces();
    // The outline is cut last, since the sheet may shift then.
    std::stable_partition(out_.lines.begin(), out_.lines.end(),
                          [&](const DrawnLine& line) { return !is_on_rim((line.from + line.to) / 2); });
    return std::move(out_);
  }

 private:
  /// Bridge or crease, as a segment at which the sheet is taken apart.
  struct Segment {
    Vector2d from, to;
    bool is_crease = false;
  };

  bp::polygon_data<int> on_grid(const FlatRing& ring) const {
    std::vector<bp::point_data<int>> points;
    for (const Vector2d& corner : ring) {
      const Vector2d p = (corner - box_.center()) / sheet_grid_mm;
      points.emplace_back(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    }
    bp::polygon_data<int> polygon;
    bp::set_points(polygon, points.begin(), points.end());
    return polygon;
  }

  FlatRing from_grid(const auto& polygon) const {
    FlatRing apart, out;
    for (const auto& p : polygon) {
      const Vector2d corner = box_.center() + sheet_grid_mm * Vector2d(p.x(), p.y());
      if (apart.empty() || apart.back() != corner) apart.push_back(corner);
    }
    if (apart.size() > 1 && apart.front() == apart.back()) apart.pop_back();
    for (std::size_t k = 0; k < apart.size(); ++k) {
      const Vector2d &before = out.empty() ? apart.back() : out.back(),
                     &after = apart[(k + 1) % apart.size()];
      if (std::abs(model::cross((after - before).normalized(), apart[k] - before)) >
          straight_share * sheet_grid_mm)
        out.push_back(apart[k]);
    }
    return out;
  }

  std::vector<SheetPiece> pieces_of(const SheetArea& area, double least_area) const {
    std::vector<bp::polygon_with_holes_data<int>> polygons;
    area.get(polygons);
    std::vector<SheetPiece> out;
    for (const auto& polygon : polygons) {
      SheetPiece piece{from_grid(polygon)};
      if (piece.front().size() < 3 || signed_area(piece.front()) <= least_area) continue;
      for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
        if (FlatRing ring = from_grid(*hole); ring.size() > 2) piece.push_back(std::move(ring));
      out.push_back(std::move(piece));
    }
    return out;
  }

  /// Joins the lines, and separates cuts and creases.
  void split() {
    const JoinedLines joined = join_lines(lines_, settings_.join_mm);
    out_.join_mm = joined.join;
    out_.lines.clear();
    cuts_ = {joined.graph.vertices, {}};
    creases_.clear();
    for (std::size_t e = 0; e < joined.graph.edges.size(); ++e) {
      const auto [from, to] = joined.graph.edges[e];
      DrawnLine line = lines_[joined.line_of[e]];
      line.from = joined.graph.vertices[from];
      line.to = joined.graph.vertices[to];
      (is_crease(line, has_green_) ? creases_ : cuts_.edges).push_back({from, to});
      out_.lines.push_back(line);
    }
    whole_ = SheetArea();
    for (const model::GraphFace& face : bounded_faces(cuts_)) {
      FlatRing ring;
      for (const int v : face.vertices) ring.push_back(cuts_.vertices[v]);
      whole_.insert(on_grid(ring));
    }
    rims_ = pieces_of(whole_, 0);
    std::size_t corners = 0;
    for (const SheetPiece& rim : rims_)
      for (const FlatRing& ring : rim) corners += ring.size();
    if (corners * (cuts_.vertices.size() + cuts_.edges.size()) > max_rim_steps)
      throw InvalidInput("too many closed lines are side by side. Draw one outline around all cuts");
  }

  bool is_on_rim(const Vector2d& p) const {
    return std::any_of(rims_.begin(), rims_.end(),
                       [&](const SheetPiece& rim) { return distance_to_rings(rim, p) <= 2 * out_.join_mm; });
  }

  /// Whether all lines are within closed lines.
  bool is_outlined() const {
    std::vector<bool> is_used(cuts_.vertices.size(), false);
    for (const auto* edges : {&cuts_.edges, &creases_})
      for (const auto& [from, to] : *edges) is_used[from] = is_used[to] = true;
    for (std::size_t v = 0; v < cuts_.vertices.size(); ++v) {
      const Vector2d& p = cuts_.vertices[v];
      const auto holds = [&](const SheetPiece& rim) { return is_within(rim, p); };
      if (is_used[v] && std::none_of(rims_.begin(), rims_.end(), holds) && !is_on_rim(p)) return false;
    }
    return true;
  }

  void add_rectangle() {
    const Vector2d low = box_.min(), high = box_.max();
    const Vector2d corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    for (int k = 0; k < 4; ++k)
      lines_.push_back({.from = corners[k], .to = corners[(k + 1) % 4], .colour = has_green_ ? green : 0});
  }

  void find_joint_segments() {
    is_rim_.clear();
    for (const auto& [from, to] : cuts_.edges)
      is_rim_.push_back(is_on_rim((cuts_.vertices[from] + cuts_.vertices[to]) / 2));
    ends_in_crease_.assign(cuts_.vertices.size(), false);
    for (const auto& [from, to] : creases_) ends_in_crease_[from] = ends_in_crease_[to] = true;
    out_.bridge_mm = settings_.bridge_mm ? *settings_.bridge_mm : default_bridge(cuts_, is_rim_);
    for (const SheetBridge& bridge : bridges(out_.bridge_mm)) segments_.push_back({bridge.from, bridge.to});
    for (const auto& [from, to] : creases_)
      segments_.push_back({cuts_.vertices[from], cuts_.vertices[to], true});
  }

  std::vector<SheetBridge> bridges(double widest) const {
    return find_bridges(cuts_, widest, is_rim_, ends_in_crease_);
  }

  /// Takes the sheet apart at all segments. @return whether some of them separate nothing, and were left out
  bool take_apart() {
    const double kerf = settings_.kerf_mm;
    SheetArea slits;
    for (const auto& [from, to] : cuts_.edges)
      slits.insert(on_grid(strip(cuts_.vertices[from], cuts_.vertices[to], kerf)));
    for (const Segment& segment : segments_) slits.insert(on_grid(strip(segment.from, segment.to, kerf)));
    SheetArea area = whole_;
    area -= slits;
    out_.pieces = pieces_of(area, dust_kerfs * kerf * kerf);
    if (out_.pieces.size() > max_sheet_pieces)
      throw InvalidInput(
          fmt::format("the cuts leave more than {} pieces. Give a part of the drawing", max_sheet_pieces));
    std::sort(out_.pieces.begin(), out_.pieces.end(), [&](const SheetPiece& a, const SheetPiece& b) {
      return place_in_order(a) < place_in_order(b);
    });
    find_boxes();
    out_.joints.clear();
    std::vector<Segment> kept;
    for (const Segment& segment : segments_) {
      const Vector2d along = segment.to - segment.from,
                     across = kerf * model::turned_by_90(along).normalized();
      // The middle of a gap that is narrower than the cuts is in the next cut.
      const Vector2d place = along.norm() > kerf ? Vector2d(segment.from + along / 2) : segment.from;
      const int left = piece_at(place + across), right = piece_at(place - across);
      if (left < 0 || right < 0 || left == right) continue;
      kept.push_back(segment);
      out_.joints.push_back(
          {std::min(left, right), std::max(left, right), segment.from, segment.to, segment.is_crease});
    }
    const bool has_idle = kept.size() < segments_.size();
    segments_ = std::move(kept);
    return has_idle;
  }

  /// Returns row and column of a piece: from below, and from the left in a row.
  std::pair<double, double> place_in_order(const SheetPiece& piece) const {
    Eigen::AlignedBox2d box;
    for (const Vector2d& corner : piece.front()) box.extend(corner);
    return {std::round(box.center().y() / settings_.kerf_mm), box.center().x()};
  }

  void find_boxes() {
    boxes_.clear();
    for (const SheetPiece& piece : out_.pieces) {
      boxes_.emplace_back();
      for (const Vector2d& corner : piece.front()) boxes_.back().extend(corner);
    }
  }

  int piece_at(const Vector2d& p) const {
    for (std::size_t k = 0; k < boxes_.size(); ++k)
      if (boxes_[k].contains(p) && is_within(out_.pieces[k], p)) return static_cast<int>(k);
    return -1;
  }

  void keep_largest_group() {
    UnionFind groups(out_.pieces.size());
    for (const SheetJoint& joint : out_.joints) groups.unite(joint.lower, joint.upper);
    const std::vector<int> group = out_.pieces.empty() ? std::vector<int>() : groups.largest();
    if (group.size() < 2) refuse_rigid();
    // A loose piece that is larger than the group is the sheet, and the group is a detail of it.
    double area = 0, largest = 0;
    for (const SheetPiece& piece : out_.pieces) largest = std::max(largest, piece_area(piece));
    for (const int k : group) area += piece_area(out_.pieces[k]);
    if (largest > area) refuse_rigid();
    out_.loose = static_cast<int>(out_.pieces.size() - group.size());
    std::vector<int> number(out_.pieces.size(), -1);
    std::vector<SheetPiece> pieces;
    for (const int k : group) {
      number[k] = static_cast<int>(pieces.size());
      pieces.push_back(std::move(out_.pieces[k]));
    }
    out_.pieces = std::move(pieces);
    std::erase_if(out_.joints, [&](const SheetJoint& joint) { return number[joint.lower] < 0; });
    for (SheetJoint& joint : out_.joints) {
      joint.lower = number[joint.lower];
      joint.upper = number[joint.upper];
    }
    std::stable_sort(out_.joints.begin(), out_.joints.end(), [](const SheetJoint& a, const SheetJoint& b) {
      const auto key = [](const SheetJoint& j) {
        return std::tuple(j.lower, j.upper, (j.from + j.to).y(), (j.from + j.to).x());
      };
      return key(a) < key(b);
    });
  }

  /// Refuses a sheet without two pieces that hang together.
  [[noreturn]] void refuse_rigid() const {
    const auto spans_sheet = [&](const Eigen::AlignedBox2d& box) {
      return (box.sizes().array() >= main_share * box_.sizes().array()).all();
    };
    const std::size_t others = out_.pieces.empty() ? 0 : out_.pieces.size() - 1;
    if (others > 0 && std::none_of(boxes_.begin(), boxes_.end(), spans_sheet))
      throw InvalidInput(
          fmt::format("the lines cut the sheet into {} loose pieces. End cuts short of other lines, so that "
                      "bridges stay between them",
                      out_.pieces.size()));
    std::vector<SheetBridge> wider;
    try {
      wider = bridges(box_.sizes().norm());
    } catch (const InvalidInput&) {
      wider.clear();  // There are too many lines to look so far.
    }
    const auto next = std::find_if(wider.begin(), wider.end(),
                                   [&](const SheetBridge& b) { return b.gap() > out_.bridge_mm; });
    const std::string advice =
        next == wider.end()
            ? "Draw cuts whose ends come near other cuts"
            : fmt::format("Set structure.bridge_mm to more: the next gap is {:.3g} mm wide", next->gap());
    throw InvalidInput(
        fmt::format("the sheet stays in one piece{}: no bridges up to {:.3g} mm wide separate it. {}",
                    others > 0 ? fmt::format(", and {} inside closed lines fall out", others) : "",
                    out_.bridge_mm, advice));
  }

  /// Takes the bridges out of the pieces that they join. Pieces of which too little would remain stay whole.
  void relieve_pieces() {
    std::vector<SheetArea> bridges(out_.pieces.size());
    for (const SheetJoint& joint : out_.joints)
      if (!joint.is_crease)
        for (const int k : {joint.lower, joint.upper})
          bridges[k].insert(on_grid(bridge_outline(joint.from, joint.to, 0)));
    for (std::size_t k = 0; k < out_.pieces.size(); ++k) {
      SheetArea left;
      for (const FlatRing& ring : out_.pieces[k]) {
        SheetArea ring_area;
        ring_area.insert(on_grid(ring));
        left ^= ring_area;
      }
      const auto whole = bp::area(left);
      left -= bridges[k];
      std::vector<SheetPiece> parts = pieces_of(left, 0);
      if (parts.size() == 1 && bp::area(left) >= least_relieved * whole) out_.pieces[k] = std::move(parts[0]);
    }
  }

  void refuse_burnt_bridges() const {
    for (const SheetJoint& joint : out_.joints)
      if (!(joint.length() > settings_.kerf_mm))
        throw InvalidInput(fmt::format(
            "the {} at ({:.6g}, {:.6g}) mm is {:.2g} mm wide, and cuts are {:g} mm wide. Draw it wider, or "
            "set process.kerf_mm to less",
            joint.is_crease ? "crease" : "bridge", joint.from.x(), joint.from.y(), joint.length(),
            settings_.kerf_mm));
  }

  std::vector<DrawnLine> lines_;
  const CutSettings& settings_;
  const bool has_green_;
  Eigen::AlignedBox2d box_;
  model::PlanarGraph cuts_;
  std::vector<model::GraphEdge> creases_;
  std::vector<bool> is_rim_, ends_in_crease_;
  SheetArea whole_;
  std::vector<SheetPiece> rims_;  ///< outlines of the sheet
  std::vector<Segment> segments_;
  std::vector<Eigen::AlignedBox2d> boxes_;
  CutSheet out_;
};

}  // namespace

bool has_green_cuts(const std::vector<DrawnLine>& lines) {
  return std::any_of(lines.begin(), lines.end(), [](const DrawnLine& line) { return line.colour == green; });
}

bool is_crease(const DrawnLine& line, bool has_green) {
  return has_green && (line.colour == 0xFF0000 || line.colour == 0x0000FF || line.colour == 0xFF00FF);
}

CutSheet make_cut_sheet(std::vector<DrawnLine> lines, const CutSettings& settings) {
  return SheetCutter(std::move(lines), settings).run();
}

}  // namespace kinetix::targets
