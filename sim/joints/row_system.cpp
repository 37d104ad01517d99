#include "sim/joints/row_system.hpp"

namespace kinetix::sim {
namespace {

std::vector<std::pair<int, int>> joined_parts(const std::vector<VelocityRow>& rows) {
  std::vector<std::pair<int, int>> joined;
  joined.reserve(rows.size());
  for (const VelocityRow& row : rows) joined.emplace_back(row.a, row.b);
  return joined;
}

Matrix6 block_of(const PartMass& part) {
  Matrix6 block = Matrix6::Zero();
  block.diagonal().head<3>().setConstant(part.mass);
  block.bottomRightCorner<3, 3>() = part.inertia;
  return block;
}

}  // namespace

bool RowSystem::has_pattern_of(std::size_t parts, const std::vector<VelocityRow>& rows) const {
  return parts == parts_ && joined_parts(rows) == joined_;
}

void RowSystem::analyse(std::size_t parts, const std::vector<VelocityRow>& rows) {
  parts_ = parts;
  joined_ = joined_parts(rows);
  starts_.clear();
  for (int p = 0; p < static_cast<int>(parts); ++p) starts_[{p, p}] = {};
  for (const auto& [a, b] : joined_)
    if (a >= 0 && b >= 0) starts_[{std::max(a, b), std::min(a, b)}] = {};

  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [pair, start] : starts_)
    for (int c = 0; c < 6; ++c)
      for (int r = pair.first == pair.second ? c : 0; r < 6; ++r)
        entries.emplace_back(6 * pair.first + r, 6 * pair.second + c, 1.0);
  matrix_.resize(6 * parts, 6 * parts);
  matrix_.setFromTriplets(entries.begin(), entries.end());

  const int* const inner = matrix_.innerIndexPtr();
  for (auto& [pair, start] : starts_)
    for (int c = 0; c < 6; ++c) {
      const int column = 6 * pair.second + c;
      const int* const begin = inner + matrix_.outerIndexPtr()[column];
      const int* const end = inner + matrix_.outerIndexPtr()[column + 1];
      start[c] = static_cast<int>(std::lower_bound(begin, end, 6 * pair.first) - inner);
    }
  factor_.analyzePattern(matrix_);
}

void RowSystem::add_block(Pair pair, const Matrix6& block) {
  const auto& start = starts_.at(pair);
  const bool diagonal = pair.first == pair.second;
  for (int c = 0; c < 6; ++c)
    for (int r = diagonal ? c : 0, k = start[c]; r < 6; ++r, ++k) matrix_.valuePtr()[k] += block(r, c);
}

bool RowSystem::factorise(const std::vector<PartMass>& masses, const std::vector<VelocityRow>& rows,
                          double stiffness) {
  if (!has_pattern_of(masses.size(), rows)) analyse(masses.size(), rows);
  matrix_.coeffs().setZero();
  pull_.setZero(6 * static_cast<Eigen::Index>(masses.size()));
  for (std::size_t p = 0; p < masses.size(); ++p)
    add_block({static_cast<int>(p), static_cast<int>(p)}, block_of(masses[p]));
  for (const VelocityRow& row : rows) {
    const double stiff = row.weight * stiffness;
    const Vector6 first = stiff * row.first, second = stiff * row.second;
    if (row.a >= 0) add_block({row.a, row.a}, first * row.first.transpose());
    if (row.b >= 0) add_block({row.b, row.b}, second * row.second.transpose());
    if (row.a >= 0) pull_.segment<6>(6 * row.a) += row.target * first;
    if (row.b >= 0) pull_.segment<6>(6 * row.b) += row.target * second;
    if (row.a < 0 || row.b < 0) continue;
    if (row.a > row.b) add_block({row.a, row.b}, first * row.second.transpose());
    if (row.b > row.a) add_block({row.b, row.a}, second * row.first.transpose());
  }
  factor_.factorize(matrix_);
  return factor_.info() == Eigen::Success;
}

}  // namespace kinetix::sim
