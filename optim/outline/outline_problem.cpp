#include "optim/outline/outline_problem.hpp"

#include <cmath>
#include <complex>
#include <map>

#include "model/base/box.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

double cross_2d(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Weights of the vertices of a panel that give a place as their mean.
struct PlaceWeights {
  const model::GraphFace* cell = nullptr;
  std::size_t wall = 0;                                     ///< in its cell: from vertex `wall` to the next
  Eigen::Vector3d parts = Eigen::Vector3d::Constant(-1e9);  ///< of the cell's middle and the wall's ends

  Vector2d mean(const std::vector<Vector2d>& places) const {
    const std::size_t count = cell->vertices.size();
    Vector2d middle = Vector2d::Zero();
    for (const int v : cell->vertices) middle += places[v] / static_cast<double>(count);
    return parts[0] * middle + parts[1] * places[cell->vertices[wall]] +
           parts[2] * places[cell->vertices[(wall + 1) % count]];
  }
};

/// Returns the weights in the triangle that contains the place, or is nearest in the sense of its least weight.
PlaceWeights find_weights(const model::PlanarStructure& panel, const Vector2d& place) {
  const std::vector<Vector2d>& at = panel.graph.vertices;
  PlaceWeights best;
  for (const model::GraphFace& cell : panel.faces) {
    const std::size_t count = cell.vertices.size();
    Vector2d middle = Vector2d::Zero();
    for (const int v : cell.vertices) middle += at[v] / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d a = at[cell.vertices[k]] - middle, b = at[cell.vertices[(k + 1) % count]] - middle;
      const double twice = cross_2d(a, b);
      if (!(twice > 0)) continue;
      const double part_a = cross_2d(place - middle, b) / twice, part_b = cross_2d(a, place - middle) / twice;
      const Eigen::Vector3d parts(1 - part_a - part_b, part_a, part_b);
      if (parts.minCoeff() > best.parts.minCoeff()) best = {&cell, k, parts};
    }
  }
  return best;
}

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr int max_slides = 30;          // the boundary then slides by hundredths of a cell
constexpr int max_rounds_again = 8;     // if only some bounds have changed
constexpr int rounds_of_spreading = 4;  // in which boundary vertices move to their places along the outline
constexpr double settled_boundary = 5e-4;  // cell edges: a hundredth of what is visible on a print
// Weights relative to 1 for the distance from the outline, each a length or a ratio of lengths.
constexpr double first_slide = 0.5, min_slide = 0.02;  // of sliding along it, first and least
constexpr double less_slide = 0.7;                     // its factor from round to round
constexpr double plain_walls = 2e-3;                   // of turning and scaling walls
constexpr double even_cells = 0.2;   // of the distance of flat vertices from the middle of their neighbours
constexpr double small_step = 1e-3;  // of any motion
constexpr double sharp = 30 * pi / 180;  // rad: a corner of an outline that gets a vertex of the boundary
constexpr double corner_pull = 0.3;      // weight along the outline of a vertex at a corner
// Two consecutive walls of a flat cell: smallest sine of the turn between them. Cells then stay convex with
// open corners.
constexpr double min_turn = 0.5;

// For one convex problem. Points on the outline move from round to round, so only the last problem is solved
// accurately.
constexpr BoxLeastSquaresOptions intermediate_options = {1e-4, 50}, final_options = {1e-6, 2000};

Complex complex(const Vector2d& v) { return {v.x(), v.y()}; }

/// Rows of a sparse matrix with their bounds or right-hand sides.
class Rows {
 public:
  void add(Index column, double value) { entries_.emplace_back(count_, column, value); }
  /// Adds the real or imaginary part of factor * (a complex unknown at `column`).
  void add_real(Index column, Complex factor) {
    add(column, factor.real());
    add(column + 1, -factor.imag());
  }
  void add_imaginary(Index column, Complex factor) {
    add(column, factor.imag());
    add(column + 1, factor.real());
  }
  void end(double low, double high) {
    low_.push_back(low);
    high_.push_back(high);
    ++count_;
  }
  void end(double value) { end(value, value); }

  Eigen::SparseMatrix<double> matrix(Index columns) const {
    Eigen::SparseMatrix<double> out(count_, columns);
    out.setFromTriplets(entries_.begin(), entries_.end());
    return out;
  }
  VectorXd low() const { return Eigen::Map<const VectorXd>(low_.data(), count_); }
  VectorXd high() const { return Eigen::Map<const VectorXd>(high_.data(), count_); }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> low_, high_;
  Index count_ = 0;
};

/// Columns of the unknowns: X, then x if it is free, then 1 / scale.
struct Columns {
  Index vertices = 0;
  bool flat_is_free = false;

  Index folded(int v) const { return 2 * v; }
  Index flat(int v) const { return 2 * (vertices + v); }
  Index scale() const { return (flat_is_free ? 4 : 2) * vertices; }
  Index count() const { return scale() + 1; }
};

/// One convex problem: targets on the outlines, and bounds linearised at the present walls.
class Round {
 public:
  Round(const OutlineProblem& problem, const OutlineShape& shape, int number)
      : p_(problem), shape_(shape), number_(number) {
    columns_ = {static_cast<Index>(shape.flat.size()), problem.flat != nullptr};
    slide_ = std::max(min_slide, first_slide * std::pow(less_slide, number));
  }

  BoxLeastSquares problem() {
    add_boundaries();
    for (int e = 0; e < static_cast<int>(p_.panel->graph.edges.size()); ++e) add_wall(e);
    if (columns_.flat_is_free) add_flat_cells();
    BoxLeastSquares out;
    out.A = costs_.matrix(columns_.count());
    out.b = costs_.low();
    out.C = bounds_.matrix(columns_.count());
    out.lower = bounds_.low();
    out.upper = bounds_.high();
    out.damping = small_step * small_step;
    out.from = unknowns();
    return out;
  }

  /// @return largest move of a vertex, cell edges
  double take(const VectorXd& u, OutlineShape& shape) const {
    const OutlineShape before = shape;
    shape.scale = 1 / u[columns_.scale()];
    for (int v = 0; v < static_cast<int>(shape.folded.size()); ++v) {
      shape.folded[v] = u.segment<2>(columns_.folded(v));
      if (columns_.flat_is_free) shape.flat[v] = u.segment<2>(columns_.flat(v));
    }
    // The mean of a solution and its images is also a solution, since the problem is convex and symmetric.
    symmetrise(p_.symmetries, p_.folded->middle() / shape.scale, shape.folded);
    if (columns_.flat_is_free) symmetrise(p_.symmetries, p_.flat->middle() / p_.flat_scale, shape.flat);
    double moved = 0;
    for (std::size_t v = 0; v < shape.folded.size(); ++v)
      moved = std::max(
          {moved, (shape.folded[v] - before.folded[v]).norm(), (shape.flat[v] - before.flat[v]).norm()});
    return moved;
  }

 private:
  VectorXd unknowns() const {
    VectorXd u(columns_.count());
    for (int v = 0; v < static_cast<int>(shape_.flat.size()); ++v) {
      u.segment<2>(columns_.folded(v)) = shape_.folded[v];
      if (columns_.flat_is_free) u.segment<2>(columns_.flat(v)) = shape_.flat[v];
    }
    u[columns_.scale()] = 1 / shape_.scale;
    return u;
  }

  /// Pulls a boundary vertex to a point of an outline: with weight 1 across it, and `slide` along it.
  /// @param scale mm per cell edge
  void add_target(Index column, const targets::Outline::Nearest& at, double slide, double scale, bool free) {
    const Vector2d along(-at.normal.y(), at.normal.x());
    for (const auto& [direction, weight] : {std::pair(at.normal, 1.0), std::pair(along, slide)}) {
      costs_.add(column, weight * direction.x());
      costs_.add(column + 1, weight * direction.y());
      const double place = weight * direction.dot(at.point);
      if (free) costs_.add(columns_.scale(), -place);
      costs_.end(free ? 0 : place / scale);
    }
  }

  /// Returns the nearest vertex of each sharp corner of the outline: index in the boundary, and the corner.
  static std::map<int, Vector2d> held_corners(const targets::Outline& outline,
                                              const std::vector<Vector2d>& rim) {
    std::map<int, Vector2d> held;
    for (const Vector2d& corner : outline.corners(sharp)) {
      const auto nearer = [&](const Vector2d& a, const Vector2d& b) {
        return (a - corner).squaredNorm() < (b - corner).squaredNorm();
      };
      held.emplace(static_cast<int>(std::min_element(rim.begin(), rim.end(), nearer) - rim.begin()), corner);
    }
    return held;
  }

  void add_boundary(const targets::Outline& outline, const std::vector<Vector2d>& places, double scale,
                    bool is_flat) {
    const bool free = !is_flat;
    std::vector<Vector2d> rim;
    for (const int v : p_.rim) rim.push_back(scale * places[v]);
    if (number_ < rounds_of_spreading) rim = spread_along(outline, rim);
    const std::map<int, Vector2d> held = held_corners(outline, rim);
    for (int k = 0; k < static_cast<int>(rim.size()); ++k) {
      const auto corner = held.find(k);
      targets::Outline::Nearest at = outline.nearest(rim[k]);
      if (corner != held.end()) at.point = corner->second;
      const Index column = is_flat ? columns_.flat(p_.rim[k]) : columns_.folded(p_.rim[k]);
      add_target(column, at, corner == held.end() ? slide_ : is_flat ? 1 : corner_pull, scale, free);
    }
  }

  void add_boundaries() {
    add_boundary(*p_.folded, shape_.folded, shape_.scale, false);
    if (p_.flat) add_boundary(*p_.flat, shape_.flat, p_.flat_scale, true);
  }

  Complex edge(const std::vector<Vector2d>& places, int e) const {
    const auto [from, to] = p_.panel->graph.edges[e];
    return complex(places[to] - places[from]);
  }

  /// Adds the ratio r = X_e / x_e. If x is free, it is linearised: (X_e - r x_e) / x_e + r at the present
  /// shape.
  void add_ratio(Rows& rows, int e, double weight, bool real) {
    const auto [from, to] = p_.panel->graph.edges[e];
    const Complex inverse = weight / edge(shape_.flat, e);
    const Complex ratio = edge(shape_.folded, e) / edge(shape_.flat, e);
    const auto part = [&](Index column, Complex factor) {
      real ? rows.add_real(column, factor) : rows.add_imaginary(column, factor);
    };
    part(columns_.folded(to), inverse);
    part(columns_.folded(from), -inverse);
    if (!columns_.flat_is_free) return;
    part(columns_.flat(to), -ratio * inverse);
    part(columns_.flat(from), ratio * inverse);
  }

  void add_wall(int e) {
    const double c = std::cos(p_.theta), s = std::sin(p_.theta);
    const Complex known =
        columns_.flat_is_free ? edge(shape_.folded, e) / edge(shape_.flat, e) : Complex(0, 0);
    const double offset = 2 * p_.bounds.offset[e], shift = p_.bounds.shift[e];
    const double middle = (c - known.real()) / s, turn = -known.imag() / s;
    add_ratio(bounds_, e, 1 / s, true);
    bounds_.end(middle - offset, middle + offset);
    add_ratio(bounds_, e, 1 / s, false);
    bounds_.end(turn - shift, turn + shift);
    add_ratio(costs_, e, plain_walls / s, true);
    costs_.end(plain_walls * middle);
    add_ratio(costs_, e, plain_walls / s, false);
    costs_.end(plain_walls * turn);
  }

  void add_flat_cells() {
    const model::PlanarGraph& graph = p_.panel->graph;
    for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) {
      const Vector2d along = shape_.flat[graph.edges[e].to] - shape_.flat[graph.edges[e].from];
      add_difference(bounds_, graph.edges[e].from, graph.edges[e].to, along.normalized());
      bounds_.end(1 / p_.bounds.stretch[e], p_.bounds.stretch[e]);
    }
    for (const model::GraphFace& face : p_.panel->faces) add_convexity(face);
    add_even_cells();
  }

  /// Adds direction . (x_to - x_from).
  void add_difference(Rows& rows, int from, int to, const Vector2d& direction) {
    for (int k = 0; k < 2; ++k) {
      rows.add(columns_.flat(to) + k, direction[k]);
      rows.add(columns_.flat(from) + k, -direction[k]);
    }
  }

  void add_convexity(const model::GraphFace& face) {
    const std::size_t count = face.vertices.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int a = face.vertices[k], b = face.vertices[(k + 1) % count], c = face.vertices[(k + 2) % count];
      const Vector2d in = shape_.flat[b] - shape_.flat[a], out = shape_.flat[c] - shape_.flat[b];
      const double turn = in.x() * out.y() - in.y() * out.x();
      add_difference(bounds_, a, b, {out.y(), -out.x()});
      add_difference(bounds_, b, c, {-in.y(), in.x()});
      bounds_.end(turn + min_turn * (count > 4 ? 0.5 : 1), std::numeric_limits<double>::infinity());
    }
  }

  void add_even_cells() {
    std::vector<std::vector<int>> near(shape_.flat.size());
    for (const model::GraphEdge& e : p_.panel->graph.edges) {
      near[e.from].push_back(e.to);
      near[e.to].push_back(e.from);
    }
    std::vector<bool> on_boundary(near.size(), false);
    for (const int v : p_.rim) on_boundary[v] = true;
    for (int v = 0; v < static_cast<int>(near.size()); ++v)
      for (int k = 0; k < 2 && !on_boundary[v]; ++k) {
        costs_.add(columns_.flat(v) + k, even_cells);
        for (const int n : near[v])
          costs_.add(columns_.flat(n) + k, -even_cells / static_cast<double>(near[v].size()));
        costs_.end(0);
      }
  }

  const OutlineProblem& p_;
  const OutlineShape& shape_;
  int number_;
  Columns columns_;
  double slide_ = 0;
  Rows costs_, bounds_;
};

/// Returns the length of a polygon up to each corner, then of the whole.
std::vector<double> lengths_along(const std::vector<Vector2d>& polygon) {
  std::vector<double> along = {0};
  for (std::size_t k = 0; k < polygon.size(); ++k)
    along.push_back(along.back() + (polygon[(k + 1) % polygon.size()] - polygon[k]).norm());
  return along;
}

}  // namespace

OutlineShape refined_shape(const model::PlanarStructure& coarse, const OutlineShape& shape,
                           const model::PlanarStructure& fine) {
  const Eigen::AlignedBox2d from = model::box_of(fine.graph.vertices),
                            to = model::box_of(coarse.graph.vertices);
  const Vector2d stretch = to.sizes().cwiseQuotient(from.sizes());
  const double ratio = std::sqrt(stretch.x() * stretch.y());  // coarse cell edges per fine cell edge
  OutlineShape out;
  out.scale = ratio * shape.scale;
  for (const Vector2d& p : fine.graph.vertices) {
    const PlaceWeights weights =
        find_weights(coarse, to.center() + (p - from.center()).cwiseProduct(stretch));
    out.folded.push_back(weights.mean(shape.folded) / ratio);
    out.flat.push_back(weights.mean(shape.flat) * (coarse.size.edge_mm / fine.size.edge_mm));
  }
  return out;
}

std::vector<Vector2d> spread_along(const targets::Outline& outline, const std::vector<Vector2d>& rim) {
  constexpr int shifts_per_vertex = 4;
  const std::vector<double> along = lengths_along(rim);
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& p : rim) middle += p / static_cast<double>(rim.size());
  const auto spread = [&](double shift) {
    std::vector<Vector2d> out;
    for (std::size_t k = 0; k < rim.size(); ++k)
      out.push_back(outline.at(outline.perimeter() * (along[k] / along.back() + shift)));
    return out;
  };
  std::vector<Vector2d> best;
  double least = std::numeric_limits<double>::infinity();
  const int count = shifts_per_vertex * static_cast<int>(rim.size());
  for (int k = 0; k < count; ++k) {
    std::vector<Vector2d> places = spread(static_cast<double>(k) / count);
    double sum = 0;
    for (std::size_t v = 0; v < rim.size(); ++v)
      sum += (places[v] - outline.middle() - (rim[v] - middle)).squaredNorm();
    if (!(sum < least)) continue;
    least = sum;
    best = std::move(places);
  }
  return best;
}

OutlineProgress improve(const OutlineProblem& problem, OutlineShape& shape, bool spread, bool again,
                        BoxLeastSquaresMemory& memory) {
  OutlineProgress progress;
  const int first = spread ? 0 : rounds_of_spreading, most = again ? max_rounds_again : max_slides;
  const auto solve = [&](const BoxLeastSquaresOptions& options) {
    Round round(problem, shape, first + progress.rounds++);
    BoxLeastSquaresResult found = solve_box_least_squares(round.problem(), options, &memory);
    progress.moved = round.take(found.u, shape);
    progress.iterations += found.iterations;
    memory = std::move(found.memory);
  };
  do solve(intermediate_options);
  while (progress.rounds < most && !problem.stop.stop_requested() &&
         (first + progress.rounds <= rounds_of_spreading || progress.moved > settled_boundary));
  progress.settled = progress.moved <= settled_boundary;
  solve(final_options);
  return progress;
}

model::ParallelDrawing parallel_drawing_of(const OutlineShape& shape, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  model::ParallelDrawing y;
  for (std::size_t v = 0; v < shape.flat.size(); ++v) {
    const Vector2d turned = (shape.folded[v] - c * shape.flat[v]) / s;  // i y
    y.push_back({turned.y(), -turned.x()});
  }
  for (std::size_t v = y.size(); v-- > 0;) y[v] -= y[0];
  return y;
}

}  // namespace kinetix::optim
