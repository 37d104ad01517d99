#include "app/goals/outline/outline_search.hpp"

#include "model/base/parallel_runs.hpp"
#include "optim/outline/outline_problem.hpp"

namespace kinetix::app {
namespace {

constexpr int max_tried_cells = 1500;  // larger panels try one cut only: a search takes seconds
constexpr double same_size = 1e-3;     // ratio: with less difference, walls and offsets match the search
constexpr std::size_t max_cuts = 12;   // cuts that are fitted: as many as one orientation has
constexpr double as_good = 0.01;       // ratio of errors: mirror images differ by less
constexpr double as_near = 1.01;       // ratio of errors of a panel and one with larger cells
// Columns or rows of panels with larger cells whose shapes are starts. The last one starts all larger panels.
constexpr int start_sides[] = {8, 12, 16, 20};
// Rounding step of a cut's error, ratio. Cuts that are rotations of each other get equal errors, so their order does
// not depend on the orientation of the drawing.
constexpr double same_miss = 1e-6;

/// Orientation of the outline on the lattice, with a cut of the panel.
struct Lay {
  double turn = 0;  ///< rotation of the outline, rad
  Cells cells;
  double miss = 0;  ///< error of the boundary as a ratio to the tolerances; 2: both are just met
};

/// Returns the best candidate, the first of those within as_good: rounding does not choose between mirror images.
const Lay& best_of(const std::vector<Lay>& lays) {
  const Lay* best = &lays.front();
  for (const Lay& lay : lays)
    if (lay.miss < (1 - as_good) * best->miss) best = &lay;
  return *best;
}

class OutlineSearch {
 public:
  OutlineSearch(const OutlineFile& file, const RunOptions& run)
      : file_(file), run_(run), folded_(file.folded), flat_(file.flat) {}

  FoundOutline find() {
    FoundOutline found;
    if (flat_) turn_flat(find_turn_of_flat());
    const Lay lay = file_.trims ? best_cut(found.cuts) : best_turn();
    const int cuts = found.cuts;
    found = fitted(lay, edge_of(file_, lay.cells), nullptr);
    found.cuts = cuts;
    return found;
  }

  /// Finds a design that starts at the shape of one with larger cells.
  FoundOutline refine(const FoundOutline& coarse) {
    if (flat_) turn_flat(coarse.flat_turn);
    const Lay lay = {coarse.turn, file_.trims ? cells_within(file_, panel_of(coarse.cells, coarse.edge_mm),
                                                             ratio_to(coarse))
                                              : model::lattice_cells(file_.columns, file_.rows)};
    const bool is_open = !file_.cell_mm && !file_.flat;
    return fitted(lay, is_open ? ratio_to(coarse) * coarse.design.scale : edge_of(file_, lay.cells), &coarse);
  }

  /// Returns whether a design is farther from the outlines than a panel with larger cells, or its walls collide.
  static bool is_worse(const FoundOutline& found, const FoundOutline& coarse) {
    const optim::OutlineDesign &design = found.design, &other = coarse.design;
    return !design.clear || (other.clear && (design.error.rms > as_near * other.error.rms ||
                                             design.flat.rms > as_near * other.flat.rms));
  }

  /// Returns whether the first design is better. The goal counts first, then a panel with larger cells, which should not
  /// be nearer to the outlines, and then the distance from them.
  bool is_better(const FoundOutline& a, const FoundOutline& b, const FoundOutline& coarse) const {
    const auto rank = [&](const FoundOutline& found) {
      return found.design.clear + 2 * is_met(file_, found.design) + (is_worse(found, coarse) ? 0.0 : 0.5);
    };
    const double rank_a = rank(a), rank_b = rank(b);
    return rank_a != rank_b ? rank_a > rank_b : miss(a.design) < (1 - as_good) * miss(b.design);
  }

 private:
  /// Returns whether walls and offsets have the same ratio to both cell edges. A search then finds the same design.
  bool same_in_edges(double a, double b) const {
    const auto near = [](double x, double y) { return std::abs(x - y) <= same_size * std::abs(x); };
    return near(file_.size(a).thickness_mm / a, file_.size(b).thickness_mm / b) &&
           near(file_.offset(a), file_.offset(b));
  }

  optim::OutlineOptions options_of(double edge_mm) const {
    optim::OutlineOptions options;
    options.theta = file_.theta;
    options.offset = file_.offset(edge_mm);
    options.t = file_.t;
    options.threads = run_.threads;
    options.stop = run_.stop;
    return options;
  }

  void turn_flat(double turn) {
    flat_turn_ = turn;
    flat_ = targets::turned(*file_.flat, turn);
  }

  /// Returns the cell edges of a coarser panel per cell edge of this one.
  double ratio_to(const FoundOutline& coarse) const {
    return static_cast<double>(std::max(coarse.columns, coarse.rows)) / std::max(file_.columns, file_.rows);
  }

  /// Fits hinges and theta of a cut. @param edge_mm first cell edge   @param coarse start; null: none
  FoundOutline fitted(const Lay& lay, double edge_mm, const FoundOutline* coarse) {
    FoundOutline found;
    found.cells = lay.cells;
    found.columns = file_.columns;
    found.rows = file_.rows;
    found.turn = lay.turn;
    found.flat_turn = flat_turn_;
    folded_ = targets::turned(file_.folded, lay.turn);
    double fitted_edge_mm = edge_mm;
    bool is_same = false;
    for (int pass = 0; pass < 3 && !is_same && !found.design.stopped; ++pass) {
      const model::PlanarStructure panel = panel_of(lay.cells, fitted_edge_mm);
      optim::OutlineDesign design =
          coarse ? fit_from(*coarse, panel) : fit(panel, options_of(fitted_edge_mm));
      if (pass > 0 && design.stopped) {  // an interrupted pass is worse than the one before it
        found.design.stopped = true;
        break;
      }
      found.design = std::move(design);
      edge_mm = fitted_edge_mm;
      if (!file_.flat && !file_.cell_mm) fitted_edge_mm = found.design.scale;
      is_same = same_in_edges(edge_mm, fitted_edge_mm);
    }
    // After a stop, walls and offsets belong to the edge with which the design was fitted.
    found.edge_mm = found.design.stopped && !is_same ? edge_mm : fitted_edge_mm;
    place(found.edge_mm, lay.cells, found);
    return found;
  }

  optim::OutlineDesign fit_from(const FoundOutline& coarse, const model::PlanarStructure& panel) const {
    const optim::OutlineShape start =
        refined_shape(panel_of(coarse.cells, coarse.edge_mm), coarse.design.shape, panel);
    optim::OutlineOptions options = options_of(panel.size.edge_mm);
    options.theta = {coarse.design.theta, coarse.design.theta};
    options.start = &start;
    return fit(panel, options);
  }

  optim::OutlineDesign fit(const model::PlanarStructure& panel, const optim::OutlineOptions& options) const {
    return fit_outline(panel, folded_, flat_ ? &*flat_ : nullptr, options, run_.progress);
  }

  /// Returns the turn of the flat outline with which the rectangle at rest is nearest to it, rad.
  double find_turn_of_flat() const {
    std::vector<Lay> lays;
    for (const double turn : turns_of(*file_.flat, 4))
      lays.push_back({turn, model::lattice_cells(file_.columns, file_.rows)});
    measure_at_rest(*file_.flat, lays);
    return best_of(lays).turn;
  }

  /// Chooses the turn of a rectangle. Turns are fitted at the largest theta, or compared at rest for large panels.
  Lay best_turn() const {
    std::vector<Lay> lays;
    for (const double turn : turns_of(file_.folded, flat_ ? 8 : 4))
      lays.push_back({turn, model::lattice_cells(file_.columns, file_.rows)});
    if (lays.size() == 1) return lays.front();
    if (file_.columns * file_.rows > max_tried_cells)
      measure_at_rest(file_.folded, lays);
    else
      measure_folded(lays);
    return best_of(lays);
  }

  /// Chooses the cut of the lattice. The cuts nearest to the outline at rest are fitted at the largest theta, and the
  /// best of them is returned. @param count set to the number of cuts tried
  Lay best_cut(int& count) const {
    std::vector<Lay> lays;
    for (const double turn : turns_of(file_.folded, 4))
      for (Cells& cells : cuts_of(file_, targets::turned(file_.folded, turn)))
        lays.push_back({turn, std::move(cells)});
    if (lays.size() > max_cuts || file_.columns * file_.rows > max_tried_cells) {
      measure_at_rest(file_.folded, lays);
      for (Lay& lay : lays) lay.miss = std::round(lay.miss / same_miss) * same_miss;
      std::stable_sort(lays.begin(), lays.end(), [](const Lay& a, const Lay& b) { return a.miss < b.miss; });
      const auto is_same = [](const Lay& a, const Lay& b) {
        return a.cells.size() == b.cells.size() && a.miss == b.miss;
      };
      lays.erase(std::unique(lays.begin(), lays.end(), is_same), lays.end());
      lays.resize(
          std::min<std::size_t>(lays.size(), file_.columns * file_.rows > max_tried_cells ? 1 : max_cuts));
    }
    count = static_cast<int>(lays.size());
    if (count > 1) measure_folded(lays);
    return best_of(lays);
  }

  double miss(const targets::OutlineError& error) const {
    const double shared = std::isfinite(error.iou) ? error.iou : 0;
    return error.rms / file_.shape_tolerance + (1 - shared) / (1 - std::min(0.99, file_.iou_tolerance));
  }

  void measure_at_rest(const targets::Outline& outline, std::vector<Lay>& lays) const {
    model::run_in_parallel(static_cast<int>(lays.size()), run_.threads, [&](int k) {
      lays[k].miss = miss_or_none([&] {
        const targets::Outline laid = targets::turned(outline, lays[k].turn);
        return miss(outline_error(laid, boundary_over(laid, panel_of(lays[k].cells, 1))));
      });
    });
  }

  void measure_folded(std::vector<Lay>& lays) const {
    model::run_in_parallel(static_cast<int>(lays.size()), run_.threads,
                           [&](int k) { lays[k].miss = miss_or_none([&] { return miss_folded(lays[k]); }); });
  }

  /// Returns the measured error, or infinity for cells that do not make a panel.
  template <class Measure>
  static double miss_or_none(const Measure& measure) {
    try {
      return measure();
    } catch (const InvalidInput&) {
      return std::numeric_limits<double>::infinity();
    }
  }

  model::PlanarStructure panel_of(const Cells& cells, double edge_mm) const {
    return planar_structure(make_sheet(file_.lattice, cells, file_.size(edge_mm)));
  }

  double miss_folded(const Lay& lay) const {
    const double edge_mm = edge_of(file_, lay.cells);
    optim::OutlineOptions options = options_of(edge_mm);
    options.theta[0] = options.theta[1];
    options.thetas = 1;
    options.threads = 1;
    const optim::OutlineDesign design =
        fit_outline(panel_of(lay.cells, edge_mm), targets::turned(file_.folded, lay.turn),
                    flat_ ? &*flat_ : nullptr, options);
    return miss(design);
  }

  double miss(const optim::OutlineDesign& design) const {
    return miss(design.error) + (flat_ ? miss(design.flat) : 0) + (design.clear ? 0 : 10);
  }

  /// Writes the hinges into the sheet. Offsets pass through mm, so that they equal those read back from a file.
  void place(double edge_mm, const Cells& cells, FoundOutline& found) const {
    const model::CellSize size = file_.size(edge_mm);
    const auto in_mm = [edge_mm](double offset) { return offset * edge_mm / edge_mm; };
    if (file_.flat) {
      model::PlanarStructure panel = found.design.panel;
      panel.size = size;
      found.sheet = std::move(panel);
    } else {
      found.sheet = make_sheet(file_.lattice, cells, size);
    }
    for (int h = 0; h < found.sheet.hinges(); ++h) {
      model::HingeParameters& hinge = found.sheet.hinge(h);
      hinge = found.design.panel.hinges[h];
      hinge.offset = in_mm(hinge.offset);
    }
  }

  const OutlineFile& file_;
  const RunOptions& run_;
  targets::Outline folded_;               ///< turned onto the panel
  std::optional<targets::Outline> flat_;  ///< turned onto the panel
  double flat_turn_ = 0;                  ///< rotation of the flat outline, rad
};

}  // namespace

bool is_met(const OutlineFile& file, const optim::OutlineDesign& design) {
  const auto meets = [&](const targets::OutlineError& error) {
    return error.rms <= file.shape_tolerance && error.iou >= file.iou_tolerance;
  };
  return design.clear && meets(design.error) && (!file.flat || meets(design.flat));
}

OutlineFile with_cells(OutlineFile file, int side) {
  const double share = static_cast<double>(side) / std::max(file.columns, file.rows);
  file.columns = std::max(1, static_cast<int>(std::lround(share * file.columns)));
  file.rows = std::max(1, static_cast<int>(std::lround(share * file.rows)));
  for (std::optional<double>* mm : {&file.cell_mm, &file.thickness_mm, &file.height_mm, &file.offset_mm})
    if (*mm) **mm /= share;
  return file;
}

namespace {

/// Returns empty if the cells along the coarser panel make no panel, or after a stop.
std::optional<FoundOutline> refine(const OutlineFile& file, const RunOptions& options,
                                   const FoundOutline& coarse) try {
  FoundOutline found = OutlineSearch(file, options).refine(coarse);
  return found.design.stopped ? std::nullopt : std::optional(std::move(found));
} catch (const InvalidInput&) {
  return std::nullopt;
}

/// Searches again from the shape of a coarser panel, and returns the better design. @param found without such a start;
/// empty: searched only if the refined panel is worse than the coarser one   @param coarse null: none
FoundOutline search_again(const OutlineFile& file, const RunOptions& options,
                          std::optional<FoundOutline> found, const FoundOutline* coarse) {
  std::optional<FoundOutline> refined;
  if (coarse && !(found && found->design.stopped)) refined = refine(file, options, *coarse);
  if (!found && refined && !OutlineSearch::is_worse(*refined, *coarse)) return *refined;
  if (!found) found = OutlineSearch(file, options).find();
  if (!refined || !OutlineSearch(file, options).is_better(*refined, *found, *coarse)) return *found;
  refined->cuts = found->cuts;
  return *refined;
}

/// Searches panels with fewer cells. Empty if there are none, or after a stop.
std::optional<FoundOutline> search_coarse(const OutlineFile& file, const RunOptions& options) {
  RunOptions silent;
  silent.threads = options.threads;
  silent.seed = options.seed;
  silent.stop = options.stop;
  std::optional<FoundOutline> coarse;
  for (const int side : start_sides) {
    if (side >= std::max(file.columns, file.rows)) break;
    try {
      const OutlineFile fewer = with_cells(file, side);
      coarse = search_again(fewer, silent, search_alone(fewer, silent), coarse ? &*coarse : nullptr);
    } catch (const InvalidInput&) {
      coarse.reset();  // too few cells for the outline, or for their walls
    }
    if (options.stop.stop_requested()) return std::nullopt;
  }
  return coarse;
}

}  // namespace

FoundOutline search_alone(const OutlineFile& file, const RunOptions& options) {
  return OutlineSearch(file, options).find();
}

FoundOutline search_outline(const OutlineFile& file, const RunOptions& options) {
  // A whole rectangle of many cells is seldom better than a refined one, and takes longest.
  const bool is_large = !file.trims && std::max(file.columns, file.rows) > std::end(start_sides)[-1];
  std::optional<FoundOutline> found;
  if (!is_large) found = search_alone(file, options);
  if (found && found->design.stopped) return *found;
  const std::optional<FoundOutline> coarse = search_coarse(file, options);
  return search_again(file, options, std::move(found), coarse ? &*coarse : nullptr);
}

}  // namespace kinetix::app
