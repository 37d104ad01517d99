#pragma once

#include <random>
#include <set>

#include "model/lattice/square/crease.hpp"
#include "model/lattice/square/family/net.hpp"

namespace kinetix::testing {

/// Cells that grew one by one from [8, 8], each beside one that was there; branches and holes among them.
inline std::vector<model::Cell> random_cells(int count, std::mt19937& random) {
  std::set<model::Cell> cells = {{8, 8}};
  while (static_cast<int>(cells.size()) < count) {
    auto at = cells.begin();
    std::advance(at, std::uniform_int_distribution<std::size_t>(0, cells.size() - 1)(random));
    constexpr int steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const auto& step = steps[std::uniform_int_distribution<int>(0, 3)(random)];
    const model::Cell next{at->i + step[0], at->j + step[1]};
    if (next.i >= 0 && next.j >= 0) cells.insert(next);
  }
  return {cells.begin(), cells.end()};
}

/// Gives creases in random order a tilt up to 60 deg wherever the rules of nets let them have one.
inline void tilt_at_random(model::Structure& structure, std::mt19937& random) {
  const model::Creases creases = find_creases(structure);
  std::vector<int> order(creases.list.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::shuffle(order.begin(), order.end(), random);
  std::uniform_real_distribution<double> tilt(-60 * radians_per_degree, 60 * radians_per_degree);
  for (const int k : order) {
    const model::Structure before = structure;
    set_tilt(structure, creases.list[k], tilt(random));
    if (check_net(structure).broken > 0) structure = before;
  }
}

inline model::Structure random_net(int cells, std::mt19937& random) {
  model::Structure structure = make_structure(random_cells(cells, random), {});
  tilt_at_random(structure, random);
  return structure;
}

/// The cube net of kinematics.md: a cross of six faces of 3 x 3 bodies, creases of one column between.
inline model::Structure cube_net(double tilt) {
  std::vector<model::Cell> cells;
  const auto add = [&](int i0, int i1, int j0, int j1) {
    for (int i = i0; i < i1; ++i)
      for (int j = j0; j < j1; ++j) cells.push_back({i, j});
  };
  add(3, 5, 0, 11);
  add(0, 3, 3, 5);
  add(5, 8, 3, 5);
  model::Structure structure = make_structure(std::move(cells), {});
  const model::Creases creases = find_creases(structure);
  for (const model::Wall wall : {model::Wall{{2, 3}, model::Axis::x}, model::Wall{{5, 3}, model::Axis::x},
                                 model::Wall{{3, 2}, model::Axis::y}, model::Wall{{3, 5}, model::Axis::y},
                                 model::Wall{{3, 8}, model::Axis::y}})
    set_tilt(structure, creases.list[creases.of_hinge[*structure.hinge_at(wall)]], turn_sense(wall) * tilt);
  return structure;
}

/// Returns a fishbone: a spine one cell wide along y, whose even rows carry ribs of `half` cells to both sides. Its odd
/// rows bend by the tilt. The ribs' columns bend by up to it, at random, all downwards.
inline model::Structure fishbone(int half, int rows, double tilt, unsigned seed = 1) {
  std::vector<model::Cell> cells;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i <= 2 * half; ++i)
      if (i == half || j % 2 == 0) cells.push_back({i, j});
  model::Structure net = make_structure(std::move(cells), {});
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.3, 1.0);
  for (const model::Crease& crease : find_creases(net).list) {
    const model::Wall& wall = net.hinges[crease.hinges[0]].wall;
    if (wall.axis == model::Axis::x ? wall.from.i == half : wall.from.j % 2 == 0) continue;
    set_tilt(net, crease, turn_sense(wall) * tilt * (wall.axis == model::Axis::x ? share(random) : 1));
  }
  return net;
}

}  // namespace kinetix::testing
