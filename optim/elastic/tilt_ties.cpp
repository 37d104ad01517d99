#include "optim/elastic/tilt_ties.hpp"

#include <cmath>
#include <map>
#include <tuple>

namespace kinetix::optim {
namespace {

// Tolerance of numbers that differ by rounding: cell edges, and rad.
constexpr double same = 1e-6;

/// Direction of the wall, place of its middle along that direction, and size of its tilt, each rounded.
using Place = std::tuple<long, long, long, long>;

long rounded(double value) { return std::lround(value / same); }

Place place_of(const model::Lattice& sheet, int hinge) {
  const model::HingedWall wall = sheet.wall(hinge);
  const double edge = sheet.size().edge_mm;
  const Eigen::Vector3d from = sheet.rest_position(wall.lower) / edge,
                        to = sheet.rest_position(wall.upper) / edge;
  Eigen::Vector3d along = (to - from).normalized();
  if (along.x() < -same || (std::abs(along.x()) <= same && along.y() < 0)) along = -along;
  return {rounded(along.x()), rounded(along.y()), rounded(along.dot(from + to) / 2),
          rounded(std::abs(wall.hinge.beta))};
}

}  // namespace

std::vector<TiltTie> tilt_ties(const model::Lattice& sheet) {
  std::vector<TiltTie> ties;
  std::map<Place, std::size_t> tie_at;
  for (int h = 0; h < sheet.hinges(); ++h) {
    const double beta = sheet.hinge(h).beta;
    if (std::abs(beta) <= same) continue;
    const auto [at, is_new] = tie_at.try_emplace(place_of(sheet, h), ties.size());
    if (is_new) ties.push_back({{}, {}, std::abs(beta)});
    ties[at->second].hinges.push_back(h);
    ties[at->second].signs.push_back(beta > 0 ? 1 : -1);
  }
  return ties;
}

model::Lattice with_tilts(model::Lattice sheet, const std::vector<TiltTie>& ties,
                          const std::vector<double>& tilts) {
  for (std::size_t k = 0; k < ties.size(); ++k)
    for (std::size_t h = 0; h < ties[k].hinges.size(); ++h)
      sheet.hinge(ties[k].hinges[h]).beta = ties[k].signs[h] * tilts[k];
  return sheet;
}

}  // namespace kinetix::optim
