#include "model/lattice/planar/wall_dofs.hpp"

#include <algorithm>
#include <map>

namespace kinetix::model {
namespace {

constexpr int pebbles = 3;  // pebbles per vertex: a body's two coordinates and its turn
// Pebbles of any set of vertices that always stay: three rigid motions, and the exact one
constexpr int stay = 4;

}  // namespace

WallDofs::WallDofs(const PlanarGraph& graph)
    : free_(graph.vertices.size(), pebbles), leads_to_(graph.vertices.size()) {
  for (const GraphEdge& wall : graph.edges) add_wall(wall);
}

void WallDofs::add_vertex() {
  free_.push_back(pebbles);
  leads_to_.emplace_back();
}

int WallDofs::add_wall(const GraphEdge& wall) {
  int held = 0;
  while (held < 2 && hold(wall.from, wall.to)) ++held;
  held_ += held;
  return held;
}

bool WallDofs::hold(int a, int b) {
  while (free_[a] + free_[b] <= stay)
    if (!fetch(a, b) && !fetch(b, a)) return false;
  const int giver = free_[a] > 0 ? a : b;
  --free_[giver];
  leads_to_[giver].push_back(giver == a ? b : a);
  return true;
}

/// Moves a free pebble along walls to a vertex and reverses the walls; a pebble at `keep` stays.
bool WallDofs::fetch(int to, int keep) {
  std::map<int, int> reached_from = {{to, to}, {keep, keep}};
  std::vector<int> open = {to};
  for (std::size_t k = 0; k < open.size(); ++k)
    for (const int next : leads_to_[open[k]]) {
      if (!reached_from.try_emplace(next, open[k]).second) continue;
      open.push_back(next);
      if (free_[next] == 0) continue;
      --free_[next];
      ++free_[to];
      for (int at = next; at != to; at = reached_from[at]) {
        const int before = reached_from[at];
        leads_to_[before].erase(std::find(leads_to_[before].begin(), leads_to_[before].end(), at));
        leads_to_[at].push_back(before);
      }
      return true;
    }
  return false;
}

}  // namespace kinetix::model
