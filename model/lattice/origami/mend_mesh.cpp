#include "model/lattice/origami/crease_signs.hpp"

#include <Eigen/SparseCore>
#include <array>

#include "model/base/decompositions.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int most_mending_steps = 20;  // of Newton's method: patterns that can be mended need some five
constexpr double mended_residual =
    1e-12;  // rad and logarithm of a ratio: rounding of some hundred operations
constexpr double dependent_conditions =
    1e-12;  // added to the matrix of conditions, whose entries are about 1

/// One condition: its value, and its derivatives by coordinates.
struct Condition {
  double value = 0;
  std::vector<std::pair<int, double>> slopes = {};

  void add(double factor, const Condition& other) {
    value += factor * other.value;
    for (const auto& [coordinate, slope] : other.slopes) slopes.emplace_back(coordinate, factor * slope);
  }
};

/// Conditions of a mesh whose vertices move.
class Mending {
 public:
  Mending(const QuadMesh& mesh, const VertexName& name)
      : given_(mesh), m_(mesh), name_(name), p_(mesh.columns - 1), q_(mesh.rows - 1), edge_(mean_edge(mesh)) {
    for (Vector2d& vertex : given_.vertices) vertex /= edge_;
    m_.vertices = given_.vertices;
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i) flips_.push_back(level_flips(mesh, i, j));
  }

  MendedMesh run() {
    for (int step = 0; step < most_mending_steps && residual() > 0; ++step) {
      const bool is_last = residual_ <= mended_residual;
      move();
      if (is_last) break;
    }
    if (!(residual() <= 1e3 * mended_residual)) refuse();
    MendedMesh out;
    for (std::size_t v = 0; v < m_.vertices.size(); ++v)
      out.moved = std::max(out.moved, (m_.vertices[v] - given_.vertices[v]).norm());
    if (!(out.moved <= most_moved)) refuse();
    set_multipliers();
    for (Vector2d& vertex : m_.vertices) vertex *= edge_;
    out.mesh = m_;
    return out;
  }

 private:
  bool flips(int i, int j) const { return flips_[static_cast<std::size_t>(j - 1) * p_ + i - 1]; }

  /// Returns the angle of the direction from a vertex to a neighbour, rad.
  Condition angle(int i, int j, int to_i, int to_j) const {
    const Vector2d along = m_.at(to_i, to_j) - m_.at(i, j);
    const Vector2d slope = Vector2d(-along.y(), along.x()) / along.squaredNorm();
    const int from = 2 * static_cast<int>(m_.vertex(i, j)), to = 2 * static_cast<int>(m_.vertex(to_i, to_j));
    return {std::atan2(along.y(), along.x()),
            {{to, slope.x()}, {to + 1, slope.y()}, {from, -slope.x()}, {from + 1, -slope.y()}}};
  }

  /// Returns the angles of the four creases: right, up, left, down.
  std::array<Condition, 4> angles(int i, int j) const {
    return {angle(i, j, i + 1, j), angle(i, j, i, j + 1), angle(i, j, i - 1, j), angle(i, j, i, j - 1)};
  }

  Condition flat(int i, int j) const {
    const auto phi = angles(i, j);
    Condition out;
    for (int k = 0; k < 4; ++k) out.add(k % 2 == 0 ? -1 : 1, phi[k]);
    const Eigen::Vector4d sector = sectors(m_, i, j);
    out.value = sector[0] + sector[2] - pi;
    return out;
  }

  /// Returns the logarithm of |fold_ratio|. Each sector is averaged with its opposite one.
  Condition ratio(int i, int j) const {
    const auto phi = angles(i, j);
    const Eigen::Vector4d sector = sectors(m_, i, j);
    const double a = (sector[0] + pi - sector[2]) / 2, b = (sector[1] + pi - sector[3]) / 2;
    const double half_sum = (a + b) / 2, half_difference = (a - b) / 2;
    Condition sum, difference;  // slopes of a + b and a - b
    const double signs_of_a[] = {-1, 1, 1, -1}, signs_of_b[] = {-1, -1, 1, 1};
    for (int k = 0; k < 4; ++k) {
      sum.add((signs_of_a[k] + signs_of_b[k]) / 2, phi[k]);
      difference.add((signs_of_a[k] - signs_of_b[k]) / 2, phi[k]);
    }
    Condition out;
    const bool turns = flips(i, j);
    out.add(turns ? 0.5 / std::tan(half_difference) : -0.5 * std::tan(half_difference), difference);
    out.add(turns ? -0.5 / std::tan(half_sum) : 0.5 * std::tan(half_sum), sum);
    out.value = std::log(std::abs(fold_ratio(a, b, turns)));
    return out;
  }

  std::vector<Condition> conditions() const {
    std::vector<Condition> out;
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i) out.push_back(flat(i, j));
    for (int j = 1; j < q_; ++j)
      for (int i = 1; i < p_; ++i) {
        Condition& corner = out.emplace_back();
        corner.add(1, ratio(i, j));
        corner.add(-1, ratio(i + 1, j));
        corner.add(-1, ratio(i, j + 1));
        corner.add(1, ratio(i + 1, j + 1));
      }
    return out;
  }

  /// Computes the conditions. @return the largest violation
  double residual() {
    conditions_ = conditions();
    residual_ = 0;
    for (const Condition& condition : conditions_) {
      if (!std::isfinite(condition.value)) refuse();
      residual_ = std::max(residual_, std::abs(condition.value));
    }
    return residual_;
  }

  /// Moves the vertices to the point next to the given ones that satisfies the linear conditions.
  void move() {
    const auto rows = static_cast<Eigen::Index>(conditions_.size()),
               columns = static_cast<Eigen::Index>(2 * m_.vertices.size());
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd value(rows), back(columns);
    for (Eigen::Index k = 0; k < rows; ++k) {
      value[k] = conditions_[k].value;
      for (const auto& [coordinate, slope] : conditions_[k].slopes)
        entries.emplace_back(k, coordinate, slope);
    }
    for (std::size_t v = 0; v < m_.vertices.size(); ++v)
      back.segment<2>(static_cast<Eigen::Index>(2 * v)) = given_.vertices[v] - m_.vertices[v];
    SparseMatrix slopes(rows, columns);
    slopes.setFromTriplets(entries.begin(), entries.end());
    SparseMatrix square = slopes * slopes.transpose();
    for (Eigen::Index k = 0; k < rows; ++k) square.coeffRef(k, k) += dependent_conditions;
    SparseFactor solver;
    if (!solver.compute(square)) refuse();
    const VectorXd force = solver.solve(value + slopes * back);
    const VectorXd step = back - slopes.transpose() * force;
    if (!step.allFinite() || step.cwiseAbs().maxCoeff() > 1) refuse();
    for (std::size_t v = 0; v < m_.vertices.size(); ++v)
      m_.vertices[v] += step.segment<2>(static_cast<Eigen::Index>(2 * v));
  }

  /// Sets the multipliers of all creases from those of the first column and row of vertices.
  void set_multipliers() {
    std::vector<double> rising(p_), level(q_);
    for (int j = 1; j <= q_; ++j) level[j - 1] = ratio(1, j).value;
    for (int i = 1; i <= p_; ++i) rising[i - 1] = level[0] - ratio(i, 1).value;
    double most = 0;  // logarithm, that of rising line 1 is 0
    for (const auto* all : {&rising, &level})
      for (const double c : *all) most = std::max(most, c);
    for (int i = 1; i <= p_; ++i)
      for (int j = 0; j <= q_; ++j) m_.rising[m_.rising_crease(i, j)] *= std::exp(rising[i - 1] - most);
    for (int j = 1; j <= q_; ++j)
      for (int i = 0; i <= p_; ++i) m_.level[m_.level_crease(i, j)] *= std::exp(level[j - 1] - most);
  }

  /// Names the vertex of the given mesh that violates its condition most.
  [[noreturn]] void refuse() const {
    const Mending given(given_, name_);
    int worst_i = 1, worst_j = 1;
    double worst = -1;
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i)
        if (const double off = std::abs(given.flat(i, j).value); !(off <= worst)) {
          worst = off;
          worst_i = i;
          worst_j = j;
        }
    const std::string limit =
        number_text(100 * most_moved) + " % of the mean edge, up to which vertices are moved";
    constexpr double flat_within = 2e-3;  // rad
    if (worst > flat_within) {
      const Eigen::Vector4d sector = sectors(given_, worst_i, worst_j);
      throw InvalidInput(name_(worst_i, worst_j) +
                         " is not flat-foldable: opposite angles between its creases add up to " +
                         number_text(to_degrees(sector[0] + sector[2])) +
                         " deg, and 180 deg is farther than " + limit + ". Correct its angles");
    }
    throw InvalidInput(
        "the pattern does not fold rigidly: the creases of its vertices fold in ratios that do not "
        "fit together, by more than " +
        limit + ". Change angles, or mountains and valleys");
  }

  QuadMesh given_, m_;  ///< vertices in mean edges
  const VertexName& name_;
  int p_, q_;
  double edge_;
  std::vector<bool> flips_;
  std::vector<Condition> conditions_;
  double residual_ = 0;
};

}  // namespace

MendedMesh mend_mesh(const QuadMesh& mesh, const VertexName& name) { return Mending(mesh, name).run(); }

}  // namespace kinetix::model
