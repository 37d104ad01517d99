#include "optim/curve/bend_ties.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/lines.hpp"
#include "model/lattice/square/numbering.hpp"

namespace kinetix::optim {
namespace {

int group(int column, int columns, Per per, Symmetry symmetry) {
  if (per == Per::all) return 0;
  const bool mirrored = symmetry == Symmetry::mirror_x || symmetry == Symmetry::rotate_2;
  return mirrored ? std::min(column, columns - 1 - column) : column;
}

/// Returns the range of a column's tilt in its first row. Tilts change sign from row to row.
AngleRange range_of_size(const model::Structure& strip, const BendTies& ties, int column) {
  const int first = strip.hinge_at({{column, 0}, model::Axis::x}).value();
  const AngleRange& bends = ties.range[ties.variable[column]];
  return ties.sign[column] * strip.hinges[first].parameters.beta > 0 ? bends
                                                                     : AngleRange{-bends.upper, -bends.lower};
}

}  // namespace

BendTies make_bend_ties(int columns, Per per, Symmetry symmetry, AngleRange beta) {
  if (per != Per::column && per != Per::all)
    throw InvalidInput(
        "a strip keeps its exact motion only if all tilts of a column agree; allowed: column, all");
  if (symmetry == Symmetry::rotate_4)
    throw InvalidInput(
        "a sheet that bends along x cannot have a four-fold symmetry; allowed: none, mirror_x, mirror_y, "
        "rotate_2");
  BendTies ties;
  for (int c = 0; c < columns; ++c) {
    ties.variable.push_back(group(c, columns, per, symmetry));
    // A turn from +x towards +z needs a negative tilt in the even columns.
    ties.sign.push_back(-model::column_sign(c));
  }
  const int variables = 1 + *std::max_element(ties.variable.begin(), ties.variable.end());
  ties.range.assign(variables, {-INFINITY, INFINITY});
  for (int c = 0; c < columns; ++c) {
    AngleRange& range = ties.range[ties.variable[c]];
    range.lower = std::max(range.lower, ties.sign[c] > 0 ? beta.lower : -beta.upper);
    range.upper = std::min(range.upper, ties.sign[c] > 0 ? beta.upper : -beta.lower);
  }
  for (const AngleRange& range : ties.range)
    if (!(range.lower < range.upper))
      throw InvalidInput("the tied columns tilt both ways, and the range leaves them nothing in common");
  return ties;
}

std::vector<TiltTie> tied_tilts(const model::Structure& strip, const BendTies& ties) {
  std::vector<TiltTie> out;
  std::map<int, std::size_t> at;  // variable to its index in `out`
  for (TiltTie& line : tilt_ties(strip)) {
    const int column = line_of(strip.hinges[line.hinges.front()].wall);
    const auto [place, is_new] = at.try_emplace(ties.variable[column], out.size());
    if (is_new) {
      line.range = range_of_size(strip, ties, column);
      out.push_back(std::move(line));
      continue;
    }
    TiltTie& tie = out[place->second];
    tie.hinges.insert(tie.hinges.end(), line.hinges.begin(), line.hinges.end());
    tie.signs.insert(tie.signs.end(), line.signs.begin(), line.signs.end());
  }
  return out;
}

}  // namespace kinetix::optim
