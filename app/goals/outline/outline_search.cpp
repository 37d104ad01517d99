#include "app/goals/outline/outline_search.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

// Cell edges: a living hinge at the face of a wall that is a sixth of the edge thick.
constexpr double default_offset = 0.08;
// Cells: a search takes about a second for a thousand cells and a minute for this number.
constexpr int most_cells = 10'000;
// Values of the key `trim`.
constexpr targets::Word<bool> trims[] = {{"outline", true}, {"none", false}};
// Offset of a hinge, cell edges: half a wall to either side.
const targets::Bounds offset = {0, 0.5, true, false, "mm (below half of cell_mm)"};
// Theta, degrees: at 45 basic cells are closed.
const targets::Bounds fold_range = targets::between(0, 45, "degrees");

targets::KeyTable outline_structure_keys(const OutlineFile& usual) {
  std::vector<targets::Key> keys = lattice_choice_keys(true);
  keys.insert(
      keys.begin() + 1,
      cells_key(targets::by_default({static_cast<double>(usual.columns), static_cast<double>(usual.rows)}),
                "[columns, rows] of the panel, or of the rectangle that it is cut from"));
  keys.push_back(
      {"trim", value::choice(trims),
       targets::otherwise("`none` with `cells` or `target.flat`, else `outline`"),
       "`outline`: the flat panel is cut to the shape of the outline. `none`: a whole rectangle of cells"});
  keys.push_back(cell_mm_key(
      targets::otherwise("gives the pressed panel the size of the outline. If the key is given, the "
                         "outline is scaled to the panel")));
  keys.push_back(wall_mm_key());
  return targets::KeyTable(std::move(keys));
}

targets::KeyTable outline_variables_keys() {
  const targets::KeyTable t(
      {{"range", &OutlineFile::t, value::range(targets::place_along),
        "allowed positions of hinges along their walls. The end nearer to 0.5 limits both sides"}});
  const targets::KeyTable theta(
      {{"range_deg", &OutlineFile::theta, value::angle_range(fold_range),
        "fold angle of the pressed state. The search tries several within the range"}});
  return targets::KeyTable({
      {"offset_mm", &OutlineFile::offset_mm, value::length(offset), targets::otherwise("0.08 of `cell_mm`"),
       "largest lateral offset of a hinge, to either side"},
      targets::Key("hinge_position", t, "positions of the hinges along their walls").formerly("t"),
      targets::Key("fold_angle", theta, "fold angle of the pressed panel").formerly("theta"),
  });
}

void read_cells_of(const targets::Section& structure, OutlineFile& file) {
  const auto node = structure.optional("cells");
  file.trims = !node && !file.flat;
  structure.read("trim", file.trims, trims);
  if (!node) return;
  const auto sides = as_rectangle(read_cells(*node));
  if (!sides)
    throw node->error("the cells do not fill a rectangle, which an outline needs. Give [columns, rows]");
  if ((*sides)[0] * (*sides)[1] > most_cells)
    throw node->error("there are too many cells for a search. Give at most 10000");
  file.columns = (*sides)[0];
  file.rows = (*sides)[1];
}

void read_structure(const targets::Section& root, OutlineFile& file) {
  const targets::Section structure = root.section("structure");
  file.lattice = read_lattice_choice(structure, true);
  read_cells_of(structure, file);
  structure.read("cell_mm", file.cell_mm);
  const targets::Section wall = structure.section("wall_mm");
  wall.read_length("thickness", file.thickness_mm, file.cell_mm.value_or(file.folded.diagonal()));
  wall.read("height", file.height_mm);
  if (file.flat && file.trims)
    throw root.section("structure")
        .error(
            "`trim: outline` cannot be combined with `target.flat`, which sets the flat outline. Remove one "
            "of the two keys");
}

void read_variables(const targets::Section& root, OutlineFile& file) {
  root.read_into(file, file.cell_mm.value_or(file.folded.diagonal()));
  if (!(file.t[0] < 0.5 && file.t[1] > 0.5))
    throw root.section("variables")
        .section("hinge_position")
        .optional("range")
        ->error("the range does not contain 0.5, where hinges start. Give a range around 0.5");
}

/// Limits the offset to the largest at which a made hinge fits on its wall. @throws InvalidInput for a larger offset_mm
void limit_outline_offset(const targets::Section& root, OutlineFile& file) {
  if (!file.hinge.made || !file.cell_mm) return;
  const model::CellSize size = file.size(*file.cell_mm);
  const double most_mm = largest_offset_mm(*file.hinge.made, size);
  if (const auto asked = root.section("variables").optional("offset_mm");
      asked && *file.offset_mm > most_mm * (1 + 1e-9))
    throw asked->error(offset_limit_text(*file.hinge.made, size));
  file.offset_mm = std::min(file.offset(*file.cell_mm) * *file.cell_mm, most_mm);
}

}  // namespace

model::CellSize OutlineFile::size(double edge_mm) const {
  model::CellSize size = default_size(edge_mm);
  size.thickness_mm = thickness_mm.value_or(size.thickness_mm);
  size.height_mm = height_mm.value_or(size.height_mm);
  return size;
}

double OutlineFile::offset(double edge_mm) const { return offset_mm ? *offset_mm / edge_mm : default_offset; }

const targets::KeyTable& outline_keys() {
  static const OutlineFile usual;
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::outline_target_keys(), "the goal", targets::needed},
          {"structure", outline_structure_keys(usual), "flat panel"},
          {"variables", outline_variables_keys(), "quantities that the search changes, with their ranges"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &OutlineFile::shape_tolerance, value::number(targets::part_of_one),
                "limit of [outline_rms](#outline_rms-and-iou), relative to the diagonal of the outline's "
                "bounding box"},
               {"iou", &OutlineFile::iou_tolerance, value::number(targets::part_of_one),
                "minimum of [iou](#outline_rms-and-iou)"},
               verify_key(),
           }),
           "limits for a met goal"},
      },
      sized_hinge);
  return keys;
}

OutlineFile read_outline_file(const targets::Node& node) {
  const targets::Section root = read_root(node, outline_keys());
  const targets::Section target = root.section("target");
  OutlineFile file;
  target.required("points", "the path of a file or a list of points [[x, y], ...] in mm");
  const bool checks_size = !root.section("structure").optional("cell_mm");
  file.folded = targets::read_outline(target, "points", checks_size, file.input_notes);
  if (target.optional("flat"))
    file.flat = targets::read_outline(target, "flat", checks_size, file.input_notes);
  read_structure(root, file);
  read_variables(root, file);
  read_settings(root, file.cell_mm.value_or(file.folded.diagonal() / file.columns), file);
  read_hinges(root, file.cell_mm ? std::optional(file.size(*file.cell_mm)) : std::nullopt, file);
  if (!file.hinge_parts.empty())
    throw root.section("hinge").optional("except")->key_error(
        "the hinges of a panel are upright, so it has no creases. Remove the key");
  limit_outline_offset(root, file);
  return file;
}

namespace {

using model::LatticeCell;
using Cells = std::vector<LatticeCell>;

constexpr int max_tried_cells = 1500;  // larger panels try one cut only: a search takes seconds
constexpr double same_size = 1e-3;     // ratio: with less difference, walls and offsets match the search
constexpr std::size_t max_cuts = 12;   // cuts that are fitted: as many as one orientation has
constexpr double as_drawn = 1e-9;      // rad: smaller angles do not turn the outline
constexpr double as_good = 0.01;       // ratio of errors: mirror images differ by less
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
    throw InvalidInput("no cells of the lattice are within the outline. Give more `structure.cells`");
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
std::vector<Eigen::Vector2d> boundary_over(const targets::Outline& outline,
                                           const model::PlanarStructure& panel) {
  std::vector<Eigen::Vector2d> rim;
  for (const int v : outer_boundary(panel.graph).vertices) rim.push_back(panel.graph.vertices[v]);
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
    double edge_mm = edge_of(file_, cells), fitted_edge_mm = edge_mm;
    bool is_same = false;
    for (int pass = 0; pass < 3 && !is_same && !found.design.stopped; ++pass) {
      optim::OutlineDesign design =
          fit(planar_structure(make_sheet(file_.lattice, cells, file_.size(fitted_edge_mm))),
              options_of(fitted_edge_mm));
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
    place(found.design.stopped && !is_same ? edge_mm : fitted_edge_mm, cells, found);
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
