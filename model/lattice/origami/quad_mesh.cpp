#include "model/lattice/origami/quad_mesh.hpp"

#include <Eigen/Geometry>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// Rad, and a ratio: files have vertices of six or more digits; the remaining error opens separations below print
// resolution.
constexpr double angle_slack = 1e-4, closing_slack = 1e-3;

std::string name_of(const char* what, int i, int j) {
  return std::string(what) + " [" + std::to_string(i) + ", " + std::to_string(j) + "]";
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double turn(const Vector2d& from, const Vector2d& to) {
  const double angle = std::atan2(cross(from, to), from.dot(to));
  return angle < 0 ? angle + 2 * pi : angle;
}

void check_sizes(const QuadMesh& m) {
  const auto n = static_cast<std::size_t>(m.columns), r = static_cast<std::size_t>(m.rows);
  if (m.columns < 1 || m.rows < 1) throw InvalidInput("a mesh needs at least one facet");
  if (m.vertices.size() != (n + 1) * (r + 1) || m.rising.size() != (n - 1) * r ||
      m.level.size() != n * (r - 1))
    throw InvalidInput("a mesh of facets has one point per vertex and one multiplier per crease");
}

void check_facet(const QuadMesh& m, int i, int j) {
  const Vector2d corners[] = {m.at(i, j), m.at(i + 1, j), m.at(i + 1, j + 1), m.at(i, j + 1)};
  for (int k = 0; k < 4; ++k) {
    const Vector2d in = corners[(k + 1) % 4] - corners[k], out = corners[(k + 2) % 4] - corners[(k + 1) % 4];
    if (!std::isfinite(in.norm()))
      throw InvalidInput(name_of("facet", i, j) + " has corners that are not finite");
    if (!(cross(in, out) > 0))
      throw InvalidInput(name_of("facet", i, j) +
                         " is reversed or not convex. Give its corners counter-clockwise");
  }
}

/// Checks both halves of the vertex law: crease lines keep |c|, and their ratio follows from the sectors.
void check_multipliers(const QuadMesh& m, int i, int j, const Eigen::Vector4d& sector) {
  const double right = m.level[m.level_crease(i, j)], left = m.level[m.level_crease(i - 1, j)];
  const double up = m.rising[m.rising_crease(i, j)], down = m.rising[m.rising_crease(i, j - 1)];
  const double a = sector[0], b = sector[1], size = std::max(std::abs(right), std::abs(up));
  const double level = std::sin((a - b) / 2) / std::sin((a + b) / 2);
  const double rising = -std::cos((a + b) / 2) / std::cos((a - b) / 2);
  const auto off = [&](double x) { return std::abs(x) / size; };
  const double first = std::max({off(right - level * up), off(right + left), off(up - down)});
  const double second = std::max({off(up - rising * right), off(up + down), off(right - left)});
  if (!(std::min(first, second) <= closing_slack) && size > 0)
    throw InvalidInput("fold multipliers do not close round " + name_of("vertex", i, j));
}

void check_vertex(const QuadMesh& m, int i, int j) {
  const Eigen::Vector4d sector = sectors(m, i, j);
  if (!(std::abs(sector[0] + sector[2] - pi) <= angle_slack))
    throw InvalidInput(name_of("vertex", i, j) + " is not flat-foldable: opposite sectors add up to " +
                       number_text(to_degrees(sector[0] + sector[2])) + " deg, must be 180");
  check_multipliers(m, i, j, sector);
}

}  // namespace

Eigen::Vector4d sectors(const QuadMesh& m, int i, int j) {
  const Vector2d& at = m.at(i, j);
  const Vector2d right = m.at(i + 1, j) - at, up = m.at(i, j + 1) - at;
  const Vector2d left = m.at(i - 1, j) - at, down = m.at(i, j - 1) - at;
  return {turn(right, up), turn(up, left), turn(left, down), turn(down, right)};
}

void validate(const QuadMesh& m) {
  check_sizes(m);
  for (int j = 0; j < m.rows; ++j)
    for (int i = 0; i < m.columns; ++i) check_facet(m, i, j);
  for (int j = 1; j < m.rows; ++j)
    for (int i = 1; i < m.columns; ++i) check_vertex(m, i, j);
}

double mean_edge(const QuadMesh& m) {
  double sum = 0;
  int count = 0;
  for (int j = 0; j <= m.rows; ++j)
    for (int i = 0; i <= m.columns; ++i) {
      if (i < m.columns) sum += (m.at(i + 1, j) - m.at(i, j)).norm(), ++count;
      if (j < m.rows) sum += (m.at(i, j + 1) - m.at(i, j)).norm(), ++count;
    }
  return sum / count;
}

namespace {

/// Returns the largest distance of a facet's three other corners from their positions by its first corner and frame.
double corner_gap(const QuadMesh& m, const FoldedMesh& folded, int i, int j) {
  double gap = 0;
  const Eigen::Matrix3d& R = folded.frames[m.facet(i, j)];
  for (const auto& [u, v] : {std::pair(i + 1, j), std::pair(i, j + 1), std::pair(i + 1, j + 1)}) {
    const Eigen::Vector2d edge = m.at(u, v) - m.at(i, j);
    const Eigen::Vector3d carried = folded.vertices[m.vertex(i, j)] + R.leftCols<2>() * edge;
    gap = std::max(gap, (folded.vertices[m.vertex(u, v)] - carried).norm());
  }
  return gap;
}

double frame_gap(const QuadMesh& m, const FoldedMesh& folded, double tau, int i, int j) {
  const Eigen::Vector2d crease = m.at(i, j + 1) - m.at(i, j);
  const Eigen::Matrix3d turned = folded.frames[m.facet(i - 1, j)] *
                                 crease_rotation<double>(crease, -m.rising[m.rising_crease(i, j)] * tau);
  return (folded.frames[m.facet(i, j)] - turned).cwiseAbs().maxCoeff();
}

}  // namespace

double fold_gap(const QuadMesh& m, double theta) {
  const double tau = std::sin(theta), unit = mean_edge(m);
  const FoldedMesh folded = fold_facets(m, tau);
  double gap = 0;
  for (int j = 0; j < m.rows; ++j)
    for (int i = 0; i < m.columns; ++i) {
      gap = std::max(gap, corner_gap(m, folded, i, j) / unit);
      if (i > 0) gap = std::max(gap, frame_gap(m, folded, tau, i, j));
    }
  return gap;
}

}  // namespace kinetix::model
