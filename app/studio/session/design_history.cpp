#include "app/studio/session/design_history.hpp"

#include <algorithm>

#include "model/assembly/assembly.hpp"

namespace kinetix::app::studio {
namespace {

constexpr std::size_t longest = 100;           // steps back: more than anybody remembers
constexpr std::size_t most_bytes = 128 << 20;  // bytes of all designs; limits the number of steps

constexpr std::size_t hinge_bytes = 56, body_bytes = 8, cell_bytes = 40;  // bytes, in a sheet of squares
constexpr std::size_t point_bytes = 24, triangle_bytes = 12;  // bytes, three doubles and three ints of a mesh

std::size_t size_of(const model::Polyhedron& solid) {
  return solid.points.size() * point_bytes + solid.triangles.size() * triangle_bytes;
}

/// Estimates the memory of a design, bytes.
std::size_t size_of(const Design& design) {
  const model::Lattice& sheet = design.structure;
  std::size_t bytes = sheet.hinges() * hinge_bytes + sheet.bodies() * body_bytes + sheet.cells() * cell_bytes;
  if (const model::Assembly* bodies = sheet.assembly()) {
    for (const model::AssemblyBody& body : bodies->bodies) bytes += size_of(body.solid);
    for (const model::AssemblyHinge& hinge : bodies->hinges) bytes += size_of(hinge.soft);
  }
  return bytes;
}

}  // namespace

DesignHistory::DesignHistory(Design first) {
  designs_.reserve(longest + 1);  // allocates now: add() needs no memory for the list
  designs_.push_back({std::move(first), 0, {}});
}

void DesignHistory::add(Design design, int thing, Finding finding) {
  designs_.resize(at_ + 1);
  if (saved_ > static_cast<int>(at_)) saved_ = -1;
  designs_.push_back({std::move(design), thing, std::move(finding)});
  std::size_t bytes = 0;
  for (const Entry& entry : designs_) bytes += size_of(entry.design);
  while (designs_.size() > longest || (bytes > most_bytes && designs_.size() > 2)) {
    bytes -= size_of(designs_.front().design);
    designs_.erase(designs_.begin());
    saved_ = std::max(saved_ - 1, -1);
  }
  at_ = designs_.size() - 1;
}

bool DesignHistory::undo() {
  if (!can_undo()) return false;
  --at_;
  return true;
}

bool DesignHistory::redo() {
  if (!can_redo()) return false;
  ++at_;
  return true;
}

}  // namespace kinetix::app::studio
