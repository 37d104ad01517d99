#include "app/goals/outline/search_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/base/polygon.hpp"
#include "model/lattice/planar/lattices/rhombus.hpp"
#include "model/sheet/sheet_motion.hpp"
#include "optim/outline/trimmed_cells.hpp"

namespace kinetix::app {
namespace {

using model::LatticeCell;
using Cells = std::vector<LatticeCell>;

constexpr int most_tried_cells = 1500;  // above, one cut alone is tried: a search takes seconds
constexpr double same_size = 1e-3;      // ratio: walls and offsets in mm are then those of the search

/// Of the panel that these cells make, mm, as long as nothing is known but areas.
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

/// Ways to cut a lattice along the outline, not empty.
std::vector<Cells> cuts_of(const OutlineFile& file) {
  const auto& [lattice, angle] = file.lattice.lattice ? std::pair(file.lattice.lattice, file.lattice.angle)
                                                      : std::pair(&model::rhombus_lattice, pi / 2);
  std::vector<Cells> cuts = optim::trimmed_cells(*lattice, angle, file.columns, file.rows, file.folded);
  if (cuts.empty())
    throw InvalidInput("no cells of the lattice lie within the outline; give more `structure.cells`");
  return cuts;
}

class OutlineSearch {
 public:
  OutlineSearch(const OutlineFile& file, const RunOptions& run) : file_(file), run_(run) {}

  FoundOutline find() {
    FoundOutline found;
    const Cells cells = file_.trims ? best_cut(found.cuts) : model::lattice_cells(file_.columns, file_.rows);
    double edge_mm = edge_of(file_, cells), came_out = edge_mm;
    bool is_same = false;
    for (int pass = 0; pass < 3 && !is_same && !found.design.stopped; ++pass) {
      optim::OutlineDesign design =
          fit(planar_structure(make_sheet(file_.lattice, cells, file_.size(came_out))), options_of(came_out));
      if (pass > 0 && design.stopped) {  // it was cut short, and the one before it is nearer
        found.design.stopped = true;
        break;
      }
      found.design = std::move(design);
      edge_mm = came_out;
      if (!file_.flat && !file_.cell_mm) came_out = found.design.scale;
      is_same = same_in_edges(edge_mm, came_out);
    }
    // Of a search that was stopped, walls and offsets are of the edge that it was made with.
    place(found.design.stopped && !is_same ? edge_mm : came_out, cells, found);
    return found;
  }

 private:
  /// Whether walls and offsets have the same ratio to both cell edges, so that a search would find the same.
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
    return fit_outline(panel, file_.folded, file_.flat ? &*file_.flat : nullptr, options, run_.progress);
  }

  /// Each is fitted at the largest theta alone.
  Cells best_cut(int& count) const {
    std::vector<Cells> cuts = cuts_of(file_);
    if (file_.columns * file_.rows > most_tried_cells) cuts.resize(1);
    count = static_cast<int>(cuts.size());
    std::vector<double> misses(cuts.size());
    model::run_in_parallel(count, run_.threads, [&](int k) { misses[k] = miss_or_none(cuts[k]); });
    return cuts[std::min_element(misses.begin(), misses.end()) - misses.begin()];
  }

  /// Infinite for a cut that makes no panel.
  double miss_or_none(const Cells& cells) const {
    try {
      return miss_of(cells);
    } catch (const InvalidInput&) {
      return std::numeric_limits<double>::infinity();
    }
  }

  double miss_of(const Cells& cells) const {
    const double edge_mm = edge_of(file_, cells);
    optim::OutlineOptions options = options_of(edge_mm);
    options.theta[0] = options.theta[1];
    options.thetas = 1;
    const model::PlanarStructure panel =
        planar_structure(make_sheet(file_.lattice, cells, file_.size(edge_mm)));
    const optim::OutlineDesign design = fit_outline(panel, file_.folded, nullptr, options);
    const double shared = std::isfinite(design.error.iou) ? design.error.iou : 0;
    return design.error.rms / file_.shape_tolerance +
           (1 - shared) / (1 - std::min(0.99, file_.iou_tolerance)) + (design.clear ? 0 : 10);
  }

  /// The hinges into the sheet, as they come back from a file, where offsets are in mm.
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
};

}  // namespace

OutlineStart outline_start(const OutlineFile& file) {
  OutlineStart start{file.trims ? cuts_of(file).front() : model::lattice_cells(file.columns, file.rows)};
  start.edge_mm = edge_of(file, start.cells);
  return start;
}

FoundOutline search_outline(const OutlineFile& file, const RunOptions& options) {
  return OutlineSearch(file, options).find();
}

}  // namespace kinetix::app
