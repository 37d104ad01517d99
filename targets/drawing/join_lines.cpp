#include "targets/drawing/join_lines.hpp"

#include <boost/geometry/algorithms/comparable_distance.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/algorithms/equals.hpp>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "model/base/geometry.hpp"

namespace kinetix::targets {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using Eigen::Vector2d;
using MapPoint = bg::model::d2::point_xy<double>;
using MapBox = bg::model::box<MapPoint>;
using MapOfPoints = bgi::rtree<std::pair<MapPoint, int>, bgi::quadratic<16>>;
using MapOfBoxes = bgi::rtree<std::pair<MapBox, int>, bgi::quadratic<16>>;

// Share of the mean line: rounding of lines that belong together. model::validate() takes half of it for contact.
constexpr double rounding = 4e-6;
constexpr double near_miss = 10;             // joining distances
constexpr std::size_t max_pairs = 50 << 20;  // pairs of lines near each other, some seconds
constexpr double most_rough =
    1e4;                        // roundings: to look for the median wall of lines that run near each other
constexpr int max_rounds = 30;  // of splitting: a drawing needs two or three

MapPoint map_point(const Vector2d& p) { return {p.x(), p.y()}; }

MapBox map_box(const Vector2d& a, const Vector2d& b, double margin) {
  const Vector2d low = a.cwiseMin(b).array() - margin, high = a.cwiseMax(b).array() + margin;
  return {map_point(low), map_point(high)};
}

/// Places, numbered. A place within the joining distance of an earlier one gets its number.
class JoinedPlaces {
 public:
  explicit JoinedPlaces(double join) : join_(join) {}

  int number(const Vector2d& p) {
    if (const auto known = nearest(p); known && (points_[*known] - p).norm() <= join_) return *known;
    map_.insert({map_point(p), static_cast<int>(points_.size())});
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  const Vector2d& operator[](int place) const { return points_[place]; }
  const std::vector<Vector2d>& points() const { return points_; }

 private:
  std::optional<int> nearest(const Vector2d& p) const {
    for (auto found = map_.qbegin(bgi::nearest(map_point(p), 1)); found != map_.qend(); ++found)
      return found->second;
    return std::nullopt;
  }

  double join_;
  std::vector<Vector2d> points_;
  MapOfPoints map_;
};

/// Part of a line between two places.
struct Piece {
  int from, to;
  int line;  ///< index of the line
};

/// Lines that the joining distance does not separate.
struct TooNear {};

/// Splits lines at their common places, in rounds. @throws TooNear
class LineSplitter {
 public:
  LineSplitter(const std::vector<DrawnLine>& lines, double join) : lines_(lines), join_(join), places_(join) {
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const int from = places_.number(lines[k].from), to = places_.number(lines[k].to);
      pieces_.push_back({from, to, static_cast<int>(k)});
    }
    merge_pieces();
    split();
    remove_ends_within_lines();
    split();  // merged pieces are straight, and may cross others
  }

  JoinedLines result() const {
    JoinedLines out;
    out.join = join_;
    std::vector<int> number(places_.points().size(), -1);
    const auto vertex = [&](int place) {
      if (number[place] < 0) {
        number[place] = static_cast<int>(out.graph.vertices.size());
        out.graph.vertices.push_back(places_[place]);
      }
      return number[place];
    };
    for (const Piece& piece : pieces_) {
      const int from = vertex(piece.from), to = vertex(piece.to);
      out.graph.edges.push_back({from, to});
      out.line_of.push_back(piece.line);
    }
    return out;
  }

 private:
  using Cuts = std::vector<std::vector<int>>;  ///< places on each piece

  void split() {
    int round = 0;
    do {
      while (cut_at_places())
        if (++round > max_rounds) fail();
    } while (cut_at_crossings() && ++round <= max_rounds);
    if (round > max_rounds) fail();
  }

  [[noreturn]] static void fail() { throw TooNear(); }

  MapOfBoxes map_of_pieces() const {
    std::vector<std::pair<MapBox, int>> boxes;
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      boxes.emplace_back(map_box(places_[pieces_[k].from], places_[pieces_[k].to], join_),
                         static_cast<int>(k));
    return MapOfBoxes(boxes);
  }

  /// Counts pairs over all rounds, which take the time.
  void count_pair() {
    if (++pairs_ > max_pairs)
      throw InvalidInput("too many lines cross or overlap. Give a drawing with fewer or shorter lines");
  }

  bool cut_at_places() {
    const MapOfBoxes map = map_of_pieces();
    Cuts cuts(pieces_.size());
    std::vector<bool> is_used(places_.points().size(), false);
    for (const Piece& piece : pieces_) is_used[piece.from] = is_used[piece.to] = true;
    for (int place = 0; place < static_cast<int>(is_used.size()); ++place) {
      if (!is_used[place]) continue;
      const Vector2d& p = places_[place];
      for (auto near = map.qbegin(bgi::intersects(map_point(p))); near != map.qend(); ++near) {
        count_pair();
        const Piece& piece = pieces_[near->second];
        if (place != piece.from && place != piece.to && is_on(p, piece)) cuts[near->second].push_back(place);
      }
    }
    return apply(std::move(cuts));
  }

  bool is_on(const Vector2d& p, const Piece& piece) const {
    return model::distance_to_wall(p, places_[piece.from], places_[piece.to]) <= join_;
  }

  bool cut_at_crossings() {
    const MapOfBoxes map = map_of_pieces();
    Cuts cuts(pieces_.size());
    for (int k = 0; k < static_cast<int>(pieces_.size()); ++k) {
      const MapBox box = map_box(places_[pieces_[k].from], places_[pieces_[k].to], 0);
      for (auto near = map.qbegin(bgi::intersects(box)); near != map.qend(); ++near) {
        count_pair();
        if (near->second <= k) continue;
        const auto crossing = crossing_of(pieces_[k], pieces_[near->second]);
        if (!crossing) continue;
        const int place = places_.number(*crossing);
        for (const int piece : {k, near->second})
          if (place != pieces_[piece].from && place != pieces_[piece].to) cuts[piece].push_back(place);
        if (places_.points().size() > max_drawn_lines) refuse_count();
      }
    }
    return apply(std::move(cuts));
  }

  std::optional<Vector2d> crossing_of(const Piece& a, const Piece& b) const {
    if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) return std::nullopt;
    const Vector2d &p = places_[a.from], &r = places_[b.from];
    const Vector2d along = places_[a.to] - p, other = places_[b.to] - r;
    const double turn = along.x() * other.y() - along.y() * other.x();
    if (turn == 0) return std::nullopt;
    const Vector2d between = r - p;
    const double s = (between.x() * other.y() - between.y() * other.x()) / turn,
                 t = (between.x() * along.y() - between.y() * along.x()) / turn;
    if (!(s > 0 && s < 1 && t > 0 && t < 1)) return std::nullopt;
    return p + s * along;
  }

  [[noreturn]] static void refuse_count() {
    throw InvalidInput("the lines form more than a million walls. Give a smaller drawing");
  }

  /// Replaces pieces by their parts. @return whether any piece was cut
  bool apply(Cuts cuts) {
    std::vector<Piece> parts;
    bool is_cut = false;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& piece = pieces_[k];
      const Vector2d start = places_[piece.from], along = places_[piece.to] - start;
      std::sort(cuts[k].begin(), cuts[k].end(), [&](int a, int b) {
        return std::pair(along.dot(places_[a] - start), a) < std::pair(along.dot(places_[b] - start), b);
      });
      int from = piece.from;
      for (const int place : cuts[k]) {
        parts.push_back({from, place, piece.line});
        from = place;
        is_cut = true;
      }
      parts.push_back({from, piece.to, piece.line});
    }
    pieces_ = std::move(parts);
    merge_pieces();
    return is_cut;
  }

  /// Removes pieces without length. Of pieces with the same ends the one of the last line remains.
  void merge_pieces() {
    std::map<std::pair<int, int>, std::size_t> known;
    std::vector<Piece> kept;
    for (const Piece& piece : pieces_) {
      if (piece.from == piece.to) continue;
      const auto [found, is_new] = known.try_emplace(std::minmax(piece.from, piece.to), kept.size());
      if (is_new)
        kept.push_back(piece);
      else
        kept[found->second].line = std::max(kept[found->second].line, piece.line);
    }
    if (kept.size() > max_drawn_lines) refuse_count();
    pieces_ = std::move(kept);
  }

  /// Merges the two pieces of a place that only exists because a line ends there on another line that covers both.
  void remove_ends_within_lines() {
    std::vector<std::pair<MapBox, int>> boxes;
    for (std::size_t k = 0; k < lines_.size(); ++k)
      boxes.emplace_back(map_box(lines_[k].from, lines_[k].to, join_), static_cast<int>(k));
    const MapOfBoxes map(boxes);
    std::vector<std::vector<std::size_t>> at(places_.points().size());
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      for (const int place : {pieces_[k].from, pieces_[k].to}) at[place].push_back(k);
    for (int place = 0; place < static_cast<int>(at.size()); ++place) {
      if (at[place].size() != 2) continue;
      const std::size_t kept = at[place][0], removed = at[place][1];
      const int from = other_end(kept, place), to = other_end(removed, place);
      if (from == to || !is_within_line(map, place, from, to)) continue;
      pieces_[kept] = {from, to, std::max(pieces_[kept].line, pieces_[removed].line)};
      pieces_[removed] = {to, to, 0};
      std::replace(at[to].begin(), at[to].end(), removed, kept);
    }
    merge_pieces();
  }

  int other_end(std::size_t piece, int place) const {
    return pieces_[piece].from == place ? pieces_[piece].to : pieces_[piece].from;
  }

  /// Returns whether one line covers three places, the first of them not at its ends.
  bool is_within_line(const MapOfBoxes& map, int place, int from, int to) {
    const Vector2d& p = places_[place];
    for (auto near = map.qbegin(bgi::intersects(map_point(p))); near != map.qend(); ++near) {
      count_pair();
      const DrawnLine& line = lines_[near->second];
      if ((line.from - p).norm() <= join_ || (line.to - p).norm() <= join_ || line.from == line.to) continue;
      const auto covers = [&](int k) {
        return model::distance_to_wall(places_[k], line.from, line.to) <= 2 * join_;
      };
      if (covers(place) && covers(from) && covers(to)) return true;
    }
    return false;
  }

  const std::vector<DrawnLine>& lines_;
  double join_;
  JoinedPlaces places_;
  std::vector<Piece> pieces_;
  std::size_t pairs_ = 0;
};

double mean_length(const std::vector<DrawnLine>& lines) {
  double sum = 0;
  for (const DrawnLine& line : lines) sum += (line.to - line.from).norm();
  return lines.empty() ? 0 : sum / static_cast<double>(lines.size());
}

/// Returns the length of the wall in the middle of the total length, so that short remains do not count.
double median_wall(const model::PlanarGraph& graph) {
  std::vector<double> lengths;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) lengths.push_back(graph.along(e).norm());
  std::sort(lengths.begin(), lengths.end());
  const double half = std::accumulate(lengths.begin(), lengths.end(), 0.0) / 2;
  double sum = 0;
  for (const double length : lengths)
    if ((sum += length) >= half) return length;
  return 0;
}

/// Joins lines in a distance; empty if it does not separate them.
std::optional<JoinedLines> try_to_join(const std::vector<DrawnLine>& lines, double near) {
  try {
    return LineSplitter(lines, near).result();
  } catch (const TooNear&) {
    return std::nullopt;
  }
}

}  // namespace

JoinedLines join_lines(const std::vector<DrawnLine>& lines, std::optional<double> join) {
  const double least = rounding * mean_length(lines);
  if (!(least > 0)) throw InvalidInput("the drawing has no lines with a length. Draw each wall as one line");
  if (join) {
    if (auto joined = try_to_join(lines, std::max(*join, least))) return std::move(*joined);
    throw InvalidInput("lines run too near each other to be separated. Change structure.join_mm");
  }
  std::optional<JoinedLines> rough;
  for (double near = least; !rough && near < most_rough * least; near *= 10) rough = try_to_join(lines, near);
  if (!rough) throw InvalidInput("lines run too near each other to be separated. Draw them farther apart");
  for (double near = default_join * median_wall(rough->graph); near > rough->join; near /= 4)
    if (auto joined = try_to_join(lines, near)) return std::move(*joined);
  return std::move(*rough);
}

std::vector<NearMiss> find_near_misses(const JoinedLines& joined) {
  const model::PlanarGraph& graph = joined.graph;
  const double near = near_miss * joined.join;
  std::vector<std::pair<MapBox, int>> boxes;
  std::vector<std::vector<int>> neighbours(graph.vertices.size());
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) {
    const auto [from, to] = graph.edges[e];
    boxes.emplace_back(map_box(graph.vertices[from], graph.vertices[to], near), e);
    neighbours[from].push_back(to);
    neighbours[to].push_back(from);
  }
  const auto are_joined = [&](int v, int other) {
    return std::find(neighbours[v].begin(), neighbours[v].end(), other) != neighbours[v].end();
  };
  const MapOfBoxes map(boxes);
  std::vector<NearMiss> misses;
  for (int v = 0; v < static_cast<int>(graph.vertices.size()); ++v) {
    const Vector2d& p = graph.vertices[v];
    for (auto found = map.qbegin(bgi::intersects(map_point(p))); found != map.qend(); ++found) {
      auto [from, to] = graph.edges[found->second];
      if (v == to) std::swap(from, to);
      const Vector2d a = graph.vertices[from], along = graph.vertices[to] - a;
      const double part = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const bool is_tail = v == from && neighbours[v].size() == 1;
      const NearMiss miss{p, v == from ? graph.vertices[to] : Vector2d(a + part * along)};
      const bool is_short_wall =
          (part == 0 && are_joined(v, from)) || (part == 1 && are_joined(v, to)) || v == from;
      if (miss.gap() < near && (is_tail || !is_short_wall)) misses.push_back(miss);
    }
  }
  return misses;
}

}  // namespace kinetix::targets
