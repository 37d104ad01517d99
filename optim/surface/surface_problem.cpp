#include "optim/surface/surface_problem.hpp"

#include <ceres/jet.h>
#include <ceres/rotation.h>

#include <limits>

namespace kinetix::optim {

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
using Eigen::Vector3d;

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

constexpr int lanes = 16;  // derivatives per pass: a dual number then fills few registers
using Dual = ceres::Jet<double, lanes>;

constexpr double extent_weight = 3;  // weight of the sides' mean places relative to a vertex's distance
constexpr double bound_weight = 3;   // weight of violating a bound by a rad or a mean edge, relative to a
                                     // diagonal of distance
constexpr double least_sine = 0.4;   // of a facet's corner: sharper ones leave no room for bodies at the rim
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

/// Adds residuals that keep facets convex: the sine of each corner is at least least_sine.
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
        out.add(T(bound_weight) * below(sine, least_sine));
      }
    }
}

}  // namespace

SurfaceProblem::SurfaceProblem(const targets::SurfacePatch& patch, const SurfaceVariables& variables,
                               const MeshBounds& bounds, double rim)
    : patch_(patch), variables_(variables), bounds_(bounds), rim_(rim), diagonal_(patch.diagonal()) {
  const int n = variables.columns, r = variables.rows, p = n - 1, q = r - 1;
  residuals_ =
      (n + 1) * (r + 1) + 2 * (n + 1) + 2 * (r + 1) + 4 + 2 * p * q + model::mesh_edges(n, r) + 4 * n * r;
  constexpr double none = std::numeric_limits<double>::infinity();
  lower_ = Eigen::VectorXd::Constant(variables.size(), -none);
  upper_ = Eigen::VectorXd::Constant(variables.size(), none);
  lower_.head(p + q).setConstant(std::log(bounds.least_fold));
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
  const auto add_rim = [&](int i, int j, int axis, double side) {
    out.add(T(rim_ / diagonal_) * (vertices[mesh.vertex(i, j)][axis] - T(side * patch_.half[axis])));
  };
  for (int i = 0; i <= mesh.columns; ++i) add_rim(i, 0, 1, -1), add_rim(i, mesh.rows, 1, 1);
  for (int j = 0; j <= mesh.rows; ++j) add_rim(0, j, 0, -1), add_rim(mesh.columns, j, 0, 1);
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
