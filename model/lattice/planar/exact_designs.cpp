#include "model/lattice/planar/exact_designs.hpp"

#include <Eigen/SPQRSupport>
#include <Eigen/SparseCore>

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// Returns the matrix of conditions: a row per wall, two columns per cell, one per further condition.
Matrix conditions(const PlanarStructure& s, const std::vector<WallCondition>& further) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int f = 0; f < static_cast<int>(s.faces.size()); ++f)
    for (std::size_t k = 0; k < s.faces[f].edges.size(); ++k) {
      const int wall = s.faces[f].edges[k];
      const Vector2d along = walked(s.graph, s.faces[f], k) * s.graph.along(wall);
      entries.emplace_back(wall, 2 * f, along.x());
      entries.emplace_back(wall, 2 * f + 1, along.y());
    }
  int column = 2 * static_cast<int>(s.faces.size());
  for (const WallCondition& condition : further) {
    for (const auto& [wall, rate] : condition.parts) entries.emplace_back(wall, column, rate);
    ++column;
  }
  Matrix derivatives(static_cast<int>(s.hinges.size()), column);
  derivatives.setFromTriplets(entries.begin(), entries.end());
  return derivatives;
}

}  // namespace

struct ExactDesigns::Factors {
  explicit Factors(const Matrix& derivatives) : qr(derivatives) {}
  Eigen::SPQR<Matrix> qr;
};

ExactDesigns::ExactDesigns(const PlanarStructure& structure, const std::vector<WallCondition>& further)
    : walls_(static_cast<int>(structure.hinges.size())),
      conditions_(static_cast<int>(2 * structure.faces.size() + further.size())) {
  if (conditions_ == 0) return;
  factors_ = std::make_shared<Factors>(conditions(structure, further));
  rank_ = static_cast<int>(factors_->qr.rank());
}

VectorXd ExactDesigns::design(const VectorXd& numbers) const {
  if (!factors_) return numbers;
  VectorXd all = VectorXd::Zero(walls_);
  all.tail(dimension()) = numbers;
  return factors_->qr.matrixQ() * all;
}

VectorXd ExactDesigns::numbers(const VectorXd& s) const {
  if (!factors_) return s;
  const VectorXd all = factors_->qr.matrixQ().transpose() * s;
  return all.tail(dimension());
}

VectorXd ExactDesigns::smallest_change(const VectorXd& sums) const {
  if (!factors_) return VectorXd::Zero(walls_);
  const VectorXd ordered = factors_->qr.colsPermutation().transpose() * sums;
  const Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long> r =
      factors_->qr.matrixR().topLeftCorner(rank_, rank_);
  VectorXd all = VectorXd::Zero(walls_);
  all.head(rank_) = r.transpose().triangularView<Eigen::Lower>().solve(ordered.head(rank_));
  return factors_->qr.matrixQ() * all;
}

PlanarStructure nearest_exact(PlanarStructure s) {
  const std::vector<WallCondition> creases = straight_lines(s, find_creases(s));
  VectorXd sums(2 * s.faces.size() + creases.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f) sums.segment<2>(2 * f) = -parallel_sum(s, s.faces[f]);
  for (std::size_t c = 0; c < creases.size(); ++c) sums[2 * s.faces.size() + c] = creases[c].missing;
  const VectorXd change = ExactDesigns(s, creases).smallest_change(sums);
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    s.hinges[h].t += s.senses[s.graph.edges[h].from] * change[h] / 2;
  return s;
}

}  // namespace kinetix::model
