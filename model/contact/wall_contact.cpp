#include "model/contact/wall_contact.hpp"

#include <cmath>
#include <tuple>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

/// Returns the plate from the vertex along `edge` (unit) over `length`.
OrientedBox plate(const Eigen::Vector3d& edge, const Eigen::Vector3d& up, double length, double slant,
                  const CellSize& size) {
  OrientedBox box;
  box.slant = slant;
  box.center = 0.5 * length * edge;
  box.axes << edge, up, edge.cross(up);
  box.half << length / 2, size.height_mm / 2, size.thickness_mm / 2;
  return box;
}

}  // namespace

std::vector<HalfWall> half_walls(const Linkage& structure) {
  std::vector<HalfWall> all;
  all.reserve(structure.plates.size());
  const double L = structure.size.edge_mm;
  for (const Plate& p : structure.plates)
    all.push_back({p.body, p.hinge, plate(p.edge, p.up, p.length * L, p.slant, structure.size)});
  return all;
}

OrientedBox placed(const HalfWall& wall, const Pose& pose) {
  return {pose.p + pose.R * wall.box.center, pose.R * wall.box.axes, wall.box.half, wall.box.slant};
}

namespace {

/// Returns the axes by extent of the points, longest first.
std::array<int, 3> axes_by_extent(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d extent = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] > extent[b]; });
  return axes;
}

}  // namespace

bool NearPairs::Entry::operator<(const Entry& other) const {
  return std::tie(stripe, along, index) < std::tie(other.stripe, other.along, other.index);
}

const std::vector<std::pair<int, int>>& NearPairs::find(const Eigen::Matrix3Xd& points, double distance) {
  pairs_.clear();
  entries_.clear();
  if (points.cols() == 0) return pairs_;
  const auto axes = axes_by_extent(points);
  for (int k = 0; k < points.cols(); ++k)
    entries_.push_back({std::floor(points(axes[0], k) / distance), points(axes[1], k), k});
  std::sort(entries_.begin(), entries_.end());
  std::size_t partner = 0;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    std::size_t next = k + 1;
    pair_up(k, next, entries_[k].stripe, points, distance);
    pair_up(k, partner, entries_[k].stripe + 1, points, distance);
  }
  return pairs_;
}

/// Pairs an entry with the entries of a stripe within the distance; `partner` advances to the first of these.
void NearPairs::pair_up(std::size_t first, std::size_t& partner, double stripe,
                        const Eigen::Matrix3Xd& points, double distance) {
  const Entry& entry = entries_[first];
  const auto before = [&](const Entry& e) {
    return e.stripe < stripe || (e.stripe == stripe && e.along < entry.along - distance);
  };
  while (partner < entries_.size() && before(entries_[partner])) ++partner;
  for (std::size_t k = partner; k < entries_.size(); ++k) {
    const Entry& other = entries_[k];
    if (other.stripe != stripe || other.along > entry.along + distance) break;
    if ((points.col(entry.index) - points.col(other.index)).squaredNorm() < distance * distance)
      pairs_.push_back(std::minmax(entry.index, other.index));
  }
}

namespace {

constexpr double depth_in_edges = 1e-9;  // cell edges: above rounding, far below any real overlap

/// Motion to one side of flat.
class Side {
 public:
  Side(WallContact& contact, const FoldFunction& fold, const ThetaRangeOptions& options, double sign)
      : contact_(contact), fold_(fold), options_(options), sign_(sign) {}

  ContactLimit run() {
    double free = 0;
    while (free < options_.limit) {
      const double next = std::min(free + options_.step, options_.limit);
      if (!is_finite(at(next))) return {sign_ * free, false, {}};
      const std::vector<WallPair> overlapping = contact_.overlapping(state_);
      if (!overlapping.empty()) return bisect(free, next, overlapping);
      free = next;
    }
    return {sign_ * options_.limit, false, {}};
  }

 private:
  const State& at(double angle) {
    fold_(sign_ * angle, state_);
    return state_;
  }

  /// Bisects the pairs that overlap at `hit`, and starts again with any others that overlap earlier.
  ContactLimit bisect(double free, double hit, std::vector<WallPair> pairs) {
    double low = free;
    while (hit - low > options_.precision) {
      const double middle = (low + hit) / 2;
      std::vector<WallPair> overlapping = contact_.overlapping(at(middle), pairs);
      (overlapping.empty() ? low : hit) = middle;
      if (!overlapping.empty()) pairs = std::move(overlapping);
    }
    const std::vector<WallPair> earlier = contact_.overlapping(at(low));
    if (!earlier.empty() && low > free) return bisect(free, low, earlier);
    return {sign_ * low, true, pairs.front(), sign_ * hit};
  }

  WallContact& contact_;
  const FoldFunction& fold_;
  const ThetaRangeOptions& options_;
  double sign_;
  State state_;
};

}  // namespace

WallContact::WallContact(const Linkage& structure)
    : walls_(half_walls(structure)), depth_(depth_in_edges * structure.size.edge_mm) {
  for (const HalfWall& wall : walls_) reach_ = std::max(reach_, 2 * (radius(wall.box) + depth_));
  const State flat = rest_state(structure);
  collect(flat, -depth_);
  std::sort(found_.begin(), found_.end());
  touching_at_rest_ = found_;
  const std::vector<WallPair> overlap = overlapping(flat, touching_at_rest_);
  if (!overlap.empty()) overlap_at_rest_ = overlap.front();
}

bool WallContact::can_touch(const WallPair& pair) const {
  const HalfWall& a = walls_[pair.first];
  const HalfWall& b = walls_[pair.second];
  return a.body != b.body && a.hinge != b.hinge;
}

void WallContact::collect(const State& state, double depth) {
  found_.clear();
  boxes_.resize(walls_.size());
  centers_.resize(3, walls_.size());
  for (std::size_t k = 0; k < walls_.size(); ++k) {
    boxes_[k] = placed(walls_[k], state[walls_[k].body]);
    centers_.col(k) = boxes_[k].center;
  }
  for (const auto& [first, second] : near_.find(centers_, reach_))
    if (can_touch({first, second}) && overlap(boxes_[first], boxes_[second], depth))
      found_.push_back({first, second});
}

const std::vector<WallPair>& WallContact::overlapping(const State& state) {
  collect(state, depth_);
  std::erase_if(found_, [&](const WallPair& pair) {
    return std::binary_search(touching_at_rest_.begin(), touching_at_rest_.end(), pair);
  });
  return found_;
}

std::vector<WallPair> WallContact::overlapping(const State& state,
                                               const std::vector<WallPair>& candidates) const {
  const auto box = [&](int wall) { return placed(walls_[wall], state[walls_[wall].body]); };
  std::vector<WallPair> found;
  for (const WallPair& pair : candidates)
    if (overlap(box(pair.first), box(pair.second), depth_)) found.push_back(pair);
  return found;
}

void ThetaRangeOptions::validate() const {
  if (!(limit > 0) || !(limit <= pi / 2))
    throw InvalidInput("the limit of the fold angle must lie in (0, 90] deg");
  if (!(step >= 1e-6)) throw InvalidInput("the step of the fold angle must be at least 1e-6 rad");
  if (!(precision >= 1e-14)) throw InvalidInput("the precision of the fold angle must be at least 1e-14 rad");
}

double closing_theta(const CellSize& size) { return std::atan(1 - size.thickness_mm / size.edge_mm); }

ContactRange theta_range(const Linkage& structure, const FoldFunction& fold,
                         const ThetaRangeOptions& options) {
  options.validate();
  WallContact contact(structure);
  return {Side(contact, fold, options, -1).run(), Side(contact, fold, options, 1).run(),
          contact.touching_at_rest()};
}

ContactRange theta_range(const Linkage& structure, const ExactMotion& exact,
                         const ThetaRangeOptions& options) {
  if (!exact) throw InvalidInput("the range of the fold angle is only known for mechanisms: " + exact.why);
  const FoldFunction along = [&](double theta, State& state) { state = exact.at(theta); };
  return theta_range(structure, along, options);
}

}  // namespace kinetix::model
