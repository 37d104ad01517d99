#include "app/print/sheet/tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace kinetix::app {
namespace {

constexpr double file_rounding_mm = 1e-3;  // mm: files have floats, and nobody knows a bed to less
constexpr int halvings = 40;               // of a width: from any bed to less than a rounding of files

using PrintBoxes = std::vector<Eigen::AlignedBox2d>;

bool is_held(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm) {
  return ((bed_mm - size_mm).array() >= -file_rounding_mm).all();
}

Eigen::Vector2d turned_by_a_quarter(const Eigen::Vector2d& bed_mm) { return bed_mm.reverse(); }

/// Boxes along one axis, one part after the other. Filling from the lower end gives the fewest parts.
class BoxesInARow {
 public:
  BoxesInARow(const PrintBoxes& boxes, int axis) : boxes_(boxes), axis_(axis) {
    for (int b = 0; b < static_cast<int>(boxes.size()); ++b)
      if (!boxes[b].isEmpty()) order_.push_back(b);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return low(a) < low(b); });
  }

  /// The part of each box, none wider than room_mm.
  std::vector<int> filled(double room_mm) const {
    std::vector<int> part(boxes_.size(), 0);
    int now = 0;
    for (std::size_t k = 0, first = 0; k < order_.size(); ++k) {
      if (high(order_[k]) > low(order_[first]) + room_mm + file_rounding_mm) {
        first = k;
        ++now;
      }
      part[order_[k]] = now;
    }
    return part;
  }

  /// As few parts, about equally wide.
  std::vector<int> evenly_filled(double room_mm) const {
    const int least = count(filled(room_mm));
    double narrow = 0, wide = room_mm;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (narrow + wide) / 2;
      (holds(middle) && count(filled(middle)) == least ? wide : narrow) = middle;
    }
    return filled(wide);
  }

  static int count(const std::vector<int>& part) {
    return part.empty() ? 1 : 1 + *std::max_element(part.begin(), part.end());
  }

 private:
  double low(int box) const { return boxes_[box].min()[axis_]; }
  double high(int box) const { return boxes_[box].max()[axis_]; }

  bool holds(double room_mm) const {
    return std::all_of(order_.begin(), order_.end(),
                       [&](int box) { return high(box) - low(box) <= room_mm + file_rounding_mm; });
  }

  const PrintBoxes& boxes_;
  const int axis_;
  std::vector<int> order_;  // from the lower end on
};

bool holds_each(const PrintBoxes& boxes, const Eigen::Vector2d& bed_mm) {
  return std::all_of(boxes.begin(), boxes.end(), [&](const Eigen::AlignedBox2d& box) {
    return box.isEmpty() || is_held(box.sizes(), bed_mm);
  });
}

/// The bed as given, or turned where only that holds each body, or takes fewer tiles.
/// @throws BedTooSmall
bool is_better_turned(const PrintBoxes& boxes, const Eigen::Vector2d& bed_mm) {
  const auto tiles_of = [&](const Eigen::Vector2d& bed) {
    return BoxesInARow::count(BoxesInARow(boxes, 0).filled(bed.x())) *
           BoxesInARow::count(BoxesInARow(boxes, 1).filled(bed.y()));
  };
  const Eigen::Vector2d other = turned_by_a_quarter(bed_mm);
  const bool as_given = holds_each(boxes, bed_mm), as_turned = holds_each(boxes, other);
  if (as_given) return as_turned && tiles_of(other) < tiles_of(bed_mm);
  if (as_turned) return true;
  Eigen::Vector2d largest = Eigen::Vector2d::Zero();
  const auto sides = [](const Eigen::Vector2d& size) { return std::pair(size.maxCoeff(), size.minCoeff()); };
  for (const Eigen::AlignedBox2d& box : boxes)
    if (!box.isEmpty() && !is_held(box.sizes(), bed_mm) && sides(box.sizes()) > sides(largest))
      largest = box.sizes();
  throw BedTooSmall(
      fmt::format("a bed of {:g} x {:g} mm does not hold a body of {:.1f} x {:.1f} mm: a larger bed does, or "
                  "smaller cells (kinetix-opt export --cell-mm)",
                  bed_mm.x(), bed_mm.y(), largest.x(), largest.y()));
}

}  // namespace

bool fits_on_bed(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm) {
  return is_held(size_mm, bed_mm) || is_held(size_mm, turned_by_a_quarter(bed_mm));
}

Tiles cut_into_tiles(const std::vector<Eigen::AlignedBox2d>& boxes, const Eigen::Vector2d& bed_mm) {
  Tiles tiles;
  tiles.bed_mm = bed_mm;
  tiles.turned = is_better_turned(boxes, bed_mm);
  const Eigen::Vector2d bed = tiles.turned ? turned_by_a_quarter(bed_mm) : bed_mm;
  const std::vector<int> column = BoxesInARow(boxes, 0).evenly_filled(bed.x()),
                         row = BoxesInARow(boxes, 1).evenly_filled(bed.y());
  tiles.columns = BoxesInARow::count(column);
  tiles.rows = BoxesInARow::count(row);
  std::map<int, int> number;  // of the tile, by place in the grid
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (!boxes[b].isEmpty()) number[row[b] * tiles.columns + column[b]] = 0;
  tiles.with_bodies = 0;
  for (auto& [place, tile] : number) tile = tiles.with_bodies++;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    tiles.of_body.push_back(boxes[b].isEmpty() ? 0 : number[row[b] * tiles.columns + column[b]]);
  return tiles;
}

}  // namespace kinetix::app
