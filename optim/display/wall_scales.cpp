#include "optim/display/wall_scales.hpp"

#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr int max_splits = 20'000;  // ten times what pictures of 100 x 100 cells take
constexpr double settled = 1e-6;    // of s and 2 o: one micron on a wall of a metre
// Over-relaxation of alternating directions: 1.5 to 1.8 is usual (Boyd et al. 2011, section 3.4.3).
constexpr double relaxation = 1.6;
// Weight of the squared distance from `near` against that from `wanted`. Of 1, 0.3, 0.1, 0.03 and 0.01 it
// takes the fewest iterations on panels of 29 x 29 and 100 x 100 cells, an eighth of those of 1.
constexpr double penalty = 0.1;

/// Real or imaginary part of y. Some vertices share a value up to a known difference.
class Part {
 public:
  Part(int vertices, const std::vector<std::vector<int>>& equal, double drop)
      : of_vertex_(vertices), ahead_(vertices) {
    ahead_.setZero();
    std::vector<int> group(vertices, -1);
    for (std::size_t k = 0; k < equal.size(); ++k)
      for (const int v : equal[k]) group[v] = static_cast<int>(k);
    std::vector<int> of_group(equal.size(), -1);
    for (int v = 0; v < vertices; ++v) {
      if (group[v] < 0) {
        of_vertex_[v] = count_++;
        continue;
      }
      const bool is_tied = drop != 0 && group[v] + 1 == static_cast<int>(equal.size());
      int& unknown = of_group[is_tied ? 0 : group[v]];
      if (unknown < 0) unknown = count_++;
      of_vertex_[v] = unknown;
      if (is_tied) ahead_[v] = -drop;
    }
  }

  /// @param weights of the edges
  void factorise(const model::PlanarGraph& graph, const VectorXd& weights) {
    std::vector<Eigen::Triplet<double>> entries, whole;
    entries.emplace_back(of_vertex_[0], of_vertex_[0],
                         1.0);  // fixes vertex 0, since no force acts on the whole
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const std::array<int, 2> ends = {graph.edges[e].from, graph.edges[e].to};
      for (const int a : ends)
        for (const int b : ends) {
          const double entry = (a == b ? 1 : -1) * weights[static_cast<Eigen::Index>(e)];
          entries.emplace_back(of_vertex_[a], of_vertex_[b], entry);
          whole.emplace_back(a, b, entry);
        }
    }
    Eigen::SparseMatrix<double> matrix(count_, count_), laplacian(ahead_.size(), ahead_.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    laplacian.setFromTriplets(whole.begin(), whole.end());
    factor_.compute(matrix);
    known_ = laplacian * ahead_;
  }

  VectorXd solve(const VectorXd& forces) const {
    VectorXd reduced = VectorXd::Zero(count_);
    for (Eigen::Index v = 0; v < forces.size(); ++v) reduced[of_vertex_[v]] += forces[v] - known_[v];
    const VectorXd found = factor_.solve(reduced);
    VectorXd out = ahead_;
    for (Eigen::Index v = 0; v < out.size(); ++v) out[v] += found[of_vertex_[v]];
    return out;
  }

 private:
  std::vector<int> of_vertex_;  ///< index of the unknown of each vertex
  VectorXd ahead_;              ///< known difference of each vertex from its unknown
  int count_ = 0;
  SparseFactor factor_;
  VectorXd known_;
};

/// Maps y to s + 2 i o of all walls, and finds the y that fits given ones best.
class Walls {
 public:
  Walls(const model::PlanarStructure& s, const WallScales& scales)
      : graph_(s.graph),
        edges_(static_cast<Eigen::Index>(s.graph.edges.size())),
        real_(count(), scales.axis == model::Axis::y ? scales.straight : none, scales.drop),
        // Along x a vertex is at cos(theta) Re x - sin(theta) Im y.
        imaginary_(count(), scales.axis == model::Axis::x ? scales.straight : none, -scales.drop) {
    VectorXd weights(edges_.size());
    for (Eigen::Index e = 0; e < edges_.size(); ++e) {
      const Eigen::Vector2d along = graph_.along(static_cast<int>(e));
      edges_[e] = {along.x(), along.y()};
      weights[e] = 1 / along.squaredNorm();
    }
    real_.factorise(graph_, weights);
    imaginary_.factorise(graph_, weights);
  }

  VectorXcd changes(const VectorXcd& y) const {
    VectorXcd out(edges_.size());
    for (Eigen::Index e = 0; e < out.size(); ++e) {
      const auto [from, to] = graph_.edges[static_cast<std::size_t>(e)];
      out[e] = (y[to] - y[from]) / edges_[e];
    }
    return out;
  }

  VectorXcd nearest(const VectorXcd& changes) const {
    VectorXcd forces = VectorXcd::Zero(count());
    for (Eigen::Index e = 0; e < edges_.size(); ++e) {
      const auto [from, to] = graph_.edges[static_cast<std::size_t>(e)];
      const Complex force = changes[e] / std::conj(edges_[e]);
      forces[to] += force;
      forces[from] -= force;
    }
    VectorXcd y(count());
    y.real() = real_.solve(forces.real());
    y.imag() = imaginary_.solve(forces.imag());
    return y;
  }

 private:
  int count() const { return static_cast<int>(graph_.vertices.size()); }
  inline static const std::vector<std::vector<int>> none = {};

  const model::PlanarGraph& graph_;
  VectorXcd edges_;
  Part real_, imaginary_;
};

/// Returns, for each wall separately, the change within bounds that is best for `wanted` and `near`.
VectorXcd best_by_themselves(const VectorXcd& near, const WallScales& scales) {
  VectorXcd out(near.size());
  for (Eigen::Index e = 0; e < out.size(); ++e) {
    const double wanted = scales.wanted[static_cast<std::size_t>(e)];
    out[e] = {std::clamp(near[e].real(), -scales.shift, scales.shift),
              std::clamp((penalty * near[e].imag() + wanted) / (1 + penalty), -2 * scales.offset,
                         2 * scales.offset)};
  }
  return out;
}

double largest(const VectorXcd& v) { return v.size() == 0 ? 0 : v.cwiseAbs().maxCoeff(); }

/// Shrinks y a little so that it is within its bounds to the last bit, and stores it with its changes.
void finish(const Walls& walls, const WallScales& scales, VectorXcd y, ScaledWalls& found) {
  VectorXcd changes = walls.changes(y);
  const double shift = changes.real().cwiseAbs().maxCoeff(),
               offset = changes.imag().cwiseAbs().maxCoeff() / 2;
  const double excess = std::max({1.0, shift / scales.shift, offset / scales.offset});
  y = (y.array() - y[0]) / excess;
  changes /= excess;
  found.shift = shift / excess;
  found.offset = offset / excess;
  const Eigen::Map<const VectorXd> wanted(scales.wanted.data(),
                                          static_cast<Eigen::Index>(scales.wanted.size()));
  found.distance = std::sqrt((changes.imag() - wanted).squaredNorm() / static_cast<double>(wanted.size()));
  for (Eigen::Index v = 0; v < y.size(); ++v) found.y.push_back({y[v].real(), y[v].imag()});
}

}  // namespace

void WallScales::validate(const model::PlanarStructure& structure) const {
  require("offset", offset, offset > 0 && offset < 0.5, "in (0, 0.5) of a wall's length");
  require("shift", shift, shift > 0 && shift < 1, "in (0, 1)");
  require("drop", drop, std::isfinite(drop), "a finite number of cell edges");
  if (wanted.size() != structure.graph.edges.size())
    throw InvalidInput("wanted must have a value for each wall");
  for (const double w : wanted) require("wanted", w, std::isfinite(w), "finite");
  std::vector<bool> used(structure.graph.vertices.size(), false);
  for (const auto& row : straight)
    for (const int v : row) {
      const bool fits = v >= 0 && v < static_cast<int>(used.size()) && !used[v];
      if (!fits)
        throw InvalidInput("straight names vertex " + std::to_string(v) + " twice, or it does not exist");
      used[v] = true;
    }
}

std::vector<double> wanted_scales(const std::vector<double>& levels, const model::PlanarStructure& structure,
                                  double offset) {
  std::vector<double> sum(structure.graph.edges.size(), 0), wanted(sum.size(), 0);
  std::vector<int> beside(sum.size(), 0);
  for (std::size_t f = 0; f < structure.faces.size(); ++f)
    for (const int e : structure.faces[f].edges) {
      sum[e] += levels[f];
      ++beside[e];
    }
  for (std::size_t e = 0; e < wanted.size(); ++e)
    if (beside[e] > 0) wanted[e] = -(2 * sum[e] / beside[e] - 1) * 2 * offset;
  return wanted;
}

ScaledWalls scale_walls(const model::PlanarStructure& structure, const WallScales& scales) {
  scales.validate(structure);
  const Walls walls(structure, scales);
  const auto edges = static_cast<Eigen::Index>(structure.graph.edges.size());
  VectorXcd split = VectorXcd::Zero(edges), dual = VectorXcd::Zero(edges), y;
  ScaledWalls found;
  while (!found.converged && found.iterations < max_splits) {
    ++found.iterations;
    y = walls.nearest(split - dual);
    const VectorXcd joint = walls.changes(y);
    const VectorXcd relaxed = relaxation * joint + (1 - relaxation) * split + dual;
    const VectorXcd next = best_by_themselves(relaxed, scales);
    dual = relaxed - next;
    found.converged = largest(joint - next) <= settled && largest(next - split) <= settled;
    split = next;
  }
  finish(walls, scales, std::move(y), found);
  return found;
}

}  // namespace kinetix::optim
