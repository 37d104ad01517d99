#include "optim/surface/surface_problem.hpp"

#include <ceres/jet.h>
#include <ceres/rotation.h>
#include <limits>

namespace kinetix::optim {

int SurfaceVariables::size() const {
  const int p = columns - 1, q = rows - 1;
  return p + q + q + (p - 1) + (p - 1) + (q - 1) + 2 * q + 2 * p + 8 + 7;
}

Eigen::VectorXd variables_of(const SurfaceVariables& v, const model::MarchData& d, double layer) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(v.size());
  int at = 0;
  for (const auto* multipliers : {&d.rising, &d.level})
    for (const double c : *multipliers) x[at++] = std::log(std::abs(c));
  for (const double angle : d.left_angle) x[at++] = angle;
  for (std::size_t i = 1; i < d.bottom_angle.size(); ++i) x[at++] = d.bottom_angle[i];
  for (const auto* lengths : {&d.bottom_length, &d.left_length, &d.west, &d.east, &d.south, &d.north})
    for (const double length : *lengths) x[at++] = length / v.unit;
  for (const auto& corner : d.corners)
    for (int k = 0; k < 2; ++k) x[at++] = corner[k] / v.unit;
  x[at] = layer / v.unit;
  return x;
}

namespace {

using Eigen::Vector3d;

/// Directions, middle and size of a folded sheet.
struct Laid {
  Eigen::Matrix3d axes;  ///< columns: along its rows, along its columns, normal
  Vector3d middle;
  Eigen::Vector2d size;  ///< along rows and columns
};

Laid lay(const model::QuadMesh& m, const model::FoldedMesh& folded) {
  Vector3d left = Vector3d::Zero(), right = left, low = left, high = left, all = left;
  const auto at = [&](int i, int j) { return folded.vertices[m.vertex(i, j)]; };
  for (int j = 0; j <= m.rows; ++j) left += at(0, j) / (m.rows + 1), right += at(m.columns, j) / (m.rows + 1);
  for (int i = 0; i <= m.columns; ++i)
    low += at(i, 0) / (m.columns + 1), high += at(i, m.rows) / (m.columns + 1);
  for (const Vector3d& vertex : folded.vertices) all += vertex / static_cast<double>(folded.vertices.size());
  const Vector3d along = right - left, up = high - low;
  Laid out;
  out.middle = all;
  out.size = {along.norm(), up.norm()};
  out.axes.col(2) = along.cross(up).normalized();
  out.axes.col(0) = along.normalized();
  out.axes.col(1) = out.axes.col(2).cross(out.axes.col(0));
  return out;
}

void scale(model::MarchData& d, double along, double up) {
  for (auto* lengths : {&d.bottom_length, &d.west, &d.east})
    for (double& length : *lengths) length *= along;
  for (auto* lengths : {&d.left_length, &d.south, &d.north})
    for (double& length : *lengths) length *= up;
}

model::MarchData signed_miura(int columns, int rows, const MiuraStart& start) {
  model::MarchData d = model::miura(columns, rows, start.angle, start.fold);
  for (double& c : d.rising) c *= start.side;
  for (double& c : d.level) c *= start.side;
  if (start.turn > 0) return d;
  for (double& c : d.level) c = -c;
  for (auto* angles : {&d.left_angle, &d.bottom_angle})
    for (double& angle : *angles) angle = pi - angle;
  return d;
}

int sign_of(double x) { return x < 0 ? -1 : 1; }

}  // namespace

SurfaceStart start_on(const targets::SurfacePatch& patch, int columns, int rows, const MiuraStart& miura) {
  model::MarchData data = signed_miura(columns, rows, miura);
  Laid laid;
  for (int pass = 0; pass < 2; ++pass) {
    const model::MarchedMesh<double> marched = march(data);
    laid = lay(marched.mesh, fold_facets(marched.mesh, 1.0));
    if (pass == 0) scale(data, 2 * patch.half.x() / laid.size.x(), 2 * patch.half.y() / laid.size.y());
  }
  const model::MarchedMesh<double> marched = march(data);
  const model::FoldedMesh folded = fold_facets(marched.mesh, 1.0);
  SurfaceStart out;
  SurfaceVariables& v = out.variables;
  v.columns = columns;
  v.rows = rows;
  v.unit = mean_edge(marched.mesh);
  for (const double c : data.rising) v.rising_sign.push_back(sign_of(c));
  for (const double c : data.level) v.level_sign.push_back(sign_of(c));
  const std::size_t facet = marched.mesh.facet(columns / 2, rows / 2);
  const Vector3d corner = folded.vertices[marched.mesh.vertex(columns / 2, rows / 2)];
  v.turn = laid.axes.transpose() * folded.frames[facet];
  v.shift = laid.axes.transpose() * (corner - laid.middle);
  const double above = laid.axes.col(2).dot(folded.vertices[marched.mesh.vertex(1, 1)] - laid.middle);
  const double under = laid.axes.col(2).dot(folded.vertices[marched.mesh.vertex(2, 1)] - laid.middle);
  out.x = variables_of(v, data, (above - under) / 2);
  return out;
}

/// Appends residuals one after the other.
template <class T>
class Residuals {
 public:
  Residuals(T* at, double scale) : at_(at), scale_(scale) {}
  void add(const T& value) { *at_++ = value * T(scale_); }
  const T* end() const { return at_; }

 private:
  T* at_;
  double scale_;
};

namespace {

using Eigen::Vector2d;

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

constexpr int lanes = 16;  // derivatives per pass: a dual number then fills few registers
using Dual = ceres::Jet<double, lanes>;

constexpr double extent_weight = 3;  // weight of the sides' mean places relative to a vertex's distance
constexpr double bound_weight = 3;   // weight of violating a bound by a rad or a mean edge, relative to a
                                     // diagonal of distance
constexpr double min_sine = 0.4;     // of a facet's corner: sharper ones leave no room for bodies at the rim
constexpr double inside = 0.2 * radians_per_degree;  // rad: larger than the violation of a bound by least
                                                     // squares
constexpr double inside_edge = 0.004;                // of the mean edge: larger than the violation of its
                                                     // bound

double value_of(double x) { return x; }
double value_of(const Dual& x) { return x.a; }

double carried(const targets::ClosestSurfacePoint& closest, const Vector3d&) { return closest.distance; }
Dual carried(const targets::ClosestSurfacePoint& closest, const Vector3<Dual>& p) {
  Dual out(closest.distance);
  for (int k = 0; k < 3; ++k) out.v += closest.normal[k] * p[k].v;
  return out;
}

/// Returns the distance of a point from the surface; its derivative is the normal at the closest point.
template <class T>
T distance(const targets::SurfacePatch& patch, const Vector3<T>& p) {
  return carried(closest_surface_point(patch, {value_of(p.x()), value_of(p.y()), value_of(p.z())}), p);
}

template <class T>
T above(const T& x, double most) {
  return value_of(x) > most ? T(x - T(most)) : T(0);
}
template <class T>
T below(const T& x, double least) {
  return value_of(x) < least ? T(T(least) - x) : T(0);
}

template <class T>
std::vector<Vector3<T>> placed(const SurfaceVariables& v, const model::QuadMeshOf<T>& mesh, const T* pose) {
  const model::FoldedMeshOf<T> folded = fold_facets(mesh, T(1));
  const int i = v.columns / 2, j = v.rows / 2;
  const Eigen::Matrix<T, 3, 3> back = folded.frames[mesh.facet(i, j)].transpose();
  const Vector3<T> corner = folded.vertices[mesh.vertex(i, j)];
  Eigen::Matrix<T, 3, 3> turn;
  ceres::AngleAxisToRotationMatrix(pose, turn.data());
  const Eigen::Matrix<T, 3, 3> onto = turn * v.turn.cast<T>() * back;
  Vector3<T> shift = v.shift.cast<T>();
  for (int k = 0; k < 3; ++k) shift[k] += pose[3 + k] * T(v.unit);
  std::vector<Vector3<T>> out;
  for (const Vector3<T>& vertex : folded.vertices) out.push_back(onto * (vertex - corner) + shift);
  return out;
}

template <class T>
void add_sectors(const model::MarchedMesh<T>& marched, const MeshBounds& bounds, Residuals<T>& out) {
  for (const auto& vertex : marched.inner)
    for (const T& angle : {vertex.a, vertex.b})
      out.add(T(bound_weight) *
              (above(angle, bounds.sector[1] - inside) + below(angle, bounds.sector[0] + inside)));
}

/// Returns lengths along the creases in the direction of the march; they are negative for inverted facets.
template <class T>
std::vector<T> edge_lengths(const model::MarchedMesh<T>& marched) {
  const model::QuadMeshOf<T>& m = marched.mesh;
  std::vector<T> out;
  for (int j = 0; j <= m.rows; ++j)
    for (int i = 0; i <= m.columns; ++i)
      for (const bool level : {true, false}) {
        const int to_i = i + level, to_j = j + !level;
        if (to_i > m.columns || to_j > m.rows) continue;
        const Eigen::Matrix<T, 2, 1> edge = m.at(to_i, to_j) - m.at(i, j);
        const bool inner = i > 0 && j > 0 && i < m.columns && j < m.rows;
        using std::cos, std::sin, std::sqrt;
        if (inner) {
          const auto& at = marched.at(i - 1, j - 1);
          const T angle = level ? at.phi : T(at.phi + at.a);
          out.push_back(edge.x() * cos(angle) + edge.y() * sin(angle));
        } else {
          out.push_back(sqrt(edge.squaredNorm() + T(1e-300)));
        }
      }
  return out;
}

template <class T>
void add_edges(const model::MarchedMesh<T>& marched, const MeshBounds& bounds, Residuals<T>& out) {
  const std::vector<T> lengths = edge_lengths(marched);
  T mean(0);
  for (const T& length : lengths) mean += length;
  mean /= T(static_cast<double>(lengths.size()));
  for (const T& length : lengths)
    out.add(T(bound_weight) * (above<T>(length / mean, bounds.edge[1] - inside_edge) +
                               below<T>(length / mean, bounds.edge[0] + inside_edge)));
}

/// Adds residuals that keep facets convex: the sine of each corner is at least min_sine.
template <class T>
void add_corners(const model::QuadMeshOf<T>& m, Residuals<T>& out) {
  using std::sqrt;
  for (int j = 0; j < m.rows; ++j)
    for (int i = 0; i < m.columns; ++i) {
      const Eigen::Matrix<T, 2, 1> corners[] = {m.at(i, j), m.at(i + 1, j), m.at(i + 1, j + 1),
                                                m.at(i, j + 1)};
      for (int k = 0; k < 4; ++k) {
        const Eigen::Matrix<T, 2, 1> in = corners[(k + 1) % 4] - corners[k];
        const Eigen::Matrix<T, 2, 1> on = corners[(k + 2) % 4] - corners[(k + 1) % 4];
        const T sine =
            (in.x() * on.y() - in.y() * on.x()) / sqrt(in.squaredNorm() * on.squaredNorm() + T(1e-300));
        out.add(T(bound_weight) * below(sine, min_sine));
      }
    }
}

}  // namespace

SurfaceProblem::SurfaceProblem(const targets::SurfacePatch& patch, const SurfaceVariables& variables,
                               const MeshBounds& bounds, double rim)
    : patch_(patch),
      variables_(variables),
      bounds_(bounds),
      boundary_weight_(rim),
      diagonal_(patch.diagonal()) {
  const int n = variables.columns, r = variables.rows, p = n - 1, q = r - 1;
  residuals_ =
      (n + 1) * (r + 1) + 2 * (n + 1) + 2 * (r + 1) + 4 + 2 * p * q + model::mesh_edges(n, r) + 4 * n * r;
  constexpr double none = std::numeric_limits<double>::infinity();
  lower_ = Eigen::VectorXd::Constant(variables.size(), -none);
  upper_ = Eigen::VectorXd::Constant(variables.size(), none);
  lower_.head(p + q).setConstant(std::log(bounds.min_fold));
  upper_.head(p + q).setConstant(std::log(bounds.multiplier));
}

template <class T>
void SurfaceProblem::fill(const T* x, T* r) const {
  const model::MarchedMesh<T> marched = march(march_data(variables_, x));
  const model::QuadMeshOf<T>& mesh = marched.mesh;
  const T* pose = x + variables_.layer() + 1;
  const T layer = x[variables_.layer()] * T(variables_.unit);
  const std::vector<Vector3<T>> vertices = placed(variables_, mesh, pose);
  Residuals<T> out(r, 1 / std::sqrt(static_cast<double>(vertices.size())));
  for (int j = 0; j <= mesh.rows; ++j)
    for (int i = 0; i <= mesh.columns; ++i)
      out.add((distance(patch_, vertices[mesh.vertex(i, j)]) - T(layer_of(i)) * layer) / T(diagonal_));
  const auto add_boundary = [&](int i, int j, int axis, double side) {
    out.add(T(boundary_weight_ / diagonal_) *
            (vertices[mesh.vertex(i, j)][axis] - T(side * patch_.half[axis])));
  };
  for (int i = 0; i <= mesh.columns; ++i) add_boundary(i, 0, 1, -1), add_boundary(i, mesh.rows, 1, 1);
  for (int j = 0; j <= mesh.rows; ++j) add_boundary(0, j, 0, -1), add_boundary(mesh.columns, j, 0, 1);
  add_extent(vertices, out);
  add_sectors(marched, bounds_, out);
  add_edges(marched, bounds_, out);
  add_corners(mesh, out);
}

/// Adds residuals that put the mean of each side of the sheet on the surface's side.
template <class T, class Out>
void SurfaceProblem::add_extent(const std::vector<Vector3<T>>& vertices, Out& out) const {
  const int n = variables_.columns, r = variables_.rows;
  std::array<T, 4> mean = {T(0), T(0), T(0), T(0)};
  const auto at = [&](int i, int j) -> const Vector3<T>& {
    return vertices[static_cast<std::size_t>(j) * (n + 1) + i];
  };
  for (int j = 0; j <= r; ++j) mean[0] += at(0, j).x() / T(r + 1.0), mean[1] += at(n, j).x() / T(r + 1.0);
  for (int i = 0; i <= n; ++i) mean[2] += at(i, 0).y() / T(n + 1.0), mean[3] += at(i, r).y() / T(n + 1.0);
  for (int k = 0; k < 4; ++k)
    out.add(T(extent_weight / diagonal_) * (mean[k] - T((k % 2 == 0 ? -1 : 1) * patch_.half[k / 2])));
}

bool SurfaceProblem::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const {
  r.resize(residuals_);
  fill(x.data(), r.data());
  if (!r.allFinite()) return false;
  if (!J) return true;
  J->resize(residuals_, x.size());
  std::vector<Dual> at(x.size()), out(residuals_);
  for (int first = 0; first < x.size(); first += lanes) {
    const int count = std::min<int>(lanes, static_cast<int>(x.size()) - first);
    for (int k = 0; k < x.size(); ++k) at[k] = Dual(x[k]);
    for (int k = 0; k < count; ++k) at[first + k].v[k] = 1;
    fill(at.data(), out.data());
    for (int row = 0; row < residuals_; ++row)
      for (int k = 0; k < count; ++k) (*J)(row, first + k) = out[row].v[k];
  }
  return J->allFinite();
}

std::vector<Vector3d> placed_vertices(const SurfaceVariables& v, const Eigen::VectorXd& x) {
  const model::MarchedMesh<double> marched = march(march_data(v, x.data()));
  return placed<double>(v, marched.mesh, x.data() + v.layer() + 1);
}

}  // namespace kinetix::optim
