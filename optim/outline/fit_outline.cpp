#include "optim/outline/fit_outline.hpp"

#include <fmt/format.h>
#include <cmath>
#include <set>

#include "model/base/box.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/planar/exact_designs.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;
using model::LatticeCell;

constexpr std::size_t min_cells = 4;  // fewer form no shape
// Relative to the outline that just fills the rectangle. The pixels of a picture change most between these
// sizes.
constexpr double sizes[] = {1, 0.95, 1.05};
constexpr double shifts[] = {0, 0.5};  // of a column and of a row

}  // namespace

std::vector<std::vector<LatticeCell>> trimmed_cells(const model::PlanarLattice& lattice, double angle,
                                                    int columns, int rows, const targets::Outline& outline) {
  const Eigen::AlignedBox2d rectangle = model::lattice_box(lattice, columns, rows, angle),
                            drawn = model::box_of(outline.points());
  const double ratio = drawn.sizes().cwiseQuotient(rectangle.sizes()).maxCoeff();
  const model::LatticePitch pitch = model::lattice_pitch(lattice, angle);
  std::vector<std::vector<LatticeCell>> found;
  std::set<std::vector<LatticeCell>> known;
  for (const double size : sizes)
    for (const double i_shift : shifts)
      for (const double j_shift : shifts) {
        const double scale = ratio / size;  // mm of the outline per cell edge
        const Vector2d at = rectangle.center() + i_shift * pitch.column + j_shift * pitch.row;
        auto cells = model::cut_cells(lattice, columns, rows, angle, [&](const Vector2d& middle) {
          return outline.contains(drawn.center() + scale * (middle - at));
        });
        if (cells.size() >= min_cells && known.insert(cells).second) found.push_back(std::move(cells));
      }
  return found;
}

namespace {

constexpr double less_sliding =
    0.8;  // factor per round of the turning of walls that met: the most rounds leave a seventh
constexpr double less_scaling = 0.93;   // factor per round of their offsets: cells that shrink close sooner
constexpr double other_scaling = 0.98;  // factor of the offsets of the other walls round their cells
constexpr double less_uneven = 0.8;  // exponent per round of the walls' length ratios, if the flat panel is
                                     // free
// Rounds: these leave an eighth of the turning. A free flat panel has more degrees of freedom to make room.
constexpr int max_rounds_apart = 9, most_of_free_panels = 12;
// Cell edges, of flat walls if they are free: beyond, cells have no room or plates are all wall.
constexpr double longest = 1.4;
constexpr double turn_margin = 0.3 * radians_per_degree;  // rad: walls stay apart a little beyond theta
constexpr double met_early[] = {0.4, 0.6, 0.75, 0.9, 1};  // of theta: states at which walls are checked
constexpr int halvings = 2;        // of the interval from the best theta to the next larger one that was
                                   // tried
constexpr double at_bound = 0.98;  // of the bound: counts as being at it
// Cell edges: a smaller offset is within ten times the search's tolerance of its bounds (1e-6).
constexpr double min_offset = 1e-5;

void validate(const OutlineOptions& o) {
  require("theta", o.theta[0], o.theta[0] > 0 && o.theta[0] <= o.theta[1],
          "above 0, and not above the upper end");
  require("theta", o.theta[1], o.theta[1] < pi / 2, "below pi/2 rad");
  require("offset", o.offset, o.offset >= 0 && o.offset < 0.5, "in [0, 0.5) cell edges");
  require("t", o.t[0], o.t[0] > 0 && o.t[0] < 0.5, "in (0, 0.5)");
  require("t", o.t[1], o.t[1] > 0.5 && o.t[1] < 1, "in (0.5, 1)");
  require("thetas", o.thetas, o.thetas >= 1, "at least 1");
}

/// Replaces the panel by the nearest one that moves with all hinges on their walls. The search satisfies
/// bounds of 0 only approximately, but cells close exactly or not at all.
void put_on_walls(OutlineDesign& found) {
  place_hinges(found.y, found.panel);
  for (model::HingeParameters& hinge : found.panel.hinges) hinge.offset = 0;
  found.panel = nearest_exact(std::move(found.panel));
  found.y = model::parallel_drawing_of(found.panel).y;
}

std::vector<Vector2d> corners(const std::vector<int>& rim, const std::vector<Vector2d>& places,
                              double scale) {
  std::vector<Vector2d> out;
  for (const int v : rim) out.push_back(scale * places[v]);
  return out;
}

bool is_better(const OutlineDesign& a, const OutlineDesign& b) {
  if (a.clear != b.clear) return a.clear;
  return a.error.rms + a.flat.rms < b.error.rms + b.flat.rms;
}

/// Search at one theta.
class BoundarySearch {
 public:
  BoundarySearch(const model::PlanarStructure& panel, const targets::Outline& folded,
                 const targets::Outline* flat, const OutlineOptions& options, double theta)
      : panel_(panel), on_walls_(options.offset < min_offset) {
    problem_.panel = &panel_;
    problem_.rim = outer_boundary(panel.graph).vertices;
    problem_.folded = &folded;
    problem_.flat = flat;
    problem_.flat_scale = panel.size.edge_mm;
    problem_.theta = theta;
    problem_.stop = options.stop;
    problem_.symmetries = find_symmetries(panel, folded, flat);
    const double shift = 2 * std::min(0.5 - options.t[0], options.t[1] - 0.5);
    problem_.bounds.shift.assign(panel.graph.edges.size(), shift);
    limit_.assign(panel.graph.edges.size(), on_walls_ ? 0 : options.offset);
    if (flat) problem_.bounds.stretch.assign(panel.graph.edges.size(), longest);
  }

  /// @param given shape at which the search starts, which is the result if no better one is found. Null: the panel as it
  /// is
  OutlineDesign run(const OutlineShape* given) {
    given ? start(*given) : start();
    OutlineDesign found, first;
    if (given) first = take_as_given();
    const int most = problem_.flat ? most_of_free_panels : max_rounds_apart;
    for (bool again = false;; again = true) {
      bound_offsets();
      const OutlineProgress now = improve(problem_, shape_, !given && !again, again, memory_);
      found.rounds += now.rounds;
      found.settled = now.settled;
      take(found);
      const std::set<int> met = walls_that_meet(found);
      found.clear = met.empty();
      if (found.clear || problem_.stop.stop_requested() || ++found.clearance_rounds >= most) break;
      tighten(met);
    }
    judge(found);
    if (!given || !is_better(first, found)) return found;
    first.rounds = found.rounds;
    first.clearance_rounds = found.clearance_rounds;
    return first;
  }

 private:
  OutlineDesign take_as_given() {
    OutlineDesign out;
    bound_offsets();
    take(out);
    out.clear = walls_that_meet(out).empty();
    judge(out);
    return out;
  }

  void start(const OutlineShape& given) {
    shape_ = given;
    if (!problem_.flat) shape_.flat = panel_.graph.vertices;
  }

  void start() {
    shape_.flat = panel_.graph.vertices;
    const double c = std::cos(problem_.theta);
    const double size = signed_area(corners(problem_.rim, shape_.flat, c));
    shape_.scale = std::sqrt(problem_.folded->area() / size);
    if (problem_.flat) suit_flat();
    for (const Vector2d& x : shape_.flat) shape_.folded.push_back(c * x);
    centre(shape_.folded, problem_.folded->middle() / shape_.scale);
  }

  /// Scales the flat panel to the size of its outline and centres it there.
  void suit_flat() {
    const double size = signed_area(corners(problem_.rim, shape_.flat, problem_.flat_scale));
    const double factor = std::sqrt(problem_.flat->area() / size);
    for (Vector2d& x : shape_.flat) x *= factor;
    centre(shape_.flat, problem_.flat->middle() / problem_.flat_scale);
  }

  static void centre(std::vector<Vector2d>& places, const Vector2d& at) {
    Vector2d low = places[0], high = places[0];
    for (const Vector2d& p : places) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    for (Vector2d& p : places) p += at - (low + high) / 2;
  }

  void bound_offsets() {
    problem_.bounds.offset.clear();
    for (const model::GraphEdge& e : panel_.graph.edges)
      problem_.bounds.offset.push_back(std::min(
          limit_[problem_.bounds.offset.size()] / (shape_.flat[e.to] - shape_.flat[e.from]).norm(), 0.49));
  }

  /// Stores the present panel. It makes y a little smaller, so that bounds are satisfied to the last bit.
  void take(OutlineDesign& found) {
    found.panel = panel_;
    found.panel.graph.vertices = shape_.flat;
    if (problem_.flat) found.panel.drawn = {};
    found.y = parallel_drawing_of(shape_, problem_.theta);
    if (on_walls_) put_on_walls(found);
    double excess = 1;
    for (int e = 0; e < static_cast<int>(panel_.graph.edges.size()); ++e) {
      const model::WallChange change = change_of(found.panel, found.y, e);
      excess = std::max({excess, std::abs(change.s) / problem_.bounds.shift[e],
                         problem_.bounds.offset[e] > 0 ? std::abs(change.o) / problem_.bounds.offset[e] : 1});
    }
    for (Vector2d& y : found.y) y /= excess;
    place_hinges(found.y, found.panel);
    if (on_walls_)
      for (model::HingeParameters& hinge : found.panel.hinges) hinge.offset = 0;
    found.theta = problem_.theta;
    found.scale = shape_.scale;
  }

  std::set<int> walls_that_meet(const OutlineDesign& found) const {
    const model::Linkage linkage = found.panel;
    model::WallContact contact(linkage);
    std::set<int> met;
    const auto add = [&](const std::vector<model::WallPair>& pairs) {
      for (const model::WallPair& pair : pairs)
        for (const int plate : {pair.first, pair.second}) met.insert(plate / 2);
    };
    // A free flat panel has walls that touch at sharp corners with hinges near them.
    if (problem_.flat) add(contact.touching_at_rest());
    for (const double part : met_early) {
      const double theta = part == 1 ? problem_.theta + turn_margin : part * problem_.theta;
      add(contact.overlapping(fold(found.panel, found.y, theta)));
    }
    return met;
  }

  /// Relaxes the walls that met, since narrow cells close soonest. The walls round their cells also become
  /// more equal in length: they scale less, and differ less in the flat panel if that is free.
  void tighten(std::set<int> met) {
    for (const PanelSymmetry& symmetry : problem_.symmetries)
      for (const int e : std::vector<int>(met.begin(), met.end())) met.insert(symmetry.edges[e]);
    for (const int e : met) problem_.bounds.shift[e] *= less_sliding;
    const std::set<int> round = round_cells_of(met);
    for (const int e : round) limit_[e] *= met.contains(e) ? less_scaling : other_scaling;
    if (!problem_.flat) return;
    for (const int e : round) problem_.bounds.stretch[e] = std::pow(problem_.bounds.stretch[e], less_uneven);
  }

  /// Returns the walls round the cells that these walls bound.
  std::set<int> round_cells_of(const std::set<int>& met) const {
    std::set<int> walls;
    for (const model::GraphFace& face : panel_.faces)
      if (std::any_of(face.edges.begin(), face.edges.end(), [&](int e) { return met.contains(e); }))
        walls.insert(face.edges.begin(), face.edges.end());
    return walls;
  }

  void judge(OutlineDesign& found) const {
    const model::State state = fold(found.panel, found.y, problem_.theta);
    std::vector<Vector2d> rim;
    for (const int v : problem_.rim) rim.push_back(shape_.scale / panel_.size.edge_mm * state[v].p.head<2>());
    const Vector2d shift = shape_.scale * shape_.folded[problem_.rim[0]] - rim[0];
    for (Vector2d& p : rim) p += shift;
    found.origin = -shift / shape_.scale;
    found.error = outline_error(*problem_.folded, rim);
    if (problem_.flat)
      found.flat = outline_error(*problem_.flat, corners(problem_.rim, shape_.flat, problem_.flat_scale));
    const int walls = static_cast<int>(panel_.graph.edges.size());
    for (int e = 0; e < walls; ++e) {
      const model::WallChange change = change_of(found.panel, found.y, e);
      found.shift = std::max(found.shift, std::abs(change.s));
      found.offset = std::max(found.offset, std::abs(found.panel.hinges[e].offset));
      found.at_bounds_shift += std::abs(change.s) >= at_bound * problem_.bounds.shift[e];
      found.at_bounds_offset += std::abs(change.o) >= at_bound * problem_.bounds.offset[e];
    }
    found.at_bounds_shift /= walls;
    found.at_bounds_offset /= walls;
    found.shape = shape_;
  }

  const model::PlanarStructure& panel_;
  bool on_walls_;  ///< no hinge may be off its wall
  OutlineProblem problem_;
  OutlineShape shape_;
  std::vector<double> limit_;  ///< largest offset of each wall, cell edges
  BoxLeastSquaresMemory memory_;
};

}  // namespace

OutlineDesign fit_outline(const model::PlanarStructure& panel, const targets::Outline& folded,
                          const targets::Outline* flat, const OutlineOptions& options,
                          const Progress& progress) {
  validate(options);
  OutlineDesign best;
  std::set<double> tried;
  int rounds = 0;
  const int thetas = options.start ? 1 : options.thetas;
  const auto found_at = [&](double theta) {
    return BoundarySearch(panel, folded, flat, options, theta).run(options.start);
  };
  const auto take = [&](OutlineDesign found) {
    const double theta = found.theta;
    rounds += found.rounds;
    if (tried.empty() || is_better(found, best)) best = std::move(found);
    tried.insert(theta);
    progress("search", static_cast<double>(tried.size()) / (thetas + halvings),
             fmt::format("fold angle {} of at most {}, best {:.2g} of the diagonal off", tried.size(),
                         thetas + halvings, best.error.rms));
  };
  // Starts with the largest theta: the more a panel is folded the more its boundary can change, until walls
  // meet.
  const auto theta_of = [&](int k) {
    const double part = thetas == 1 ? 0 : static_cast<double>(k) / (thetas - 1);
    return options.theta[1] + part * (options.theta[0] - options.theta[1]);
  };
  // Several threads try some thetas ahead. Their results are not reported if the search ends before them.
  bool ends = false;
  for (int first = 0, now; first < thetas && !ends; first += now) {
    now = std::min(model::threads_of(options.threads), thetas - first);
    std::vector<OutlineDesign> found(now);
    model::run_in_parallel(now, now, [&](int k) { found[k] = found_at(theta_of(first + k)); });
    for (int k = 0; k < now && !ends; ++k) {
      take(std::move(found[k]));
      ends = options.stop.stop_requested() || (best.clear && best.theta > theta_of(first + k));
    }
  }
  for (int k = 0; k < halvings && best.clear && best.theta < *tried.rbegin(); ++k) {
    if (options.stop.stop_requested()) break;
    take(found_at((best.theta + *tried.upper_bound(best.theta)) / 2));
  }
  best.rounds = rounds;
  best.stopped = options.stop.stop_requested();
  return best;
}

}  // namespace kinetix::optim
