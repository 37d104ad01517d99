#include "model/lattice/origami/march.hpp"

namespace kinetix::model {

MarchData miura(int columns, int rows, double angle, double multiplier) {
  const int p = columns - 1, q = rows - 1;
  MarchData d;
  for (int i = 0; i < p; ++i) d.rising.push_back(i % 2 == 0 ? multiplier : -multiplier);
  for (int j = 0; j < q; ++j) {
    d.level.push_back((j % 2 == 0 ? -1 : 1) * std::cos(angle) * multiplier);
    d.left_angle.push_back(j % 2 == 0 ? angle : pi - angle);
  }
  for (int i = 0; i < p; ++i) d.bottom_angle.push_back(angle);
  d.bottom_length.assign(p - 1, 1);
  d.left_length.assign(q - 1, 1);
  d.west.assign(q, 1);
  d.east.assign(q, 1);
  d.south.assign(p, 1);
  d.north.assign(p, 1);
  return d;
}

}  // namespace kinetix::model
