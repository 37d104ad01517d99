#include "model/lattice/square/cell_tuple.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

// Tolerance of t (fraction) and angles (rad): allows the rounding of degrees, but no real difference.
constexpr double agreement = 1e-9;

bool agree(const HingeParameters& a, const HingeParameters& b) {
  return std::abs(a.t - b.t) <= agreement && std::abs(a.alpha - b.alpha) <= agreement &&
         std::abs(a.beta - b.beta) <= agreement;
}

HingeParameters mean(const HingeParameters& a, const HingeParameters& b) {
  return {.t = (a.t + b.t) / 2, .alpha = (a.alpha + b.alpha) / 2, .beta = (a.beta + b.beta) / 2};
}

InvalidInput conflict(const Structure& s, int first, int second) {
  return InvalidInput("cells " + to_string(s.cells[first]) + " and " + to_string(s.cells[second]) +
                      " disagree about the wall they share; make the tuples agree or give `shared: average`");
}

}  // namespace

HingeParameters CellTuple::wall(int k) const {
  const bool reversed = k >= 2;
  if (reversed) return {.t = 1 - P[k], .alpha = pi - A_in[k], .beta = -A_out[k]};
  return {.t = P[k], .alpha = A_in[k], .beta = A_out[k]};
}

void apply_pattern(Structure& s, const CellTuple& even, const CellTuple& odd, SharedWalls shared) {
  std::vector<int> giver(s.hinges.size(), -1);
  for (int c = 0; c < static_cast<int>(s.cells.size()); ++c) {
    const CellTuple& tuple = ((s.cells[c].i + s.cells[c].j) & 1) == 0 ? even : odd;
    for (int k = 0; k < 4; ++k) {
      const int h = s.cell_members[c].hinges[k];
      const HingeParameters wanted = tuple.wall(k);
      HingeParameters& current = s.hinges[h].parameters;
      if (giver[h] < 0) {
        current = wanted;
        giver[h] = c;
      } else if (!agree(current, wanted)) {
        if (shared == SharedWalls::must_agree) throw conflict(s, giver[h], c);
        current = mean(current, wanted);
      }
    }
  }
}

}  // namespace kinetix::model
