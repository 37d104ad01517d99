#include "model/lattice/origami/origami_sheet.hpp"

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

// Distance of a hinge from a vertex, ratio to its crease's length: below half of it
constexpr double most_of_crease = 0.42;
// Least distance of the two hinges of a crease that ends at the boundary, ratio to its length
constexpr double boundary_room = 0.25;
// Rad. Walls across creases are as short as the intervals of psi are narrow. If the interval with walls across the
// creases is below the first width, walls cross the extension of a crease beyond its vertex, which leaves more room. If
// that interval is below the second width, no walls fit.
constexpr double least_crossing_interval = 5 * radians_per_degree;
constexpr double least_psi_interval = 20 * radians_per_degree;

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Circle of bodies about an inner vertex. Creases point right, up, left, down.
struct Circle {
  double radius = 0, phi = 0, a = 0, b = 0, psi = 0;
  std::array<double, 4> beside = {};  ///< angle from each crease to the bodies next to it, rad
};

Circle circle_at(const QuadMesh& m, int i, int j, double share) {
  const Eigen::Vector4d sector = sectors(m, i, j);
  const Vector2d right = m.at(i + 1, j) - m.at(i, j);
  Circle c{0, std::atan2(right.y(), right.x()), sector[0], sector[1]};
  const auto [low, high] = psi_interval(c.a, c.b);
  if (!(low < high))
    throw InvalidInput("there is no room for bodies round vertex [" + std::to_string(i) + ", " +
                       std::to_string(j) + "]: its sectors of " + number_text(to_degrees(c.a)) + " and " +
                       number_text(to_degrees(c.b)) + " deg are too uneven. Give sectors from 20 to 160 deg");
  c.psi = (low + high) / 2;
  c.beside = {c.psi, c.a - c.psi, c.b - c.a + c.psi, pi - c.b - c.psi};
  const std::array<double, 4> lengths = {right.norm(), (m.at(i, j + 1) - m.at(i, j)).norm(),
                                         (m.at(i - 1, j) - m.at(i, j)).norm(),
                                         (m.at(i, j - 1) - m.at(i, j)).norm()};
  c.radius = share * *std::min_element(lengths.begin(), lengths.end());
  for (int k = 0; k < 4; ++k)
    if (const double along = std::cos(c.beside[k]); along > 0)
      c.radius = std::min(c.radius, most_of_crease * lengths[k] / along);
  return c;
}

/// Positions of all bodies, 2 columns x 2 rows of them.
class Places {
 public:
  Places(const QuadMesh& m, const OrigamiLayout& layout)
      : m_(m), layout_(layout), at_(static_cast<std::size_t>(4) * m.columns * m.rows) {
    for (int j = 1; j < m.rows; ++j)
      for (int i = 1; i < m.columns; ++i) add_circle(i, j);
    for (int j = 1; j < m.rows; ++j) add_sides(j);
    for (int i = 1; i < m.columns; ++i) add_ends(i);
    add_corners();
  }

  std::vector<Vector2d> take() { return std::move(at_); }

 private:
  Vector2d& at(int I, int J) { return at_[static_cast<std::size_t>(J) * 2 * m_.columns + I]; }

  void add_circle(int i, int j) {
    const Circle c = circle_at(m_, i, j, layout_.radius);
    circles_.push_back(c);
    const auto put = [&](int I, int J, double angle) {
      at(I, J) = m_.at(i, j) + c.radius * direction(c.phi + angle);
    };
    put(2 * i, 2 * j, c.psi);
    put(2 * i - 1, 2 * j, 2 * c.a - c.psi);
    put(2 * i - 1, 2 * j - 1, 2 * c.b + c.psi);
    put(2 * i, 2 * j - 1, -c.psi);
  }

  const Circle& circle(int i, int j) const {
    return circles_[static_cast<std::size_t>(j - 1) * (m_.columns - 1) + i - 1];
  }

  /// Places two bodies on both sides of a crease from an inner vertex to the boundary, near the boundary; the first
  /// is to its left.
  void straddle(const Vector2d& inner, const Vector2d& rim, const Circle& c, int crease, Vector2d& left,
                Vector2d& right) const {
    const Vector2d edge = rim - inner;
    const double length = edge.norm();
    const Vector2d along = edge / length, across(-along.y(), along.x());
    const double near = c.radius * std::cos(c.beside[crease]), half = c.radius * std::sin(c.beside[crease]);
    const double far = std::max(layout_.rim * length, near + boundary_room * length);
    left = inner + far * along + half * across;
    right = inner + far * along - half * across;
  }

  void add_sides(int j) {
    const int n = m_.columns;
    straddle(m_.at(1, j), m_.at(0, j), circle(1, j), 2, at(0, 2 * j - 1), at(0, 2 * j));
    straddle(m_.at(n - 1, j), m_.at(n, j), circle(n - 1, j), 0, at(2 * n - 1, 2 * j),
             at(2 * n - 1, 2 * j - 1));
  }

  void add_ends(int i) {
    const int r = m_.rows;
    straddle(m_.at(i, 1), m_.at(i, 0), circle(i, 1), 3, at(2 * i, 0), at(2 * i - 1, 0));
    straddle(m_.at(i, r - 1), m_.at(i, r), circle(i, r - 1), 1, at(2 * i - 1, 2 * r - 1),
             at(2 * i, 2 * r - 1));
  }

  void add_corners() {
    const int I = 2 * m_.columns - 1, J = 2 * m_.rows - 1;
    at(0, 0) = at(0, 1) + at(1, 0) - at(1, 1);
    at(I, 0) = at(I, 1) + at(I - 1, 0) - at(I - 1, 1);
    at(0, J) = at(0, J - 1) + at(1, J) - at(1, J - 1);
    at(I, J) = at(I, J - 1) + at(I - 1, J) - at(I - 1, J - 1);
  }

  const QuadMesh& m_;
  const OrigamiLayout& layout_;
  std::vector<Vector2d> at_;
  std::vector<Circle> circles_;
};

/// Crease that a wall from body (I, J) crosses: its direction, and the multiplier that tilts its hinge.
struct Crossed {
  Vector2d along = Vector2d::Zero();
  double multiplier = 0;
};

Crossed crossed(const QuadMesh& m, int I, int J, bool rightwards) {
  if (rightwards && I % 2 == 1) {
    const int i = (I + 1) / 2, j = J / 2;
    return {m.at(i, j + 1) - m.at(i, j), -m.rising[m.rising_crease(i, j)]};
  }
  if (!rightwards && J % 2 == 1) {
    const int i = I / 2, j = (J + 1) / 2;
    return {m.at(i + 1, j) - m.at(i, j), m.level[m.level_crease(i, j)]};
  }
  return {};
}

/// Returns the tilt of the hinge on a wall across a crease. Its axis leans along the crease by -sense c, as the wall
/// leans by beta relative to z x e.
double tilt(const Crossed& crease, const Vector2d& wall, int sense) {
  if (crease.multiplier == 0) return 0;
  const Vector2d across(-wall.y(), wall.x());
  return std::atan(sense * crease.multiplier * (crease.along.dot(across) > 0 ? 1 : -1));
}

QuadMesh scaled(QuadMesh mesh, double scale) {
  for (Vector2d& vertex : mesh.vertices) vertex *= scale;
  return mesh;
}

struct Walls {
  std::vector<GraphEdge> edges;
  std::vector<Crossed> creases;
};

Walls walls_of(const QuadMesh& m) {
  Walls out;
  const int I = 2 * m.columns, J = 2 * m.rows;
  for (int j = 0; j < J; ++j)
    for (int i = 0; i < I; ++i)
      for (const bool rightwards : {true, false}) {
        const int to_i = i + rightwards, to_j = j + !rightwards;
        if (to_i >= I || to_j >= J) continue;
        out.edges.push_back({j * I + i, to_j * I + to_i});
        out.creases.push_back(crossed(m, i, j, rightwards));
      }
  return out;
}

double mean_wall(const std::vector<Vector2d>& places, const std::vector<GraphEdge>& edges) {
  double sum = 0;
  for (const auto& [from, to] : edges) sum += (places[to] - places[from]).norm();
  return sum / static_cast<double>(edges.size());
}

}  // namespace

void OrigamiLayout::validate() const {
  require("radius", radius, radius > 0 && radius <= 0.36, "in (0, 0.36]");
  require("rim", rim, rim > 0 && rim < 1, "in (0, 1)");
}

std::array<double, 2> psi_interval(double a, double b) {
  const double low = std::max(0.0, a - b), high = std::min(a, pi - b);
  const double crossing_low = std::max({low, a - pi / 2, pi / 2 - b}),
               crossing_high = std::min({high, pi / 2, pi / 2 - b + a});
  if (crossing_high - crossing_low >= least_crossing_interval) return {crossing_low, crossing_high};
  if (high - low >= least_psi_interval) return {low, high};
  return {0, 0};
}

OrigamiSheet origami_sheet(const QuadMesh& mesh, const CellSize& size, const OrigamiLayout& layout) {
  layout.validate();
  validate(mesh);
  if (mesh.columns < 2 || mesh.rows < 2)
    throw InvalidInput("a sheet with creases needs at least 2 x 2 facets");
  std::vector<Vector2d> places = Places(mesh, layout).take();
  Walls walls = walls_of(mesh);
  const double scale = 1 / mean_wall(places, walls.edges);
  for (Vector2d& place : places) place *= scale;
  OrigamiSheet out;
  out.structure = make_planar_structure({std::move(places), std::move(walls.edges)}, size);
  out.mesh = scaled(mesh, scale);
  PlanarStructure& s = out.structure;
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    s.hinges[h].beta =
        tilt(walls.creases[h], s.graph.along(static_cast<int>(h)), s.senses[s.graph.edges[h].from]);
  for (int j = 0; j < 2 * mesh.rows; ++j)
    for (int i = 0; i < 2 * mesh.columns; ++i) out.facet.push_back({i / 2, j / 2});
  return out;
}

State fold(const OrigamiSheet& sheet, double theta) {
  const double shrunk = std::cos(theta), edge_mm = sheet.structure.size.edge_mm;
  const QuadMesh mesh = scaled(sheet.mesh, shrunk);
  const FoldedMesh folded = fold_facets(mesh, std::sin(theta));
  State state(sheet.facet.size());
  for (std::size_t b = 0; b < state.size(); ++b) {
    const auto [i, j] = sheet.facet[b];
    const Eigen::Matrix3d& frame = folded.frames[mesh.facet(i, j)];
    const Vector2d from_corner = shrunk * sheet.structure.graph.vertices[b] - mesh.at(i, j);
    state[b].p = edge_mm * (folded.vertices[mesh.vertex(i, j)] + frame.leftCols<2>() * from_corner);
    const double turn = sheet.structure.senses[b] * theta;
    state[b].R = frame * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  return state;
}

}  // namespace kinetix::model
