#include "app/print/sheet/print_path.hpp"

#include <fmt/format.h>

#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/physics.hpp"
#include "app/print/sheet/fold_motion.hpp"
#include "model/elastic/path/equilibrium_path.hpp"

namespace kinetix::app {
namespace {

constexpr double reported_mm = 0.01;  // mm: no printer resolves a smaller difference of folds
constexpr double known_mm = 0.005;    // mm: required accuracy of a path between its states
constexpr int max_rounds = 3;         // of halving the steps of a path that is less accurate

PrintPath exact_path(const Design& design, const model::ExactMotion& exact, PrintPath path) {
  const double theta = exact_theta_of(design, exact);
  if (theta == 0) {
    path.flat_only_reason = "the fold angle of the design is 0";
    return path;
  }
  for (int k = 1; k <= path_steps; ++k) {
    path.thetas.push_back(theta * k / path_steps);
    path.states.push_back(exact.at(path.thetas.back()));
  }
  path.turns = turn_laws(design.structure);
  path.motion = [at = exact.at, edge = design.structure.size().edge_mm](double there) {
    return with_edge({at(there)}, 1 / edge).front();
  };
  return path;
}

model::EquilibriumPathOptions steps_of(const Design& design, int steps) {
  model::EquilibriumPathOptions options;
  options.side = design.side;
  options.longest_step = std::clamp(std::abs(design.theta) / steps, options.min_step, options.longest_step);
  options.first_step = std::min(options.first_step, options.longest_step);
  options.longest_step_touching = std::min(options.longest_step_touching, options.longest_step);
  return options;
}

/// Returns the indices of the states just before a snap.
std::vector<int> jumps_of(const model::EquilibriumPath& traced, const std::vector<double>& thetas) {
  std::vector<int> out;
  for (const model::PathEvent& event : traced.events) {
    if (event.kind != model::PathEvent::Kind::snap) continue;
    const auto at = std::find(thetas.begin(), thetas.end(), event.at.theta);
    if (at != thetas.end() && at != thetas.begin()) out.push_back(static_cast<int>(at - thetas.begin()) - 1);
  }
  return out;
}

/// Traces the equilibrium at steps as even as the path allows.
PrintPath traced_path(const Design& design, const model::ExactMotion& exact, int steps, PrintPath path) {
  const model::EquilibriumPath traced = trace_equilibrium(
      {design.structure, drive_of(design), exact}, elasticity_of(design), steps_of(design, steps),
      [&](const model::EquilibriumStep& step, const model::State& state) {
        if (step.theta == path.thetas.back()) return;
        path.thetas.push_back(step.theta);
        path.states.push_back(state);
      });
  path.is_exact = false;
  path.jumps = jumps_of(traced, path.thetas);
  if (traced.stop == model::EquilibriumPath::Stop::reached) return path;
  path.thetas.resize(1);
  path.states.resize(1);
  path.jumps.clear();
  path.flat_only_reason = exact.why + ", and its equilibrium does not reach it: " + traced.why;
  return path;
}

PrintPath equilibrium_path(const Design& design, const model::ExactMotion& exact, const PrintPath& flat) {
  int steps = path_steps;
  PrintPath path = traced_path(design, exact, steps, flat);
  for (int round = 0; round < max_rounds && sampling_error_mm(path, design.structure) > known_mm; ++round) {
    PrintPath finer = traced_path(design, exact, steps *= 2, flat);
    if (finer.states.size() <= path.states.size()) break;
    path = std::move(finer);
  }
  return path;
}

constexpr double file_rounding_mm = 1e-3;  // mm: files have floats, and beds are not known better
constexpr int halvings = 40;               // of a width: from any bed to less than a rounding of files

using PrintBoxes = std::vector<Eigen::AlignedBox2d>;

bool is_held(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm) {
  return ((bed_mm - size_mm).array() >= -file_rounding_mm).all();
}

Eigen::Vector2d rotated_by_quarter(const Eigen::Vector2d& bed_mm) { return bed_mm.reverse(); }

/// Boxes along one axis, in one part after the other. Filling from the lower end gives the fewest parts.
class BoxesInARow {
 public:
  BoxesInARow(const PrintBoxes& boxes, int axis) : boxes_(boxes), axis_(axis) {
    for (int b = 0; b < static_cast<int>(boxes.size()); ++b)
      if (!boxes[b].isEmpty()) order_.push_back(b);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return low(a) < low(b); });
  }

  /// Returns the part of each box. No part is wider than room_mm.
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

  /// Returns the part of each box, with as few parts as possible, about equally wide.
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

/// Checks whether the bed should be turned: only then it holds each body, or the sheet takes fewer tiles.
/// @throws BedTooSmall if it does not hold each body either way
bool is_better_turned(const PrintBoxes& boxes, const Eigen::Vector2d& bed_mm) {
  const auto tiles_of = [&](const Eigen::Vector2d& bed) {
    return BoxesInARow::count(BoxesInARow(boxes, 0).filled(bed.x())) *
           BoxesInARow::count(BoxesInARow(boxes, 1).filled(bed.y()));
  };
  const Eigen::Vector2d other = rotated_by_quarter(bed_mm);
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

PrintPath print_path(const Design& design) {
  const model::Linkage linkage = design.structure;
  const model::ExactMotion exact = exact_motion(design.structure);
  PrintPath path{{0}, {rest_state(linkage)}};
  path = exact ? exact_path(design, exact, std::move(path)) : equilibrium_path(design, exact, path);
  path.states = with_edge(std::move(path.states), 1 / design.structure.size().edge_mm);
  return path;
}

std::optional<std::string> equilibrium_beside_exact(const Design& design, double edge_mm) {
  const model::ExactMotion exact = exact_motion(design.structure);
  if (!exact || design.hinge.model != HingeSection::Model::elastic) return std::nullopt;
  model::EquilibriumPathOptions options;
  options.side = design.side;
  const model::EquilibriumPath traced =
      trace_equilibrium({design.structure, drive_of(design), exact}, elasticity_of(design), options);
  const std::string start = "folded along its analytic motion: the equilibrium of its elastic hinges ";
  if (traced.stop != model::EquilibriumPath::Stop::reached)
    return start + "does not get there: " + traced.why;
  const model::State fold = exact.at(exact_theta_of(design, exact));
  const double away_mm = edge_mm * aligned_distance(design.structure, traced.state, fold).max;
  if (away_mm < reported_mm) return std::nullopt;
  return start + fmt::format("under its drive is up to {:.3g} mm from that", away_mm);
}

std::vector<model::State> with_edge(std::vector<model::State> states, double edge_mm) {
  for (model::State& state : states)
    for (model::Pose& pose : state) pose.p *= edge_mm;
  return states;
}

bool fits_on_bed(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm) {
  return is_held(size_mm, bed_mm) || is_held(size_mm, rotated_by_quarter(bed_mm));
}

Tiles cut_into_tiles(const std::vector<Eigen::AlignedBox2d>& boxes, const Eigen::Vector2d& bed_mm) {
  Tiles tiles;
  tiles.bed_mm = bed_mm;
  tiles.turned = is_better_turned(boxes, bed_mm);
  const Eigen::Vector2d bed = tiles.turned ? rotated_by_quarter(bed_mm) : bed_mm;
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
