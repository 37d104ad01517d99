#include "app/goals/outline/search_outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/base/polygon.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/planar/lattices/rhombus.hpp"
#include "optim/outline/trimmed_cells.hpp"
#include "targets/outline/orientation.hpp"

namespace kinetix::app {
namespace {

using model::LatticeCell;
using Cells = std::vector<LatticeCell>;

constexpr int most_tried_cells = 1500;  // larger panels try one cut only: a search takes seconds
constexpr double same_size = 1e-3;      // ratio: with less difference, walls and offsets match the search
constexpr std::size_t most_cuts = 12;   // cuts that are fitted: as many as one orientation has
constexpr double as_drawn = 1e-9;       // rad: smaller angles do not turn the outline
constexpr double as_good = 0.01;        // ratio of errors: mirror images differ by less
// Rounding step of a cut's error, ratio. Cuts that are rotations of each other get equal errors, so their order does
// not depend on the orientation of the drawing.
constexpr double same_miss = 1e-6;

/// Returns the cell edge (mm) of the panel that these cells make: the file's, else an estimate from areas.
double edge_of(const OutlineFile& file, const Cells& cells) {
  if (file.cell_mm) return *file.cell_mm;
  const model::PlanarStructure panel = planar_structure(make_sheet(file.lattice, cells, {1, 0.1, 1}));
  double area = 0;
  for (const model::GraphFace& face : panel.faces)
    area += signed_area(face.vertices.size(),
                        [&](std::size_t k) { return panel.graph.vertices[face.vertices[k]]; });
  if (file.flat) return std::sqrt(file.flat->area() / area);
  return std::sqrt(file.folded.area() / area) / std::cos(file.theta[1]);
}

/// Returns the possible cuts of the lattice along an outline, at least one. @throws InvalidInput if there is none
std::vector<Cells> cuts_of(const OutlineFile& file, const targets::Outline& folded) {
  const auto& [lattice, angle] = file.lattice.lattice ? std::pair(file.lattice.lattice, file.lattice.angle)
                                                      : std::pair(&model::rhombus_lattice, pi / 2);
  std::vector<Cells> cuts = optim::trimmed_cells(*lattice, angle, file.columns, file.rows, folded);
  if (cuts.empty())
    throw InvalidInput("no cells of the lattice lie within the outline; give more `structure.cells`");
  return cuts;
}

/// Returns the angles (rad) that turn an outline onto the lattice, in steps of 45 deg from the outline's direction.
/// @param steps 4 if the panel has two-fold rotational symmetry, else 8
std::vector<double> turns_of(const targets::Outline& outline, int steps) {
  const std::optional<double> direction = direction_of(outline);
  if (!direction) return {0};
  std::vector<double> out;
  for (int k = 0; k < steps; ++k) {
    const double turn = std::remainder(k * pi / 4 - *direction, 2 * pi);
    out.push_back(std::abs(turn) < as_drawn ? 0 : turn);
  }
  return out;
}

/// Returns the boundary of a panel at rest, scaled to the area of the outline and centred on it.
std::vector<Eigen::Vector2d> rim_over(const targets::Outline& outline, const model::PlanarStructure& panel) {
  std::vector<Eigen::Vector2d> rim;
  for (const int v : outer_rim(panel.graph).vertices) rim.push_back(panel.graph.vertices[v]);
  const double area = signed_area(rim.size(), [&](std::size_t k) { return rim[k]; });
  Eigen::AlignedBox2d box;
  for (Eigen::Vector2d& p : rim) box.extend(p *= std::sqrt(outline.area() / area));
  for (Eigen::Vector2d& p : rim) p += outline.middle() - box.center();
  return rim;
}

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
    if (flat_) flat_ = targets::turned(*file_.flat, turn_of_flat());
    const Lay lay = file_.trims ? best_cut(found.cuts) : best_turn();
    const Cells& cells = lay.cells;
    found.turn = lay.turn;
    folded_ = targets::turned(file_.folded, lay.turn);
    double edge_mm = edge_of(file_, cells), came_out = edge_mm;
    bool is_same = false;
    for (int pass = 0; pass < 3 && !is_same && !found.design.stopped; ++pass) {
      optim::OutlineDesign design =
          fit(planar_structure(make_sheet(file_.lattice, cells, file_.size(came_out))), options_of(came_out));
      if (pass > 0 && design.stopped) {  // an interrupted pass is worse than the one before it
        found.design.stopped = true;
        break;
      }
      found.design = std::move(design);
      edge_mm = came_out;
      if (!file_.flat && !file_.cell_mm) came_out = found.design.scale;
      is_same = same_in_edges(edge_mm, came_out);
    }
    // After a stop, walls and offsets belong to the edge with which the design was fitted.
    place(found.design.stopped && !is_same ? edge_mm : came_out, cells, found);
    return found;
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

  optim::OutlineDesign fit(const model::PlanarStructure& panel, const optim::OutlineOptions& options) const {
    return fit_outline(panel, folded_, flat_ ? &*flat_ : nullptr, options, run_.progress);
  }

  /// Returns the turn of the flat outline with which the rectangle at rest is nearest to it, rad.
  double turn_of_flat() const {
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
    if (file_.columns * file_.rows > most_tried_cells)
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
    if (lays.size() > most_cuts || file_.columns * file_.rows > most_tried_cells) {
      measure_at_rest(file_.folded, lays);
      for (Lay& lay : lays) lay.miss = std::round(lay.miss / same_miss) * same_miss;
      std::stable_sort(lays.begin(), lays.end(), [](const Lay& a, const Lay& b) { return a.miss < b.miss; });
      const auto is_same = [](const Lay& a, const Lay& b) {
        return a.cells.size() == b.cells.size() && a.miss == b.miss;
      };
      lays.erase(std::unique(lays.begin(), lays.end(), is_same), lays.end());
      lays.resize(
          std::min<std::size_t>(lays.size(), file_.columns * file_.rows > most_tried_cells ? 1 : most_cuts));
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
        return miss(outline_error(laid, rim_over(laid, panel_of(lays[k].cells, 1))));
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
};

}  // namespace

OutlineStart outline_start(const OutlineFile& file) {
  OutlineStart start{file.trims ? cuts_of(file, file.folded).front()
                                : model::lattice_cells(file.columns, file.rows)};
  start.edge_mm = edge_of(file, start.cells);
  return start;
}

FoundOutline search_outline(const OutlineFile& file, const RunOptions& options) {
  return OutlineSearch(file, options).find();
}

}  // namespace kinetix::app
