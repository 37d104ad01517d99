#include "optim/helmet_collisions.hpp"

#include <algorithm>
#include <set>

#include "model/net.hpp"

namespace kinetix {
namespace {

constexpr int looks = 16;
constexpr std::size_t most_named = 3;

std::vector<WallPair> meeting(const Structure& structure, double theta) {
  const NetTree tree = make_net_tree(structure);
  WallContact contact(structure);
  std::set<WallPair> found;
  for (int k = 1; k <= looks; ++k) {
    const auto& pairs = contact.overlapping(fold_net(tree, structure, theta * k / looks));
    found.insert(pairs.begin(), pairs.end());
  }
  return {found.begin(), found.end()};
}

}  // namespace

HelmetCollisions::HelmetCollisions(const Fishbone& fishbone, double theta)
    : layout_(fishbone.layout),
      spine_column_(fishbone.spine_column),
      walls_(half_walls(fishbone.structure)),
      bodies_(fishbone.structure.bodies),
      pairs_(meeting(fishbone.structure, theta)) {
  for (const Hinge& hinge : fishbone.structure.hinges) names_.push_back(to_string(hinge.wall));
}

HelmetCollisions::Seat HelmetCollisions::seat(int half) const {
  const Vertex v = bodies_[walls_[half].body];
  const int left = spine_column_ - v.i, right = v.i - spine_column_ - 1;
  if (left <= 0 && right <= 0) return {};
  for (std::size_t r = 0; r < layout_.ribs.size(); ++r)
    if (const int row = layout_.ribs[r].row; v.j == row || v.j == row + 1)
      return {static_cast<int>(r), left > 0 ? 0 : 1, std::max(left, right)};
  return {};
}

int HelmetCollisions::trim(FishboneLayout& bones) const {
  int taken = 0;
  for (const WallPair& pair : pairs_) {
    const Seat a = seat(pair.first), b = seat(pair.second);
    if (a.rib == b.rib && a.side == b.side) continue;
    const Seat& cut = a.cells >= b.cells ? a : b;
    int& cells = bones.ribs[cut.rib].cells[cut.side];
    taken += std::max(0, cells - (cut.cells - 1));
    cells = std::min(cells, cut.cells - 1);
  }
  return taken;
}

std::vector<std::string> HelmetCollisions::in_words() const {
  std::vector<std::string> out;
  for (const WallPair& pair : pairs_) {
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

}  // namespace kinetix
