#include "optim/ribs/ribs_collisions.hpp"

#include <algorithm>
#include <set>

#include "model/lattice/square/family/net.hpp"

namespace kinetix::optim {
namespace {

constexpr int looks = 16;              // states from flat to theta: a contact between two of them is missed
constexpr std::size_t most_named = 3;  // pairs of walls: enough to find the place

std::vector<model::WallPair> meeting(const model::Structure& structure, double theta) {
  const model::NetTree tree = make_net_tree(structure);
  model::WallContact contact(structure);
  std::set<model::WallPair> found;
  for (int k = 1; k <= looks; ++k) {
    const auto& pairs = contact.overlapping(fold_net(tree, structure, theta * k / looks));
    found.insert(pairs.begin(), pairs.end());
  }
  return {found.begin(), found.end()};
}

}  // namespace

RibsCollisions::RibsCollisions(const model::Fishbone& fishbone, double theta)
    : walls_(half_walls(fishbone.structure)), pairs_(meeting(fishbone.structure, theta)) {
  for (const model::Hinge& hinge : fishbone.structure.hinges) names_.push_back(to_string(hinge.wall));
  for (int b = 0; b < static_cast<int>(fishbone.structure.bodies.size()); ++b)
    places_.push_back(model::place_of(fishbone, b));
}

int RibsCollisions::trim(model::FishboneLayout& spine_and_ribs) const {
  int taken = 0;
  for (const model::WallPair& pair : pairs_) {
    const model::FishbonePlace &a = place_of_plate(pair.first), &b = place_of_plate(pair.second);
    if (a.rib == b.rib && a.side == b.side) continue;
    const model::FishbonePlace& cut = a.cells >= b.cells ? a : b;
    int& cells = spine_and_ribs.ribs[cut.rib].cells[cut.side];
    taken += std::max(0, cells - (cut.cells - 1));
    cells = std::min(cells, cut.cells - 1);
  }
  return taken;
}

std::vector<std::string> RibsCollisions::in_words() const {
  std::vector<std::string> out;
  for (const model::WallPair& pair : pairs_) {
    std::string words =
        "walls " + names_[walls_[pair.first].hinge] + " and " + names_[walls_[pair.second].hinge] + " meet";
    if (std::find(out.begin(), out.end(), words) == out.end()) out.push_back(std::move(words));
  }
  if (out.size() <= most_named) return out;
  const std::string more = "and so do " + std::to_string(out.size() - most_named) + " more pairs of walls";
  out.resize(most_named);
  out.push_back(more);
  return out;
}

}  // namespace kinetix::optim
