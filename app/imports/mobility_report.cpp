#include "app/imports/mobility_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "model/assembly/assembly_motion.hpp"
#include "model/base/angle.hpp"
#include "model/closure/gruebler.hpp"

namespace kinetix::app {
namespace {

constexpr double looked_at = 60 * radians_per_degree;  // rad of a hinge: as far as most sheets fold
// Of a closure Jacobian's singular value: axes from meshes of floats are off by 1e-6 rad, which leaves a mechanism's zeros at
// about as much; those of structures that hold are 1e-3 and more.
constexpr double smallest = 1e-4;
constexpr double least_turn = 2 * radians_per_degree;  // rad: what gives way by less only rattles
constexpr double most_strain =
    1e-3;  // rad and cell edges per rad: a first motion that opens hinges faster is none

}  // namespace

AssemblyMobility examine(const model::Assembly& assembly) {
  const model::Linkage linkage = linkage_of(assembly);
  AssemblyMobility out;
  const int hinges = static_cast<int>(linkage.hinges.size());
  out.gruebler = model::gruebler_spatial(static_cast<int>(linkage.bodies.size()), hinges, hinges);
  out.at_rest = degrees_of_freedom(linkage, rest_state(linkage), linkage.hinges.size(), smallest);
  const model::FirstMotion first = first_motion(linkage);
  if ((out.at_rest && *out.at_rest <= 0) || first.fastest < 0 || first.strain > most_strain) {
    if (out.at_rest && *out.at_rest <= 0) out.broken = first_rigid_hinge(linkage, smallest);
    out.why = "rigid: no motion at rest keeps all hinges closed";
    if (out.broken >= 0)
      out.why += fmt::format("; in their order `{}` is the first with which nothing moves",
                             assembly.hinges[out.broken].name);
    return out;
  }
  out.hinge = first.fastest;
  out.sense = first.rate < 0 ? -1 : 1;
  const model::AssemblyMotion way = follow_turn(linkage, first, out.hinge, out.sense * looked_at);
  out.turn = std::abs(way.turns.back());
  out.broken = way.broken;
  const std::string count = out.at_rest ? fmt::format("{} first-order motion{} at rest; ", *out.at_rest,
                                                      *out.at_rest == 1 ? "" : "s")
                                        : "";
  const std::string& driven = assembly.hinges[out.hinge].name;
  if (way.reached)
    out.why = fmt::format(
        "{}`{}` turns by {:.0f} degrees and all hinges stay closed, within {:.1e} cell edges and {:.1e} rad",
        count, driven, to_degrees(out.turn), way.gap, way.axis_gap);
  else
    out.why = fmt::format("{}`{}` turns by {:.0f} degrees{}; beyond, `{}` opens first", count, driven,
                          to_degrees(out.turn), out.turn < least_turn ? ": hardly at all" : "",
                          assembly.hinges[way.broken].name);
  return out;
}

nlohmann::ordered_json mobility_json(const AssemblyMobility& m, const model::Assembly& assembly) {
  nlohmann::ordered_json out = {{"gruebler", m.gruebler},       {"flat", nullptr},   {"hinge", nullptr},
                                {"turn_rad", m.sense * m.turn}, {"broken", nullptr}, {"why", m.why}};
  if (m.at_rest) out["flat"] = *m.at_rest;
  if (m.hinge >= 0) out["hinge"] = assembly.hinges[m.hinge].name;
  if (m.broken >= 0) out["broken"] = assembly.hinges[m.broken].name;
  return out;
}

}  // namespace kinetix::app
