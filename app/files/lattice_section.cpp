#include "app/files/lattice_section.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "app/files/cuts_section.hpp"
#include "app/files/drawing_section.hpp"
#include "app/files/origami_file.hpp"
#include "model/lattice/planar/closed_boundary.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using model::PlanarLattice;

constexpr double default_cell_mm = 10;        // mm: a cell that can be held in the hand
constexpr int max_vertices = 1'000'000;       // as many as the largest sheet of squares has cells
constexpr const char* squares = "square";     // `lattice` of model/lattice/square
constexpr const char* by_hand = "graph";      // `lattice` of what is drawn by hand
constexpr const char* in_space = "sodalite";  // `lattice` of model/lattice/sodalite
constexpr double default_gusset = 0.2;        // of an edge: printable gussets, and arms of four fifths

// Ratio of a gusset to the edge: shorter ones have both hinges in one place, longer ones leave rotors no arms.
const targets::Bounds gussets = targets::from_to(0.02, 0.9);
constexpr int max_cells_in_space = 14;  // per direction: 14^3 cells have some 100 000 bodies
constexpr double slender = 0.1;         // of an edge: rotors pass each other up to heights of a fifth
constexpr const char* slender_walls = "for `sodalite` a tenth of `cell_mm`";  // `slender` in words
constexpr const char* wanted_drawing = "path of a DXF or SVG file";
constexpr const char* wanted_pattern = "path of a FOLD, SVG, DXF or .cp file";
constexpr const char* rims[] = {"open", "closed"};
// Degrees of a rhombus: flatter ones have walls that touch their neighbours'.
const targets::Bounds angles = targets::from_to(30, 150, "degrees");
// Coordinates of a vertex: a kilometre is larger than any sheet.
const targets::Bounds places = targets::from_to(-1e6, 1e6, "mm");

std::vector<std::string> regular_names() {
  std::vector<std::string> names;
  for (const PlanarLattice* lattice : model::planar_lattices()) names.emplace_back(lattice->name);
  return names;
}

/// Returns the names of lattices with counted cells.
std::vector<std::string> names_with_cells() {
  std::vector<std::string> names = regular_names();
  names.insert(names.begin(), squares);
  return names;
}

std::vector<std::string> lattice_names() {
  std::vector<std::string> names = names_with_cells();
  names.emplace_back(by_hand);
  names.emplace_back(in_space);
  return names;
}

std::string lattice_meaning() {
  std::string text = "lattice of the sheet: `square`";
  for (const PlanarLattice* lattice : model::planar_lattices())
    text += fmt::format("; `{}`, {}", lattice->name, lattice->meaning);
  return text +
         "; `graph`, walls of a drawing, of a crease pattern or of a list; `sodalite`, rotors and gussets in "
         "space";
}

targets::ValueType numbers_2() { return value::list(value::number(places), "`[x, y]`", 2, 2); }

targets::Node cells_of(const targets::Section& structure) {
  return structure.required("cells", "[columns, rows], or a list of cells [[i, j], ...]");
}

bool read_boundary(const targets::Section& structure, bool closed) {
  const auto node = structure.optional("rim");
  return !node ? closed : node->one_of({std::begin(rims), std::end(rims)}) == 1;
}

model::Lattice read_squares(const targets::Section& structure) {
  const targets::Node cells = cells_of(structure);
  const model::CellSize size = read_size(structure, default_cell_mm);
  return cells.located([&] { return make_structure(read_cells(cells), size); });
}

model::Lattice read_regular(const targets::Section& structure) {
  const LatticeChoice choice = read_lattice_choice(structure, false);
  const targets::Node cells = cells_of(structure);
  std::vector<model::LatticeCell> drawn;
  for (const model::Cell& cell : read_cells(cells)) drawn.push_back({cell.i, cell.j});
  const model::CellSize size = read_size(structure, default_cell_mm);
  return cells.located([&] { return make_sheet(choice, drawn, size); });
}

Eigen::Vector2d read_point(const targets::Node& node) {
  const auto xy = node.list_of(2, "a point [x, y] in mm");
  return {xy[0].number(places), xy[1].number(places)};
}

/// Reads the walls as written in the file, mm.
model::PlanarGraph read_walls(const targets::Section& structure) {
  model::PlanarGraph graph;
  const targets::Node points = structure.required("vertices_mm", "points [[x, y], ...] in mm");
  for (const targets::Node& point : points.list("points [[x, y], ...]"))
    graph.vertices.push_back(read_point(point));
  const int last = static_cast<int>(graph.vertices.size()) - 1;
  for (const targets::Node& wall : structure.required("walls", "pairs of vertices [[0, 1], ...]")
                                       .list("pairs of vertices [[0, 1], ...]")) {
    const auto ends = wall.list_of(2, "two vertices by their numbers, e.g. [0, 1]");
    graph.edges.push_back({ends[0].integer(0, last), ends[1].integer(0, last)});
  }
  return graph;
}

double mean_length(const model::PlanarGraph& graph) {
  double sum = 0;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) sum += graph.along(e).norm();
  return sum / static_cast<double>(std::max<std::size_t>(1, graph.edges.size()));
}

/// Reads the walls of a drawing or of a list, mm, connected and without crossings.
model::PlanarGraph read_valid_walls(const targets::Section& structure) {
  if (!structure.knows("drawing")) {
    model::PlanarGraph graph = read_walls(structure);
    structure.node().located([&] { validate(graph); });
    return graph;
  }
  targets::DrawnWalls walls = examine_drawn_structure(structure);
  if (walls.fault) throw InvalidInput(*walls.fault);
  structure.required("drawing", wanted_drawing).located([&] { validate(walls.graph); });
  return std::move(walls.graph);
}

model::Lattice read_graph(const targets::Section& structure) {
  const targets::Node place =
      structure.knows("drawing") ? structure.required("drawing", wanted_drawing) : structure.node();
  model::PlanarGraph graph = read_valid_walls(structure);
  if (read_boundary(structure, false)) graph = closed_boundary(std::move(graph));
  const model::CellSize size = read_size(structure, mean_length(graph));
  for (Eigen::Vector2d& vertex : graph.vertices) vertex /= size.edge_mm;
  return place.located([&] { return make_planar_structure(std::move(graph), size); });
}

// Degrees of the steepest crease: flat walls do not fold, and beyond 75 deg they lie on their sheet.
const targets::Bounds pattern_tilts = targets::from_to(1, 75, "degrees");
constexpr double default_tilt = 50 * radians_per_degree;  // rad: folds by 78 deg at theta 43 deg

/// Returns the length of the mean wall of a sheet that keeps the pattern's size, mm. @param unit_mm of the mesh
/// @throws InvalidInput without a place for walls that `cell_mm` could not have
double edge_of_pattern(const model::QuadMesh& mesh, double unit_mm) {
  const double edge_mm = unit_mm * mean_edge(mesh) / mean_edge(origami_sheet(mesh, default_size(1)).mesh);
  if (!cell_edges.contains(edge_mm))
    throw InvalidInput(
        fmt::format("the unit of the file results in walls of {:.3g} mm. Give cell_mm from {:g} to {:g}",
                    edge_mm, cell_edges.lower, cell_edges.upper));
  return edge_mm;
}

/// Reads a crease pattern as a sheet whose creases are tilted.
model::Lattice read_origami(const targets::Section& structure, std::vector<std::string>& notes) {
  const targets::Node path = structure.required("origami", wanted_pattern);
  const std::filesystem::path file = std::filesystem::path(path.folder()) / path.text(wanted_pattern);
  double tilt = default_tilt;
  if (const auto node = structure.optional("tilt_deg")) tilt = node->angle(pattern_tilts);
  const targets::HiddenQuotes hidden(file.string(), path.folder());
  const OrigamiFile pattern = read_origami_file(file.string());
  notes = pattern.notes;
  const model::QuadMesh mesh = tilted(pattern, tilt);
  double edge_mm = default_cell_mm;
  if (pattern.unit_mm && !structure.optional("cell_mm"))
    path.located([&] { edge_mm = edge_of_pattern(mesh, *pattern.unit_mm); });
  const model::CellSize size = read_size(structure, edge_mm);
  return path.located([&] { return origami_sheet(mesh, size).structure; });
}

model::Lattice read_block(const targets::Section& structure) {
  const targets::Node cells = structure.required("cells", "[n, n, n], cubic cells along x, y and z");
  std::array<int, 3> counts{};
  const auto nodes = cells.list_of(3, "[n, n, n], cubic cells along x, y and z");
  for (std::size_t d = 0; d < 3; ++d) counts[d] = nodes[d].integer(1, max_cells_in_space);
  double gusset = default_gusset;
  structure.read("gusset", gusset);
  model::CellSize size = read_size(structure, default_cell_mm);
  const targets::Section walls = structure.section("wall_mm");
  if (!walls.optional("thickness")) size.thickness_mm = slender * size.edge_mm;
  if (!walls.optional("height")) size.height_mm = slender * size.edge_mm;
  return cells.located([&] { return make_sodalite(counts, gusset, size); });
}

/// Formats cells. @param in_order whether their order matters: then only cells in the order of a rectangle are
/// written as one
std::string cells_text(const std::vector<model::Cell>& cells, bool in_order) {
  const auto sides = as_rectangle(cells);
  const bool starts_at_0 = *std::min_element(cells.begin(), cells.end()) == model::Cell{0, 0};
  if (sides && (in_order ? cells == model::rectangle((*sides)[0], (*sides)[1]) : starts_at_0))
    return fmt::format("[{}, {}]", (*sides)[0], (*sides)[1]);
  std::string text = "[";
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) text += k % 10 == 0 ? ",\n          " : ", ";
    text += fmt::format("[{}, {}]", cells[k].i, cells[k].j);
  }
  return text + "]";
}

std::string drawn_text(const model::PlanarStructure& planar) {
  const model::LatticeSheet& drawn = planar.drawn;
  std::vector<model::Cell> cells;
  for (const auto& [i, j] : drawn.cells) cells.push_back({i, j});
  std::string text =
      fmt::format("  lattice: {}\n  cells: {}\n", drawn.lattice->name, cells_text(cells, true));
  if (drawn.lattice->needs_angle) text += "  angle_deg: " + targets::degrees_text(drawn.angle) + "\n";
  return text + (drawn.closed_boundary ? "  rim: closed\n" : "");
}

std::string graph_text(const model::PlanarStructure& planar) {
  const double edge = planar.size.edge_mm;
  std::string text = "  lattice: graph\n  vertices_mm: [";
  for (std::size_t v = 0; v < planar.graph.vertices.size(); ++v) {
    const Eigen::Vector2d& at = planar.graph.vertices[v];
    text +=
        fmt::format("{}[{}, {}]",
                    v == 0       ? ""
                    : v % 6 == 0 ? ",\n    "
                                 : ", ",
                    targets::shortest_text(mm_of(at.x(), edge)), targets::shortest_text(mm_of(at.y(), edge)));
  }
  text += "]\n  walls: [";
  for (std::size_t e = 0; e < planar.graph.edges.size(); ++e)
    text += (e == 0 ? "" : e % 10 == 0 ? ",\n    " : ", ") + to_string(planar.graph.edges[e]);
  return text + "]\n";
}

std::string cells_or_walls(const model::Lattice& sheet) {
  if (const model::SodaliteStructure* s = sheet.sodalite())
    return fmt::format("  lattice: {}\n  cells: [{}, {}, {}]\n  gusset: {}\n", in_space, s->cells[0],
                       s->cells[1], s->cells[2], targets::shortest_text(s->gusset));
  if (const model::Structure* s = sheet.squares()) return "  cells: " + cells_text(s->cells, false) + "\n";
  return sheet.planar()->drawn.lattice ? drawn_text(*sheet.planar()) : graph_text(*sheet.planar());
}

targets::Key lattice_key(std::vector<std::string> words, targets::Default fallback) {
  return {"lattice", value::choice(std::move(words)), std::move(fallback), lattice_meaning()};
}

targets::Key boundary_key(bool closed = false) {
  return {"rim", value::choice(std::vector<std::string>(std::begin(rims), std::end(rims))),
          closed ? targets::otherwise("closed") : targets::by_default("open"),
          "`closed` braces the boundary: it adds cells in its notches and, if necessary, walls across cells, "
          "until one degree of freedom is left"};
}

targets::Key angle_key() {
  return {"angle_deg", value::angle(angles), targets::by_default_deg(model::LatticeSheet{}.angle),
          "for `rhombus`: angle between walls along the rows and across them"};
}

/// Returns the key `cell_mm` for walls that have their lengths already.
targets::Key drawn_cell_mm_key() {
  return cell_mm_key(
      targets::otherwise("for a drawing and a list of walls their mean length. The key does not scale them: "
                         "it is the unit of distances in cell edges and of the default walls"));
}

targets::Key any_cells_key() { return cells_key(targets::needed, "cells of the sheet"); }

const targets::KeyTable& square_keys() {
  static const targets::KeyTable keys({lattice_key({squares}, targets::by_default(squares)), any_cells_key(),
                                       cell_mm_key(targets::by_default(default_cell_mm)), wall_mm_key()});
  return keys;
}

const targets::KeyTable& regular_keys() {
  static const targets::KeyTable keys({
      lattice_key(regular_names(), targets::needed),
      any_cells_key(),
      angle_key(),
      boundary_key(),
      cell_mm_key(targets::by_default(default_cell_mm)),
      wall_mm_key(),
  });
  return keys;
}

const targets::KeyTable& block_keys() {
  static const targets::KeyTable keys({
      lattice_key({in_space}, targets::needed),
      {"cells", value::list(value::integer(1, max_cells_in_space), "`[n, n, n]`", 3, 3), targets::needed,
       "for `sodalite`: cubic cells along x, y and z"},
      {"gusset", value::number(gussets), targets::by_default(default_gusset),
       "for `sodalite`: length of a gusset, the piece between two rotors that never turns, relative to the "
       "edge. Hinges are at its ends"},
      cell_mm_key(targets::by_default(default_cell_mm)),
      wall_mm_key(slender_walls, slender_walls),
  });
  return keys;
}

const targets::KeyTable& drawn_keys() {
  static const targets::KeyTable keys([] {
    std::vector<targets::Key> all = {lattice_key({by_hand}, targets::needed)};
    for (const targets::Key& key : drawing_keys()) all.push_back(key);
    for (const targets::Key& key : {boundary_key(), drawn_cell_mm_key(), wall_mm_key()}) all.push_back(key);
    return all;
  }());
  return keys;
}

const targets::KeyTable& origami_keys() {
  static const targets::KeyTable keys({
      lattice_key({by_hand}, targets::needed),
      {"origami", value::text("path of a FOLD, SVG, DXF or .cp file, from the folder of the design"),
       targets::needed,
       "for `graph`: a crease pattern of quadrilaterals in columns and rows that folds flat and rigidly. "
       "Each quadrilateral gets 2 x 2 bodies, and the tilts of its creases follow from the pattern"},
      {"tilt_deg", value::angle(pattern_tilts), targets::by_default_deg(default_tilt),
       "for `origami`: tilt of the hinges of the creases that fold most"},
      cell_mm_key(targets::otherwise(
          "for `origami` the size of the file if it has a unit (`frame_unit`, or a size in mm, "
          "cm or in), else 10")),
      wall_mm_key(),
  });
  return keys;
}

const targets::KeyTable& graph_keys() {
  static const targets::KeyTable keys({
      lattice_key({by_hand}, targets::needed),
      {"vertices_mm", value::list(numbers_2(), "`[[x, y], ...]`", 2, max_vertices), targets::needed,
       "for `graph` without a drawing: ends of the walls"},
      {"walls",
       value::list(value::list(value::integer(0, max_vertices - 1), "`[from, to]`", 2, 2),
                   "`[[from, to], ...]`"),
       targets::needed,
       "for `graph` without a drawing: walls, each by the numbers of its two vertices, from 0"},
      boundary_key(),
      drawn_cell_mm_key(),
      wall_mm_key(),
  });
  return keys;
}

}  // namespace

std::string LatticeChoice::name() const { return lattice ? std::string(lattice->name) : squares; }

double LatticeChoice::cell_shape() const {
  if (!lattice) return 1;
  const model::LatticePitch pitch = lattice_pitch(*lattice, angle);
  return pitch.column.x() / pitch.row.y();
}

std::vector<targets::Key> lattice_choice_keys(bool closed) {
  return {lattice_key(names_with_cells(), targets::by_default(squares)), angle_key(), boundary_key(closed)};
}

LatticeChoice read_lattice_choice(const targets::Section& structure, bool closed) {
  const std::vector<std::string> names = names_with_cells();
  LatticeChoice choice;
  if (const auto node = structure.optional("lattice"))
    if (const std::size_t k = node->one_of({names.begin(), names.end()}); k > 0)
      choice.lattice = model::planar_lattices()[k - 1];
  if (const auto angle = structure.optional("angle_deg");
      angle && !(choice.lattice && choice.lattice->needs_angle))
    throw angle->key_error(
        fmt::format("cells of lattice: {} have one shape only. Remove the key", choice.name()));
  if (const auto rim = structure.optional("rim"); rim && !choice.lattice)
    throw rim->key_error("a panel of squares already has one degree of freedom. Remove the key");
  structure.read("angle_deg", choice.angle);
  choice.closed_boundary = choice.lattice && read_boundary(structure, closed);
  return choice;
}

model::Lattice make_sheet(const LatticeChoice& choice, const std::vector<model::LatticeCell>& cells,
                          const model::CellSize& size) {
  if (choice.lattice)
    return make_planar_structure({choice.lattice, cells, choice.angle, choice.closed_boundary}, size);
  std::vector<model::Cell> squares_of;
  for (const auto& [i, j] : cells) squares_of.push_back({i, j});
  return make_structure(std::move(squares_of), size);
}

targets::Key lattice_structure_key() {
  return {"structure",
          value::either({value::map(square_keys()), value::map(regular_keys()), value::map(drawn_keys()),
                         value::map(origami_keys()), value::map(graph_keys()), value::map(block_keys())}),
          targets::needed,
          "flat sheet: squares, another regular lattice, a drawing, a crease pattern, a list of walls, or a "
          "lattice in space"};
}

model::Lattice read_sheet(const targets::Node& structure, std::vector<std::string>& notes) {
  const auto lattice = structure.optional("lattice");
  const std::vector<std::string> names = lattice_names();
  const std::size_t choice = lattice ? lattice->one_of({names.begin(), names.end()}) : 0;
  if (names[choice] == squares) return read_squares(targets::Section(structure, square_keys()));
  if (names[choice] == in_space) return read_block(targets::Section(structure, block_keys()));
  if (names[choice] != by_hand) return read_regular(targets::Section(structure, regular_keys()));
  if (structure.optional("origami")) return read_origami(targets::Section(structure, origami_keys()), notes);
  const bool is_drawn = structure.optional("drawing") || !structure.optional("vertices_mm");
  return read_graph(targets::Section(structure, is_drawn ? drawn_keys() : graph_keys()));
}

std::optional<targets::Section> find_drawn_structure(const targets::Node& root) {
  const auto structure = root.optional("structure");
  if (!structure || structure->kind() != targets::Node::Kind::map) return std::nullopt;
  if (structure->optional("cuts")) return targets::Section(structure, cuts_keys());
  if (!structure->optional("drawing")) return std::nullopt;
  return targets::Section(structure, drawn_keys());
}

std::string structure_text(const model::Lattice& sheet) {
  const model::CellSize& size = sheet.size();
  return "structure:\n" + cells_or_walls(sheet) +
         fmt::format("  cell_mm: {}\n  wall_mm: {{thickness: {}, height: {}}}\n",
                     targets::shortest_text(size.edge_mm), targets::shortest_text(size.thickness_mm),
                     targets::shortest_text(size.height_mm));
}

}  // namespace kinetix::app
