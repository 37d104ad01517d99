#include "sim/joints/row_system.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <map>

namespace kinetix::sim {
namespace {

/// Returns the index after the last consecutive row with the same two parts as the first.
std::size_t end_of_joint(const std::vector<VelocityRow>& rows, std::size_t first) {
  std::size_t end = first + 1;
  while (end < rows.size() && rows[end].a == rows[first].a && rows[end].b == rows[first].b) ++end;
  return end;
}

Matrix6 block_of(const PartMass& part) {
  Matrix6 block = Matrix6::Zero();
  block.diagonal().head<3>().setConstant(part.mass);
  block.bottomRightCorner<3, 3>() = part.inertia;
  return block;
}

}  // namespace

bool RowSystem::has_pattern_of(std::size_t parts, const std::vector<VelocityRow>& rows) const {
  std::size_t first = 0;
  for (const Joint& joint : joints_) {
    if (joint.end > rows.size()) return false;
    for (; first < joint.end; ++first)
      if (rows[first].a != joint.a || rows[first].b != joint.b) return false;
  }
  return parts == parts_ && first == rows.size();
}

void RowSystem::analyse(std::size_t parts, const std::vector<VelocityRow>& rows) {
  parts_ = parts;
  joints_.clear();
  std::vector<std::pair<int, int>> joined;
  std::map<std::pair<int, int>, int> block_of_pair;
  for (std::size_t first = 0; first < rows.size(); first = joints_.back().end) {
    Joint joint{rows[first].a, rows[first].b, end_of_joint(rows, first)};
    const std::pair<int, int> pair = std::minmax(joint.a, joint.b);
    if (pair.first >= 0 && pair.first != pair.second) {
      const auto [at, is_new] = block_of_pair.try_emplace(pair, static_cast<int>(parts + joined.size()));
      if (is_new) joined.push_back(pair);
      joint.mixed = at->second;
    }
    joints_.push_back(joint);
  }
  order(joined);
  blocks_.clear();
  for (const int place : place_) blocks_.push_back({place, place});
  for (const auto& [p, q] : joined)
    blocks_.push_back({std::max(place_[p], place_[q]), std::min(place_[p], place_[q])});
  lay_out();
  factor_.analyzePattern(matrix_);
}

void RowSystem::order(const std::vector<std::pair<int, int>>& joined) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < static_cast<int>(parts_); ++p) entries.emplace_back(p, p, 1.0);
  for (const auto& [p, q] : joined) entries.emplace_back(q, p, 1.0);
  Eigen::SparseMatrix<double> graph(parts_, parts_);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> part_at;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), part_at);
  place_.resize(parts_);
  for (int k = 0; k < static_cast<int>(parts_); ++k) place_[part_at.indices()[k]] = k;
}

Eigen::VectorXd RowSystem::by_part(const Eigen::VectorXd& by_place) const {
  Eigen::VectorXd out(by_place.size());
  for (std::size_t p = 0; p < parts_; ++p) out.segment<6>(6 * p) = by_place.segment<6>(6 * place_[p]);
  return out;
}

Eigen::VectorXd RowSystem::by_place(const Eigen::VectorXd& by_part) const {
  Eigen::VectorXd out(by_part.size());
  for (std::size_t p = 0; p < parts_; ++p) out.segment<6>(6 * place_[p]) = by_part.segment<6>(6 * p);
  return out;
}

void RowSystem::lay_out() {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Block& block : blocks_)
    for (int c = 0; c < 6; ++c)
      for (int r = block.row == block.column ? c : 0; r < 6; ++r)
        entries.emplace_back(6 * block.row + r, 6 * block.column + c, 1.0);
  matrix_.resize(6 * parts_, 6 * parts_);
  matrix_.setFromTriplets(entries.begin(), entries.end());

  const int* const inner = matrix_.innerIndexPtr();
  for (Block& block : blocks_)
    for (int c = 0; c < 6; ++c) {
      const int* const column = matrix_.outerIndexPtr() + 6 * block.column + c;
      const int first = 6 * block.row + (block.row == block.column ? c : 0);
      block.start[c] =
          static_cast<int>(std::lower_bound(inner + column[0], inner + column[1], first) - inner);
    }
}

void RowSystem::add(const Block& block, const Matrix6& values) {
  const bool diagonal = block.row == block.column;
  for (int c = 0; c < 6; ++c)
    for (int r = diagonal ? c : 0, k = block.start[c]; r < 6; ++r, ++k) matrix_.valuePtr()[k] += values(r, c);
}

void RowSystem::add(const Joint& joint, std::size_t first, const std::vector<VelocityRow>& rows,
                    double stiffness) {
  Matrix6 of_a = Matrix6::Zero(), of_b = Matrix6::Zero(), mixed = Matrix6::Zero();
  Vector6 pull_a = Vector6::Zero(), pull_b = Vector6::Zero();
  for (std::size_t k = first; k < joint.end; ++k) {
    const VelocityRow& row = rows[k];
    const Vector6 by_a = row.weight * stiffness * row.first, by_b = row.weight * stiffness * row.second;
    of_a += by_a * row.first.transpose();
    of_b += by_b * row.second.transpose();
    if (joint.mixed >= 0 && place_[joint.a] > place_[joint.b])
      mixed += by_a * row.second.transpose();
    else
      mixed += by_b * row.first.transpose();
    pull_a += row.target * by_a;
    pull_b += row.target * by_b;
  }
  if (joint.a >= 0) {
    add(blocks_[joint.a], of_a);
    pull_.segment<6>(6 * place_[joint.a]) += pull_a;
  }
  if (joint.b >= 0) {
    add(blocks_[joint.b], of_b);
    pull_.segment<6>(6 * place_[joint.b]) += pull_b;
  }
  if (joint.mixed >= 0) add(blocks_[joint.mixed], mixed);
}

bool RowSystem::factorise(const std::vector<PartMass>& masses, const std::vector<VelocityRow>& rows,
                          double stiffness) {
  if (!has_pattern_of(masses.size(), rows)) analyse(masses.size(), rows);
  matrix_.coeffs().setZero();
  pull_.setZero(6 * static_cast<Eigen::Index>(masses.size()));
  for (std::size_t p = 0; p < masses.size(); ++p) add(blocks_[p], block_of(masses[p]));
  std::size_t first = 0;
  for (const Joint& joint : joints_) {
    add(joint, first, rows, stiffness);
    first = joint.end;
  }
  factor_.factorize(matrix_);
  return factor_.info() == Eigen::Success;
}

}  // namespace kinetix::sim
