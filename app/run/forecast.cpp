#include "app/run/forecast.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/linkage/half_wall.hpp"

namespace kinetix::app {
namespace {

// Seconds per loop: median over the shapes of targets/shapes, whose simulations take 0.01 to 2 s.
constexpr double seconds_per_loop = 0.0012;
constexpr double seconds_of_block = 2.4;  // s for 1000 bodies that fill space; 0.7 s for 384, 27 s for 4952
// Seconds for 175 bodies: the path to the goal and the compensation for elastic hinges. Measured: 0.5 to 2.6 s for 34
// to 173 bodies.
constexpr double elastic_seconds_of_175 = 2.5;
constexpr double contact_seconds_of_10000 = 2.4;
constexpr double bytes_of_program = 55e6, bytes_per_body = 65e3;

/// Rounds to one significant digit: 23.4 becomes 20.
double one_digit(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)));
  return unit * std::round(x / unit);
}

}  // namespace

double matter_seconds(const GoalSettings& settings, const model::Lattice& sheet) {
  return settings.hinge.model == HingeSection::Model::elastic
             ? elastic_seconds_of_175 * std::pow(sheet.bodies() / 175.0, 1.25)
             : 0;
}

void add_settings(const GoalSettings& settings, Forecast& forecast) {
  note_process(settings, forecast.sheet.size(), forecast.notes);
  forecast.search_s += matter_seconds(settings, forecast.sheet);
}

Eigen::Vector3d flat_size(const model::Linkage& linkage) { return size_of(linkage, rest_state(linkage)); }

Eigen::Vector3d size_of(const model::Linkage& linkage, const model::State& state) {
  Eigen::AlignedBox3d all;
  // Plates are handled one by one: the half walls of a million cells take half as much memory as their linkage.
  model::Linkage one;
  one.size = linkage.size;
  for (const model::Plate& plate : linkage.plates) {
    one.plates = {plate};
    const model::HalfWall wall = half_walls(one).front();
    const OrientedBox box = placed(wall, state[wall.body]);
    for (int k = 0; k < 3; ++k)
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector3d outward = side * Eigen::Vector3d::Unit(k);
        all.extend(Eigen::Vector3d(box.center + support(box, outward) * outward));
      }
  }
  return all.sizes();
}

double physics_seconds(const model::Lattice& sheet) {
  if (sheet.sodalite()) return seconds_of_block * std::pow(sheet.bodies() / 1000.0, 1.45);
  const double loops = sheet.hinges() - sheet.bodies() + 1.0;
  return seconds_per_loop * std::max(loops, 1.0);
}

double contact_seconds(const model::Lattice& sheet) {
  return contact_seconds_of_10000 * std::pow(sheet.bodies() / 1e4, 1.33);
}

double memory_needed(const model::Linkage& linkage) {
  return bytes_of_program + bytes_per_body * static_cast<double>(linkage.bodies.size());
}

std::string about(double seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 100) return fmt::format("about {:g} s", one_digit(seconds));
  if (seconds < 100 * 60) return fmt::format("about {:g} minutes", one_digit(seconds / 60));
  return fmt::format("about {:g} hours", one_digit(seconds / 3600));
}

}  // namespace kinetix::app
