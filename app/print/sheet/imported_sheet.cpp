#include "app/print/sheet/imported_sheet.hpp"

#include <array>

#include "app/pipeline/pipeline.hpp"
#include "model/assembly/assembly.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

/// Sorts the corners of a soft part: first those on the first body's side, then as many on the other's. Each half
/// moves with its body. Corners that no triangle uses fill the shorter half.
model::Polyhedron in_halves(const model::AssemblyHinge& hinge) {
  std::array<std::vector<int>, 2> sides;
  for (int p = 0; p < static_cast<int>(hinge.soft.points.size()); ++p)
    sides[hinge.along.dot(hinge.soft.points[p] - hinge.point) > 0 ? 1 : 0].push_back(p);
  const std::size_t half = std::max(sides[0].size(), sides[1].size());
  model::Polyhedron out;
  std::vector<int> place(hinge.soft.points.size());
  for (const std::vector<int>& side : sides) {
    for (const int p : side) place[p] = out.add_point(hinge.soft.points[p]);
    for (std::size_t k = side.size(); k < half; ++k)
      out.add_point(side.empty() ? hinge.point : hinge.soft.points[side.front()]);
  }
  for (const auto& t : hinge.soft.triangles) out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return out;
}

model::Polyhedron about(model::Polyhedron solid, const Eigen::Vector3d& origin) {
  for (Eigen::Vector3d& p : solid.points) p -= origin;
  return solid;
}

model::HingePrint print_of(const model::AssemblyHinge& h) {
  model::HingePrint print;
  print.made.kind = h.kind;
  print.made.clearance_mm = h.clearance_mm;
  print.made.gap_mm = print.made.thickness_mm = print.made.height_mm = print.made.diameter_mm =
      1;  // the mesh has the sizes
  return print;
}

/// Adds the motion to a sheet. A motion that ends before the drive's goal has no folded state, which a warning
/// reports.
/// @throws InvalidInput in this case if the folded state is requested
void add_way(const Run& run, bool folded, PrintSheet& sheet) {
  for (const NamedState& s : run.states)
    if (s.name == "frame") {
      sheet.path.push_back(s.poses);
      sheet.thetas.push_back(s.theta);
    }
  if (run.way->reached) return;
  const std::string why = "it does not come to its drive's goal: " + run.way->words;
  if (folded) throw InvalidInput("--state folded: " + why);
  sheet.warnings.push_back(why);
}

}  // namespace

PrintSheet imported_sheet(const Design& design, const model::Process& process, bool folded) {
  PrintSheet sheet;
  sheet.name = design.name;
  sheet.process = process;
  sheet.linkage = design.structure;
  const model::Assembly& a = *design.structure.assembly();
  for (const model::AssemblyBody& b : a.bodies) sheet.meshes.push_back(about(b.solid, b.position));
  for (const model::AssemblyHinge& h : a.hinges) {
    sheet.hinges.push_back(print_of(h));
    sheet.imported_k.push_back(h.k);
    sheet.soft.push_back(h.soft.points.empty() ? model::Polyhedron{}
                                               : about(in_halves(h), a.bodies[h.lower].position));
  }
  sheet.bodies.resize(a.bodies.size());
  sheet.rods.resize(a.hinges.size());
  sheet.tiles.of_body.assign(a.bodies.size(), 0);
  add_way(run_design(design, Model::exact, {}), folded, sheet);
  sheet.warnings.push_back("parts are written as they were imported: nothing was checked for a process");
  return sheet;
}

}  // namespace kinetix::app
