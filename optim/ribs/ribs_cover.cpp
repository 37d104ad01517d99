#include "optim/ribs/ribs_cover.hpp"

#include <cmath>

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr double cover_points = 5000;  // over a whole surface: shares are then accurate to half a percent

targets::TriangleTree folded_cells(const model::Structure& structure, const model::State& state,
                                   const targets::MeshDistance& surface, double clearance_mm) {
  targets::TriangleMesh mesh;
  for (const model::Pose& pose : state)
    mesh.vertices.push_back(pose.p - clearance_mm * surface.closest(pose.p).normal);
  for (const model::CellHinges& cell : structure.cell_members) {
    const auto& b = cell.bodies;
    mesh.triangles.push_back({b[0], b[1], b[2]});
    mesh.triangles.push_back({b[0], b[2], b[3]});
  }
  return targets::TriangleTree(mesh);
}

using Corners = std::array<Vector3d, 3>;

/// Halves a triangle across its longest side until no side is longer than `most`. Calls visit(middle, area)
/// for each part.
template <class Visit>
void visit_parts(const Corners& corners, double most, const Visit& visit) {
  const auto& [a, b, c] = corners;
  const std::array<double, 3> sides = {(b - a).norm(), (c - b).norm(), (a - c).norm()};
  const auto longest = std::max_element(sides.begin(), sides.end()) - sides.begin();
  if (!(sides[longest] > most)) return visit(Vector3d((a + b + c) / 3), (b - a).cross(c - a).norm() / 2);
  const Vector3d &from = corners[longest], &to = corners[(longest + 1) % 3],
                 &other = corners[(longest + 2) % 3];
  const Vector3d middle = (from + to) / 2;
  visit_parts({from, middle, other}, most, visit);
  visit_parts({middle, to, other}, most, visit);
}

double area_of(const targets::TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += area_normal(mesh, t).norm() / 2;
  return area;
}

}  // namespace

RibsReach::RibsReach(const model::Structure& structure, const model::State& state,
                     const targets::MeshDistance& surface, double clearance_mm)
    : edge_mm_(structure.size.edge_mm), cells_(folded_cells(structure, state, surface, clearance_mm)) {}

double RibsReach::distance(const Vector3d& p) const { return std::sqrt(cells_.nearest(p).squared_distance); }

std::vector<std::vector<Vector3d>> uncovered_parts(const RibsReach& ribs, const std::vector<Vector3d>& line) {
  std::vector<std::vector<Vector3d>> out;
  bool goes_on = false;
  for (const Vector3d& p : line) {
    const bool is_bare = ribs.distance(p) > ribs.edge_mm();
    if (is_bare && !goes_on) out.emplace_back();
    if (is_bare) out.back().push_back(p);
    goes_on = is_bare;
  }
  std::erase_if(out, [](const auto& part) { return part.size() < 2; });
  return out;
}

RibsCover cover_by(const RibsReach& ribs, const targets::TriangleMesh& surface, double lowest_z) {
  RibsCover out;
  double area = 0, near = 0, squares = 0;
  // A right triangle with sides of at most this length has at most half its square as area.
  const double side = std::sqrt(2 * area_of(surface) / cover_points);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    visit_parts({surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)}, side,
                [&](const Vector3d& p, double part) {
                  if (!(part > 0) || p.z() < lowest_z) return;
                  const double apart = ribs.distance(p);
                  area += part;
                  squares += part * apart * apart;
                  out.max = std::max(out.max, apart);
                  if (apart <= ribs.edge_mm()) near += part;
                });
  if (!(area > 0)) return out;
  out.share = near / area;
  out.rms = std::sqrt(squares / area);
  return out;
}

}  // namespace kinetix::optim
