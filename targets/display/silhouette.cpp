#include "targets/display/picture.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "model/base/invalid_input.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

constexpr std::uint8_t half_ink = 128;  // from which a pixel is dark
constexpr std::size_t min_pixels = 20;  // smaller parts have no shape
constexpr std::size_t max_steps =
    200'000;  // pixel sides of an outline: 25 times the side of the largest picture
constexpr double speck_share = 1.0 / 500;  // of the largest part: smaller ones are dust
constexpr double max_shortcut = 0.75;      // pixels, by which the outline may cut off steps of pixels

/// Pixels of a picture in connected parts; pixels that share a side belong together.
class Parts {
 public:
  explicit Parts(const Picture& picture) : width_(picture.width), height_(picture.height) {
    const bool is_inverted = has_dark_margin(picture);
    part_.assign(picture.ink.size(), 0);
    for (std::size_t k = 0; k < part_.size(); ++k)
      if ((picture.ink[k] >= half_ink) != is_inverted) part_[k] = unvisited;
    for (std::size_t k = 0; k < part_.size(); ++k)
      if (part_[k] == unvisited) fill(static_cast<int>(k));
  }

  /// Returns the number of the largest part, from 1. @pre there is a part
  int largest() const {
    return static_cast<int>(std::max_element(sizes_.begin(), sizes_.end()) - sizes_.begin()) + 1;
  }
  const std::vector<std::size_t>& sizes() const { return sizes_; }
  bool contains(int part, int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && part_[index(x, y)] == part;
  }
  /// Returns the first pixel of a part, by rows from the top.
  std::array<int, 2> first_of(int part) const {
    const auto k = static_cast<int>(std::find(part_.begin(), part_.end(), part) - part_.begin());
    return {k % width_, k / width_};
  }

 private:
  static constexpr int unvisited = -1;  // instead of the number of a part, which is above 0

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  bool has_dark_margin(const Picture& picture) const {
    std::size_t dark = 0, all = 0;
    const auto count = [&](int x, int y) {
      dark += picture.ink[index(x, y)] >= half_ink;
      ++all;
    };
    for (int x = 0; x < width_; ++x) count(x, 0), count(x, height_ - 1);
    for (int y = 0; y < height_; ++y) count(0, y), count(width_ - 1, y);
    return 2 * dark > all;
  }

  void fill(int start) {
    sizes_.push_back(0);
    const int part = static_cast<int>(sizes_.size());
    std::vector<int> open = {start};
    part_[start] = part;
    while (!open.empty()) {
      const int k = open.back(), x = k % width_, y = k / width_;
      open.pop_back();
      ++sizes_.back();
      for (const auto& [i, j] : {std::pair(x - 1, y), {x + 1, y}, {x, y - 1}, {x, y + 1}})
        if (contains(unvisited, i, j)) {
          part_[index(i, j)] = part;
          open.push_back(static_cast<int>(index(i, j)));
        }
    }
  }

  int width_, height_;
  std::vector<int> part_;  ///< of each pixel, from 1; 0: paper
  std::vector<std::size_t> sizes_;
};

/// Returns the middles of the pixel sides round a part, with the part to the right, y down.
std::vector<Vector2d> boundary_steps(const Parts& parts, int part) {
  constexpr std::array<std::array<int, 2>, 4> ways = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};  // each turns right
  const std::array<int, 2> first = parts.first_of(part);
  std::vector<Vector2d> out;
  int x = first[0], y = first[1], way = 0;
  do {
    const auto [dx, dy] = ways[way];
    out.emplace_back(x + dx / 2.0, y + dy / 2.0);
    if (out.size() > max_steps)
      throw InvalidInput("the outline has too many pixels. Give a smaller or smoother picture");
    x += dx, y += dy;
    // The pixels ahead, right and left of the corner (x, y).
    const auto is_inside = [&](int side) {
      const int rx = -dy * side, ry = dx * side;  // to the right for side 1, y down
      return parts.contains(part, x + (dx + rx - 1) / 2, y + (dy + ry - 1) / 2);
    };
    if (!is_inside(1))
      way = (way + 1) % 4;
    else if (is_inside(-1))
      way = (way + 3) % 4;
  } while (x != first[0] || y != first[1] || way != 0);
  return out;
}

double distance_to_chord(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double f = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return (p - a - f * along).norm();
}

/// Leaves out points within a distance of the chords between those that remain (Douglas and Peucker 1973).
std::vector<Vector2d> simplified(const std::vector<Vector2d>& loop, double most) {
  const std::size_t count = loop.size();
  std::vector<bool> keeps(count, false);
  std::size_t far = 0;
  for (std::size_t k = 0; k < count; ++k)
    if ((loop[k] - loop[0]).norm() > (loop[far] - loop[0]).norm()) far = k;
  keeps[0] = keeps[far] = true;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, far}, {far, count}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t worst = from;
    double distance = most;
    for (std::size_t k = from + 1; k < to; ++k)
      if (const double d = distance_to_chord(loop[k], loop[from], loop[to % count]); d > distance)
        distance = d, worst = k;
    if (worst == from) continue;
    keeps[worst] = true;
    open.emplace_back(from, worst);
    open.emplace_back(worst, to);
  }
  std::vector<Vector2d> out;
  for (std::size_t k = 0; k < count; ++k)
    if (keeps[k]) out.push_back(loop[k]);
  return out;
}

}  // namespace

Silhouette silhouette_of(const Picture& picture) {
  const Parts parts(picture);
  if (parts.sizes().empty() || parts.sizes()[parts.largest() - 1] < min_pixels)
    throw InvalidInput(
        "the picture has no silhouette of at least 20 pixels. Give a dark shape on a light ground");
  const int part = parts.largest();
  const auto largest = static_cast<double>(parts.sizes()[part - 1]);
  Silhouette out;
  out.points = simplified(boundary_steps(parts, part), max_shortcut);
  for (Vector2d& p : out.points) p.y() = picture.height - p.y();
  for (const std::size_t size : parts.sizes())
    out.left_out += static_cast<double>(size) >= speck_share * largest;
  --out.left_out;
  return out;
}

}  // namespace kinetix::targets
