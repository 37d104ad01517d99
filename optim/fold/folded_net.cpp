#include "optim/fold/folded_net.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/lattice/square/crease.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::optim {
namespace {

/// Tilts the walls of a crease so that its far sides rise for a positive turn.
void set_fold(model::Structure& structure, const targets::PlacedCrease& crease, double tilt) {
  for (const model::Wall& wall : bending_walls(crease))
    structure.hinges[*structure.hinge_at(wall)].parameters.beta =
        -alternation(wall) * turn_sense(wall) * tilt;
}

}  // namespace

FoldedNet fold_to(const targets::FoldNet& net, const std::vector<int>& columns, double theta,
                  const model::CellSize& size, double most_tilt) {
  FoldedNet out;
  out.net = net;
  out.layout = lay_out(net, columns);
  out.theta = theta;
  out.structure = make_structure(out.layout.cells, size);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double wanted = model::tilt_of_turn(net.creases[c].angle / columns[c], theta);
    const double tilt = std::clamp(wanted, -most_tilt, most_tilt);
    set_fold(out.structure, out.layout.creases[c], tilt);
    out.tilt.push_back(std::abs(tilt));
  }
  out.tree = make_net_tree(out.structure, middle_body(out.layout.faces[0], out.structure));
  out.error = fold_error(net, out.layout, out.structure, fold_net(out.tree, out.structure, theta), theta);
  return out;
}

std::vector<int> parts_of_bodies(const FoldedNet& folded) {
  std::vector<int> part(folded.structure.bodies.size(), -1);
  const targets::NetLayout& layout = folded.layout;
  for (std::size_t f = 0; f < layout.faces.size(); ++f)
    for (const int body : bodies_of(layout.faces[f], folded.structure)) part[body] = static_cast<int>(f);
  for (std::size_t c = 0; c < layout.creases.size(); ++c)
    for (const model::Wall& wall : bending_walls(layout.creases[c])) {
      const model::Hinge& hinge = folded.structure.hinges[*folded.structure.hinge_at(wall)];
      for (const int body : {hinge.lower, hinge.upper})
        if (part[body] < 0) part[body] = static_cast<int>(layout.faces.size() + c);
    }
  return part;
}

std::string part_name(const targets::FoldNet& net, int part) {
  const int faces = static_cast<int>(net.faces.size());
  if (part < faces) return "face " + targets::in_ticks(net.faces[part].name);
  return "crease " + targets::in_ticks(crease_name(net, net.creases[part - faces]));
}

}  // namespace kinetix::optim
