#include "targets/curve/point_files.hpp"

#include <cmath>

#include "model/base/box.hpp"
#include "model/base/geometry.hpp"
#include "targets/curve/curve.hpp"
#include "targets/document/length_unit.hpp"
#include "targets/document/number.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using SpaceLine = std::vector<Vector3d>;

constexpr double spike_mm = 0.1;      // shorter spikes are errors of drawing: no printer makes them
constexpr double spike_share = 1e-3;  // of the box's diagonal, for small curves
constexpr double spike_turn = 150 * radians_per_degree;  // turn at the tip of a spike
constexpr double open_gap = 3;  // times the longest other side: an outline is open there
constexpr double min_size_mm = 2, max_size_mm = 10'000;  // goals of other sizes have a wrong unit
constexpr double usual_size_mm = 200;                    // mm: the unit that comes nearest to it is suggested
constexpr int max_smooth_points = 8;  // per given point: chords then deviate little from the curve
constexpr std::size_t most_smooth_points = 4000;        // in all: the limit of curves in space is 5000
constexpr std::size_t min_noisy_points = 30;            // fewer points may be corners of a shape
constexpr double noisy_length = 2;                      // of the box's diagonal
constexpr double noisy_turn = 45 * radians_per_degree;  // mean turn at a point
constexpr int noise_points = 20;                        // that an average should cover

double size_of_line(const SpaceLine& line) { return model::box_of(line).diagonal().norm(); }

double length_of(const SpaceLine& line) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

/// Turn of a line at point k, rad; 0 if a side has no length.
double turn_at(const SpaceLine& line, std::size_t k) {
  const Vector3d in = line[k] - line[k - 1], on = line[k + 1] - line[k];
  return std::atan2(in.cross(on).norm(), in.dot(on));
}

/// Keeps the points for which `keeps` holds. @return place of the first one that is removed, and their number
template <class Keeps>
std::pair<Place, std::size_t> keep_points(FilePoints& points, const Keeps& keeps) {
  FilePoints kept{{}, {}, points.place};
  std::pair<Place, std::size_t> removed{{}, 0};
  for (std::size_t k = 0; k < points.points.size(); ++k) {
    if (keeps(kept.points, k)) {
      kept.points.push_back(points.points[k]);
      kept.places.push_back(points.places[k]);
    } else if (removed.second++ == 0) {
      removed.first = points.places[k];
    }
  }
  points.points = std::move(kept.points);
  points.places = std::move(kept.places);
  return removed;
}

std::string place_text(const Place& place) {
  return place.line == 0 ? std::string() : ", the first in line " + std::to_string(place.line);
}

void merge_repeated(FilePoints& points) {
  if (points.points.size() < 2) return;
  const double near = touching * size_of_line(points.points);
  const auto [place, count] = keep_points(points, [&](const SpaceLine& kept, std::size_t k) {
    return kept.empty() || (points.points[k] - kept.back()).norm() > near;
  });
  if (count > 0)
    points.notes.push_back(counted(count, "point") + " equal to the one before " +
                           (count == 1 ? "is" : "are") + " left out" + place_text(place));
}

void remove_spikes(FilePoints& points) {
  const double most = std::min(spike_mm, spike_share * size_of_line(points.points));
  Place first;
  std::size_t removed = 0;
  for (std::size_t before = points.points.size() + 1;
       before != points.points.size() && points.points.size() > 3;) {
    before = points.points.size();
    const SpaceLine line = points.points;
    std::size_t last_removed = 0;  // neighbours stay, so that both sides of a narrow part are not lost
    const auto [place, count] = keep_points(points, [&](const SpaceLine&, std::size_t k) {
      if (k == 0 || k + 1 == line.size() || (last_removed > 0 && last_removed + 1 == k)) return true;
      const bool is_spike = turn_at(line, k) > spike_turn &&
                            std::min((line[k] - line[k - 1]).norm(), (line[k + 1] - line[k]).norm()) < most;
      if (is_spike) last_removed = k;
      return !is_spike;
    });
    if (removed == 0) first = place;
    removed += count;
    const auto same = [&](const SpaceLine& kept, std::size_t k) {
      return kept.empty() || points.points[k] != kept.back();
    };
    keep_points(points, same);
  }
  if (removed > 0)
    points.notes.push_back(counted(removed, "spike") + " below " + number_text(most) + " mm " +
                           (removed == 1 ? "is" : "are") + " removed" + place_text(first));
}

/// @throws InvalidInput for an outline whose last point is far from its first
void check_outline_end(const FilePoints& points) {
  const SpaceLine& line = points.points;
  if (line.size() < 3 || line.front() == line.back()) return;
  double longest = 0;
  for (std::size_t k = 1; k < line.size(); ++k) longest = std::max(longest, (line[k] - line[k - 1]).norm());
  const double gap = (line.back() - line.front()).norm();
  if (gap > open_gap * longest)
    throw InvalidInput("the outline is open: its ends are " + number_text(gap) +
                           " mm apart. Close it, or repeat the first point at the end for a straight side",
                       points.place);
}

/// Point on a line, with the index of the line's point before it.
struct PointOnLine {
  Vector3d at;
  std::size_t before;
};

/// Replaces points by averages along the line, with Gaussian weights. Ends of open lines stay.
void average(FilePoints& points, double window, bool is_closed) {
  SpaceLine line = points.points;
  if (is_closed && line.front() != line.back()) line.push_back(line.front());
  const double length = length_of(line);
  const auto count =
      static_cast<std::size_t>(std::clamp(length / (window / 10), 50.0, double(most_smooth_points)));
  std::vector<PointOnLine> even;
  double start = 0;  // arc length of point `before`
  for (std::size_t k = 0, before = 0; k < count; ++k) {
    const double s = length * static_cast<double>(k) / static_cast<double>(is_closed ? count : count - 1);
    while (before + 2 < line.size() && start + (line[before + 1] - line[before]).norm() < s)
      start += (line[before + 1] - line[before]).norm(), ++before;
    const Vector3d along = line[before + 1] - line[before];
    even.push_back({line[before] + std::min((s - start) / along.norm(), 1.0) * along,
                    std::min(before, points.places.size() - 1)});
  }
  const double step = length / static_cast<double>(count);
  const int reach = static_cast<int>(window / (2 * step)), total = static_cast<int>(count);
  FilePoints out{{}, {}, points.place, points.notes};
  for (int k = 0; k < total; ++k) {
    const int near = is_closed ? std::min(reach, total / 2) : std::min({reach, k, total - 1 - k});
    Vector3d sum = Vector3d::Zero();
    double weights = 0;
    for (int d = -near; d <= near; ++d) {
      const double weight =
          std::exp(-8 * std::pow(d * step / window, 2));  // a quarter of it is the deviation
      sum += weight * even[(k + d + total) % total].at;
      weights += weight;
    }
    out.points.push_back(sum / weights);
    out.places.push_back(points.places[even[k].before]);
  }
  points.points = std::move(out.points);
  points.places = std::move(out.places);
}

/// Point of the centripetal Catmull-Rom spline between b and c (Yuksel, Schaefer and Keyser 2011, CAD 43, 747).
Vector3d spline_point(const std::array<Vector3d, 4>& p, double part) {
  std::array<double, 4> t = {0, 0, 0, 0};
  for (int k = 1; k < 4; ++k) t[k] = t[k - 1] + std::sqrt((p[k] - p[k - 1]).norm());
  const double at = t[1] + part * (t[2] - t[1]);
  const auto between = [&](const Vector3d& a, const Vector3d& b, double from, double to) {
    return Vector3d((to - at) / (to - from) * a + (at - from) / (to - from) * b);
  };
  const Vector3d a1 = between(p[0], p[1], t[0], t[1]), a2 = between(p[1], p[2], t[1], t[2]),
                 a3 = between(p[2], p[3], t[2], t[3]);
  return between(between(a1, a2, t[0], t[2]), between(a2, a3, t[1], t[3]), t[1], t[2]);
}

void make_smooth(FilePoints& points, bool is_closed) {
  SpaceLine line = points.points;
  const bool repeats = line.front() == line.back();
  if (is_closed && repeats) line.pop_back();
  const int count = static_cast<int>(line.size());
  if (count < 3) return;
  const int per = std::clamp(static_cast<int>(most_smooth_points / line.size()), 1, max_smooth_points);
  const auto corner = [&](int k) {
    if (is_closed) return line[(k + count) % count];
    if (k < 0) return Vector3d(2 * line[0] - line[1]);
    if (k >= count) return Vector3d(2 * line[count - 1] - line[count - 2]);
    return line[k];
  };
  FilePoints out{{}, {}, points.place};
  for (int k = 0; k < (is_closed ? count : count - 1); ++k)
    for (int part = 0; part < per; ++part) {
      const std::array<Vector3d, 4> near = {corner(k - 1), corner(k), corner(k + 1), corner(k + 2)};
      out.points.push_back(part == 0 ? line[k] : spline_point(near, static_cast<double>(part) / per));
      out.places.push_back(points.places[k]);
    }
  if (!is_closed || repeats) {
    out.points.push_back(points.points.back());
    out.places.push_back(points.places.back());
  }
  points.points = std::move(out.points);
  points.places = std::move(out.places);
}

void check_size(const FilePoints& points, double size_in_file) {
  const double size = model::box_of(points.points).sizes().maxCoeff();
  if (points.points.size() < 3 || (size >= min_size_mm && size <= max_size_mm)) return;
  throw InvalidInput("the points span " + number_text(size) + " mm. " +
                         advise_unit(size_in_file, usual_size_mm, usual_size_mm / 10, usual_size_mm * 10) +
                         ", or `units: mm` if the size is right",
                     points.place);
}

}  // namespace

std::string advise_on_noise(const SpaceLine& points) {
  if (points.size() < min_noisy_points) return {};
  const double length = length_of(points), size = size_of_line(points);
  double turn = 0;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) turn += turn_at(points, k);
  if (!(length > noisy_length * size && turn > noisy_turn * static_cast<double>(points.size() - 2)))
    return {};
  const double mean = length / static_cast<double>(points.size() - 1);
  const double window = noise_points * mean, digit = std::pow(10, std::floor(std::log10(window)));
  return "the points are noisy: their line is " + number_text(std::round(10 * length / size) / 10) +
         " times as long as their box. Give `smooth: " + number_text(digit * std::round(window / digit)) +
         "`, the mm along the line to average over";
}

void mend_points(FilePoints& points, const PointRequest& request, double size_in_file) {
  merge_repeated(points);
  if (request.checks_size) check_size(points, size_in_file);
  if (points.points.size() >= 3) {
    remove_spikes(points);
    if (request.is_closed) check_outline_end(points);
    if (request.average_mm > 0) average(points, request.average_mm, request.is_closed);
    if (request.smooth) make_smooth(points, request.is_closed);
  }
}

}  // namespace kinetix::targets
