#include "model/elastic/tangent_stiffness.hpp"

#include <Eigen/CholmodSupport>
#include <new>

namespace kinetix::model {
namespace {

using Held = std::vector<std::array<bool, 6>>;

DofMap numbered(const Held& held) {
  DofMap dofs;
  dofs.unknown.resize(held.size());
  for (std::size_t b = 0; b < held.size(); ++b)
    for (int c = 0; c < 6; ++c) dofs.unknown[b][c] = held[b][c] ? -1 : dofs.count++;
  return dofs;
}

}  // namespace

Eigen::VectorXd DofMap::restrict(const Eigen::VectorXd& all) const {
  Eigen::VectorXd out(count);
  for (std::size_t b = 0; b < unknown.size(); ++b)
    for (int c = 0; c < 6; ++c)
      if (unknown[b][c] >= 0) out[unknown[b][c]] = all[6 * b + c];
  return out;
}

Eigen::VectorXd DofMap::extend(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(coordinates());
  for (std::size_t b = 0; b < unknown.size(); ++b)
    for (int c = 0; c < 6; ++c)
      if (unknown[b][c] >= 0) out[6 * b + c] = unknowns[unknown[b][c]];
  return out;
}

DofMap make_dof_map(const Linkage& structure, const LinkageDrive& drive, bool planar) {
  Held held(structure.bodies.size(), {planar, planar, false, false, false, planar});
  for (const auto& [body, coordinate] : drive.held_coordinates(structure)) held[body][coordinate] = true;
  return numbered(held);
}

namespace {

using Cholesky = Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower>;

// Unknowns: from this size on, nested dissection saves more in each factor than it costs once.
constexpr int dissected_from = 12000;

}  // namespace

struct TangentStiffness::Factor : Cholesky {
  explicit Factor(int unknowns) {
    cholmod().print = 0;
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = unknowns < dissected_from ? CHOLMOD_AMD : CHOLMOD_METIS;
    setMode(Eigen::CholmodSimplicialLLt);
  }

  /// Analyses a pattern in the order of the first one: a few more pairs of bodies do not change that order
  /// much.
  void analyse(const Eigen::SparseMatrix<double>& matrix) {
    if (!m_cholmodFactor) {
      analyzePattern(matrix);
      request_memory();
      const int* order = static_cast<const int*>(m_cholmodFactor->Perm);
      order_.assign(order, order + m_cholmodFactor->n);
      return;
    }
    cholmod_free_factor(&m_cholmodFactor, &cholmod());
    cholmod().method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse view = Eigen::viewAsCholmod(matrix.selfadjointView<Eigen::Lower>());
    m_cholmodFactor = cholmod_analyze_p(&view, order_.data(), nullptr, 0, &cholmod());
    request_memory();
    m_factorizationIsOk = false;
  }

  /// Throws std::bad_alloc if CHOLMOD is out of memory. CHOLMOD itself would report an indefinite matrix if
  /// the factor does not fit, and leave the solution unset.
  void request_memory() {
    if (cholmod().status == CHOLMOD_OUT_OF_MEMORY || !m_cholmodFactor) throw std::bad_alloc();
  }

 private:
  std::vector<int> order_;
};

TangentStiffness::TangentStiffness(const DofMap& dofs)
    : dofs_(dofs), factor_(std::make_unique<Factor>(dofs.count)) {
  for (int b = 0; b < static_cast<int>(dofs.unknown.size()); ++b) block_of(b, b);
}

TangentStiffness::~TangentStiffness() = default;

int TangentStiffness::block_of(int a, int b) {
  const auto [at, is_new] = index_.try_emplace({a, b}, static_cast<int>(blocks_.size()));
  if (is_new) {
    blocks_.push_back(Block::Zero());
    bodies_.emplace_back(a, b);
    laid_out_ = false;
  }
  return at->second;
}

void TangentStiffness::clear() {
  for (Block& block : blocks_) block.setZero();
  filled_ = false;
}

void TangentStiffness::add(int a, int b, const Element& e) {
  blocks_[a] += e.hessian.topLeftCorner<6, 6>();
  blocks_[b] += e.hessian.bottomRightCorner<6, 6>();
  if (a > b)
    blocks_[block_of(a, b)] += e.hessian.topRightCorner<6, 6>();
  else
    blocks_[block_of(b, a)] += e.hessian.bottomLeftCorner<6, 6>();
}

void TangentStiffness::add(const std::vector<int>& bodies, const Eigen::MatrixXd& hessian) {
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
    for (int j = 0; j <= i; ++j) blocks_[block_of(bodies[i], bodies[j])] += hessian.block<6, 6>(6 * i, 6 * j);
}

void TangentStiffness::lay_out() {
  std::vector<Eigen::Triplet<int>> places;
  entries_.clear();
  for (int k = 0; k < static_cast<int>(blocks_.size()); ++k)
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) {
        const int row = dofs_.unknown[bodies_[k].first][r], column = dofs_.unknown[bodies_[k].second][c];
        if (row < 0 || column < 0 || row < column) continue;
        places.emplace_back(row, column, static_cast<int>(entries_.size()));
        entries_.push_back({k, r, c});
      }
  Eigen::SparseMatrix<int> order(size(), size());
  order.setFromTriplets(places.begin(), places.end());
  matrix_ = order.cast<double>();
  std::vector<Entry> sorted;
  sorted.reserve(entries_.size());
  for (Eigen::Index k = 0; k < order.nonZeros(); ++k) sorted.push_back(entries_[order.valuePtr()[k]]);
  entries_ = std::move(sorted);
  laid_out_ = true;
  analysed_ = false;
}

void TangentStiffness::fill() {
  if (filled_) return;
  if (!laid_out_) lay_out();
  for (std::size_t k = 0; k < entries_.size(); ++k)
    matrix_.valuePtr()[k] = blocks_[entries_[k].block](entries_[k].row, entries_[k].column);
  filled_ = true;
}

bool TangentStiffness::factorise(double shift) {
  ++factors_;
  fill();
  if (!analysed_) factor_->analyse(matrix_);
  analysed_ = true;
  factor_->setShift(shift);
  factor_->factorize(matrix_);
  factor_->request_memory();
  factorised_ = factor_->info() == Eigen::Success;
  return factorised_;
}

Eigen::VectorXd TangentStiffness::solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd x = factor_->solve(rhs);
  factor_->request_memory();
  return x;
}

Eigen::VectorXd TangentStiffness::multiply(const Eigen::VectorXd& x) {
  fill();
  return matrix_.selfadjointView<Eigen::Lower>() * x;
}

Eigen::VectorXd TangentStiffness::multiply_all(const Eigen::VectorXd& all) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(all.size());
  const auto add = [&](int body, const auto& block, int other) {
    const auto x = all.segment<6>(6 * other);
    if ((x.array() != 0).any()) out.segment<6>(6 * body) += block * x;
  };
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const auto [a, b] = bodies_[k];
    add(a, blocks_[k], b);
    if (a != b) add(b, blocks_[k].transpose(), a);
  }
  return out;
}

}  // namespace kinetix::model
