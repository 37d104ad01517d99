#include "model/lattice/lattice.hpp"

#include <cmath>
#include <numeric>

#include "model/assembly/assembly.hpp"

namespace kinetix::model {
namespace {

constexpr double one_column = 1e-9;  // cell edges: rounding separates vertices of one column by as much

/// Overload set with one function for each lattice.
template <class... F>
struct Each : F... {
  using F::operator()...;
};
template <class... F>
Each(F...) -> Each<F...>;

std::vector<std::vector<int>> columns_of(const std::vector<Eigen::Vector2d>& places) {
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  const auto x = [&](int v) { return places[v].x(); };
  const auto y = [&](int v) { return places[v].y(); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return x(a) < x(b); });
  std::vector<std::vector<int>> columns;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || x(order[k]) - x(order[k - 1]) > one_column) columns.emplace_back();
    columns.back().push_back(order[k]);
  }
  for (std::vector<int>& column : columns)
    std::sort(column.begin(), column.end(), [&](int a, int b) { return y(a) < y(b); });
  return columns;
}

HingedWall wall_between(const Assembly& assembly, int hinge) {
  const AssemblyHinge& h = assembly.hinges[hinge];
  const Eigen::Vector3d &lower = assembly.bodies[h.lower].position,
                        &upper = assembly.bodies[h.upper].position;
  return {h.lower, h.upper, (upper - lower) / assembly.edge_mm, {}};
}

}  // namespace

Lattice::Lattice(Assembly bodies) {
  ImportedBodies own;
  own.hinges.resize(bodies.hinges.size());
  own.linkage = std::make_shared<const Linkage>(linkage_of(bodies));
  own.size = own.linkage->size;
  own.assembly = std::make_shared<const Assembly>(std::move(bodies));
  of_ = std::move(own);
}

const Assembly* Lattice::assembly() const {
  const auto* bodies = std::get_if<ImportedBodies>(&of_);
  return bodies ? bodies->assembly.get() : nullptr;
}

const CellSize& Lattice::size() const {
  return std::visit([](const auto& s) -> const CellSize& { return s.size; }, of_);
}

int Lattice::bodies() const {
  return std::visit(
      Each{[](const Structure& s) { return static_cast<int>(s.bodies.size()); },
           [](const PlanarStructure& s) { return static_cast<int>(s.graph.vertices.size()); },
           [](const SodaliteStructure& s) { return static_cast<int>(s.rotors.size() + s.gussets.size()); },
           [](const ImportedBodies& s) { return static_cast<int>(s.assembly->bodies.size()); }},
      of_);
}

int Lattice::hinges() const {
  return std::visit([](const auto& s) { return static_cast<int>(s.hinges.size()); }, of_);
}

int Lattice::cells() const {
  return std::visit(Each{[](const Structure& s) { return static_cast<int>(s.cells.size()); },
                         [](const PlanarStructure& s) { return static_cast<int>(s.faces.size()); },
                         [](const SodaliteStructure& s) { return static_cast<int>(s.rings.size()); },
                         [](const ImportedBodies&) { return 0; }},
                    of_);
}

const HingeParameters& Lattice::hinge(int index) const {
  if (const Structure* s = squares()) return s->hinges[index].parameters;
  if (const SodaliteStructure* s = sodalite()) return s->hinges[index];
  if (const auto* s = std::get_if<ImportedBodies>(&of_)) return s->hinges[index];
  return planar()->hinges[index];
}

HingeParameters& Lattice::hinge(int index) {
  if (Structure* s = squares()) return s->hinges[index].parameters;
  if (SodaliteStructure* s = sodalite()) return s->hinges[index];
  if (auto* s = std::get_if<ImportedBodies>(&of_)) return s->hinges[index];
  return planar()->hinges[index];
}

HingedWall Lattice::wall(int hinge) const {
  return std::visit(Each{[hinge](const Structure& s) { return hinged_wall(s.hinges[hinge]); },
                         [hinge](const ImportedBodies& s) { return wall_between(*s.assembly, hinge); },
                         [hinge](const auto& s) { return hinged_wall(s, hinge); }},
                    of_);
}

std::span<const int> Lattice::cell_bodies(int cell) const {
  if (const Structure* s = squares()) return s->cell_members[cell].bodies;
  if (const SodaliteStructure* s = sodalite()) return s->ring_bodies[cell];
  return planar()->faces[cell].vertices;
}

std::span<const int> Lattice::cell_hinges(int cell) const {
  if (const Structure* s = squares()) return s->cell_members[cell].hinges;
  if (const SodaliteStructure* s = sodalite()) return s->ring_hinges[cell];
  return planar()->faces[cell].edges;
}

Eigen::Vector3d Lattice::rest_position(int body) const {
  if (const Structure* s = squares()) return s->rest_position(body);
  if (const SodaliteStructure* s = sodalite()) return size().edge_mm * sodalite_place(*s, body);
  if (const Assembly* a = assembly()) return a->bodies[body].position;
  const Eigen::Vector2d at = size().edge_mm * planar()->graph.vertices[body];
  return {at.x(), at.y(), 0};
}

Lattice::operator Linkage() const {
  return std::visit([](const auto& s) -> Linkage { return s; }, of_);
}

std::string lattice_name(const Lattice& sheet) {
  if (sheet.squares()) return "square";
  if (sheet.sodalite()) return "sodalite";
  if (sheet.assembly()) return "bodies";
  const PlanarLattice* lattice = sheet.planar()->drawn.lattice;
  return lattice ? std::string(lattice->name) : "graph";
}

std::vector<int> body_label(const Lattice& sheet, int body) {
  if (const Structure* s = sheet.squares()) return body_label(*s, body);
  if (const SodaliteStructure* s = sheet.sodalite()) {
    const std::array<int, 3> place = body_label(*s, body);
    return {place.begin(), place.end()};
  }
  return {body};
}

std::vector<int> cell_label(const Lattice& sheet, int cell) {
  if (const Structure* s = sheet.squares()) return cell_label(*s, cell);
  if (sheet.sodalite()) return {cell};
  const auto& drawn = sheet.planar()->drawn.cells;
  if (cell >= static_cast<int>(drawn.size())) return {cell};
  return {drawn[cell][0], drawn[cell][1]};
}

std::string wall_name(const Lattice& sheet, int hinge) {
  if (const Structure* s = sheet.squares()) return to_string(s->hinges[hinge].wall);
  if (const Assembly* a = sheet.assembly()) return "`" + a->hinges[hinge].name + "`";
  if (sheet.sodalite()) {
    const HingedWall wall = sheet.wall(hinge);
    return "[" + std::to_string(wall.lower) + ", " + std::to_string(wall.upper) + "]";
  }
  return to_string(sheet.planar()->graph.edges[hinge]);
}

std::vector<std::vector<int>> body_columns(const Lattice& sheet) {
  if (const Structure* s = sheet.squares()) return body_columns(*s);
  if (const PlanarStructure* s = sheet.planar()) return columns_of(s->graph.vertices);
  std::vector<Eigen::Vector2d> places;
  for (int b = 0; b < sheet.bodies(); ++b)
    places.push_back(sheet.rest_position(b).head<2>() / sheet.size().edge_mm);
  return columns_of(places);
}

void validate_hinges(const Lattice& sheet) {
  if (const Structure* s = sheet.squares()) return validate_hinges(*s);
  if (const SodaliteStructure* s = sheet.sodalite()) return validate_hinges(*s);
  if (sheet.assembly()) return;
  validate_hinges(*sheet.planar());
}

RestHinge rest_hinge(const Lattice& sheet, int hinge) {
  if (const SodaliteStructure* block = sheet.sodalite()) return rest_hinge(*block, hinge);
  if (sheet.assembly()) return Linkage(sheet).hinges[hinge];
  return rest_hinge(sheet.wall(hinge));
}

}  // namespace kinetix::model
