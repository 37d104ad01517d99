#include "model/lattice/turn_laws.hpp"

#include "model/lattice/square/family/classify.hpp"

namespace kinetix::model {
namespace {

/// Adds the shifts of creases that bend and cross, whose fold angles differ
/// (model/lattice/square/family/fold_angles.hpp). In a net they replace theta; in the other families theta is half
/// the turn of the crease that defines it.
void add_shifts(const Structure& squares, std::vector<TurnLaw>& laws) {
  const Classification kind = classify(squares);
  const Creases creases = find_creases(squares);
  const std::vector<double> shifts = fold_shifts(make_fold_angle_tree(squares, creases), squares);
  double own = 1, local_shift = 0;
  if (kind.family != Family::F4) {
    const int defining = squares.cell_members.front().hinges[kind.transposed ? 0 : 1];
    own = laws[defining].p;
    local_shift = shifts[creases.of_hinge[defining]];
  }
  for (std::size_t h = 0; h < laws.size(); ++h)
    laws[h] = {laws[h].p / own, laws[h].p * (shifts[creases.of_hinge[h]] - local_shift)};
}

}  // namespace

std::vector<TurnLaw> turn_laws(const Lattice& sheet) {
  std::vector<TurnLaw> laws = usual_turn_laws(sheet);
  if (sheet.squares() && !all_vertical(*sheet.squares())) add_shifts(*sheet.squares(), laws);
  return laws;
}

}  // namespace kinetix::model
