#include "model/lattice/origami/crease_signs.hpp"

#include <array>
#include <optional>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

// Relative: with unknown signs, a crease that folds less than this share of its neighbours counts as flat.
constexpr double least_solved_ratio = 0.03;
// Differences of logarithms of multipliers that fit, tried from exact patterns to those whose vertices are off by 3 %.
constexpr double fitting_logarithms[] = {0.005, 0.05, 0.3};
constexpr int max_tried_lines = 2000;         // rows and columns whose signs are solved
constexpr std::size_t max_tries = 2'000'000;  // compared vertices, some seconds

/// Creases of an inner vertex: right, up, left, down.
using FourSigns = std::array<double, 4>;

/// Signs of the four creases, up to one common sign.
FourSigns signs_of_way(bool flips, double ratio) {
  const double right = ratio > 0 ? 1 : -1;
  return flips ? FourSigns{right, 1, -right, 1} : FourSigns{right, 1, right, -1};
}

bool agree(const FourSigns& known, const FourSigns& way) {
  bool plus = true, minus = true;
  for (int k = 0; k < 4; ++k) {
    plus = plus && (known[k] == 0 || known[k] == way[k]);
    minus = minus && (known[k] == 0 || known[k] == -way[k]);
  }
  return plus || minus;
}

/// Solves for the signs of a mesh.
class SignSolver {
 public:
  SignSolver(QuadMesh& mesh, const VertexName& name)
      : m_(mesh), name_(name), p_(mesh.columns - 1), q_(mesh.rows - 1) {
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i) ways_.push_back(ways_at(i, j));
  }

  SolvedSigns run() {
    SolvedSigns out;
    bool is_any_known = false;
    for (const auto* all : {&m_.rising, &m_.level})
      for (const double sign : *all) {
        out.solved += sign == 0;
        is_any_known = is_any_known || sign != 0;
      }
    if (out.solved == 0) return out;
    choose_ways();
    out.is_either = !is_any_known;
    if (out.is_either) *crease(1, 1, 0) = 1;
    spread();
    return out;
  }

 private:
  /// Ways to fold of a vertex: logarithms of |fold_ratio| by level_flips; empty for a way that is not possible.
  using Ways = std::array<std::optional<double>, 2>;

  double* crease(int i, int j, int k) {
    if (k == 0) return &m_.level[m_.level_crease(i, j)];
    if (k == 1) return &m_.rising[m_.rising_crease(i, j)];
    if (k == 2) return &m_.level[m_.level_crease(i - 1, j)];
    return &m_.rising[m_.rising_crease(i, j - 1)];
  }

  FourSigns signs_at(int i, int j) {
    return {*crease(i, j, 0), *crease(i, j, 1), *crease(i, j, 2), *crease(i, j, 3)};
  }

  Ways& ways(int i, int j) { return ways_[static_cast<std::size_t>(j - 1) * p_ + i - 1]; }

  Ways ways_at(int i, int j) {
    const Eigen::Vector4d sector = sectors(m_, i, j);
    const FourSigns known = signs_at(i, j);
    const bool is_known = known[0] * known[1] * known[2] * known[3] != 0;
    const double least = is_known ? least_fold_ratio : least_solved_ratio;
    Ways out;
    bool folds = false;
    for (const bool flips : {false, true}) {
      const double ratio = fold_ratio(sector[0], sector[1], flips);
      const double size = std::abs(ratio);
      if (!(size >= least && size <= 1 / least)) continue;
      folds = true;
      if (agree(known, signs_of_way(flips, ratio))) out[flips] = std::log(size);
    }
    if (!out[0] && !out[1]) refuse(i, j, known, folds);
    return out;
  }

  [[noreturn]] void refuse(int i, int j, const FourSigns& known, bool folds) const {
    const double product = known[0] * known[1] * known[2] * known[3];
    if (!folds)
      throw InvalidInput(name_(i, j) +
                         " does not fold: two of its creases lie on one line, and the other two are at right "
                         "angles to them. Change an angle");
    if (product == 0)
      throw InvalidInput(name_(i, j) + " does not fold with its mountains and valleys. Change one of them");
    if (product > 0)
      throw InvalidInput(name_(i, j) +
                         " does not fold. Give its opposite creases as one pair of equal folds, and one pair "
                         "of a mountain and a valley");
    throw InvalidInput(name_(i, j) +
                       " does not fold. Exchange the mountain and the valley of its unequal pair");
  }

  [[noreturn]] void refuse_open() {
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i)
        if (ways(i, j)[0] && ways(i, j)[1])
          for (int k = 0; k < 4; ++k)
            if (*crease(i, j, k) == 0) {
              const int to_i = i + (k == 0) - (k == 2), to_j = j + (k == 1) - (k == 3);
              throw InvalidInput(
                  "creases without mountain or valley fold in several ways. Assign \"M\" or \"V\" to "
                  "more of them, such as the crease from " +
                  name_(i, j) + " to " + name_(to_i, to_j));
            }
    throw InvalidInput(
        "the pattern is too large to solve for mountains and valleys. Assign them to all creases");
  }

  bool is_open() const {
    for (const Ways& ways : ways_)
      if (ways[0] && ways[1]) return true;
    return false;
  }

  /// Leaves one way to fold at each vertex. The ratio of vertex (i, j) is the multiplier of level line j over that of
  /// rising line i, so few combinations of ways fit together.
  void choose_ways() {
    if (!is_open()) return;
    if (p_ + q_ > max_tried_lines) refuse_open();
    rising_.assign(p_, 0);
    level_.assign(q_, 0);
    for (const double fitting : fitting_logarithms) {
      fitting_ = fitting;
      if (found_.empty()) try_line(1, 0);
    }
    if (found_.size() != 1) refuse_open();
    const auto [rising, level] = found_.front();
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i) {
        Ways& both = ways(i, j);
        if (!both[0] || !both[1]) continue;
        const double ratio = level[j - 1] - rising[i - 1];
        both[std::abs(*both[0] - ratio) > std::abs(*both[1] - ratio) ? 0 : 1].reset();
      }
  }

  /// Tries all multipliers of the next line that fit those of earlier lines. Lines come in turns, a column, then a row.
  /// The first column has multiplier 1. @param columns, rows numbers of lines with a multiplier
  void try_line(int columns, int rows) {
    if (found_.size() > 1) return;
    if (columns == p_ && rows == q_) {
      found_.emplace_back(rising_, level_);
      return;
    }
    const bool is_row = columns == p_ || (rows < columns && rows < q_);
    for (const auto& way : is_row ? ways(1, rows + 1) : ways(columns + 1, 1)) {
      if (!way) continue;
      if (is_row) {
        level_[rows] = rising_[0] + *way;
        if (fits_row(columns, rows + 1)) try_line(columns, rows + 1);
      } else {
        rising_[columns] = level_[0] - *way;
        if (fits_column(columns + 1, rows)) try_line(columns + 1, rows);
      }
    }
  }

  bool fits_row(int columns, int j) {
    for (int i = 1; i <= columns; ++i)
      if (!fits(i, j)) return false;
    return true;
  }

  bool fits_column(int i, int rows) {
    for (int j = 1; j <= rows; ++j)
      if (!fits(i, j)) return false;
    return true;
  }

  bool fits(int i, int j) {
    if (++tries_ > max_tries) refuse_open();
    for (const auto& way : ways(i, j))
      if (way && std::abs(level_[j - 1] - rising_[i - 1] - *way) <= fitting_) return true;
    return false;
  }

  /// Carries known signs over all vertices, each of which has one way to fold.
  void spread() {
    std::vector<std::array<int, 2>> waiting;
    for (int j = 1; j <= q_; ++j)
      for (int i = 1; i <= p_; ++i) waiting.push_back({i, j});
    while (!waiting.empty()) {
      const auto [i, j] = waiting.back();
      waiting.pop_back();
      const FourSigns known = signs_at(i, j);
      const bool flips = ways(i, j)[1].has_value();
      const Eigen::Vector4d sector = sectors(m_, i, j);
      FourSigns way = signs_of_way(flips, fold_ratio(sector[0], sector[1], flips));
      if (!agree(known, way)) refuse(i, j, known, true);
      double sign = 0;
      for (int k = 0; k < 4 && sign == 0; ++k) sign = known[k] * way[k];
      if (sign == 0) continue;
      for (int k = 0; k < 4; ++k) {
        if (known[k] != 0) continue;
        *crease(i, j, k) = sign * way[k];
        const int to_i = i + (k == 0) - (k == 2), to_j = j + (k == 1) - (k == 3);
        if (to_i >= 1 && to_i <= p_ && to_j >= 1 && to_j <= q_) waiting.push_back({to_i, to_j});
      }
    }
  }

  QuadMesh& m_;
  const VertexName& name_;
  int p_, q_;
  std::vector<Ways> ways_;
  std::vector<double> rising_, level_;  ///< logarithms of multipliers
  std::vector<std::pair<std::vector<double>, std::vector<double>>> found_;
  double fitting_ = 0;
  std::size_t tries_ = 0;
};

}  // namespace

bool level_flips(const QuadMesh& mesh, int i, int j) {
  return mesh.level[mesh.level_crease(i, j)] * mesh.level[mesh.level_crease(i - 1, j)] < 0;
}

double fold_ratio(double a, double b, bool level_flips) {
  return level_flips ? std::sin((a - b) / 2) / std::sin((a + b) / 2)
                     : -std::cos((a - b) / 2) / std::cos((a + b) / 2);
}

SolvedSigns solve_signs(QuadMesh& mesh, const VertexName& name) { return SignSolver(mesh, name).run(); }

}  // namespace kinetix::model
