#include "app/studio/messages/bodies_message.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "app/result/bodies_json.hpp"
#include "model/base/angle.hpp"

namespace kinetix::app::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr double rattles = 2 * radians_per_degree;  // rad: what gives way by less does not move

Json size_json(const model::Assembly& assembly) {
  Eigen::AlignedBox3d box;
  for (const model::AssemblyBody& body : assembly.bodies)
    for (const Eigen::Vector3d& p : body.solid.points) box.extend(p);
  const Eigen::Vector3d size = box.sizes();
  return {size.x(), size.y(), size.z()};
}

std::string end_words(const BodiesWay& way, int end, const model::Assembly& assembly) {
  if (way.opens[end] < 0) return "";
  return fmt::format("Beyond {:.0f} degrees {} opens first.",
                     to_degrees(end == 0 ? way.turns.front() : way.turns.back()),
                     assembly.hinges[way.opens[end]].name);
}

std::string meeting_words(const Meeting& met, const model::Assembly& assembly) {
  return fmt::format("At {:.0f} degrees {} and {} run into each other.", to_degrees(met.turn),
                     assembly.bodies[met.bodies[0]].name, assembly.bodies[met.bodies[1]].name);
}

Json why(const BodiesWay& way, const model::Assembly& assembly) {
  if (!way.followed) return {"How far it turns is being found."};
  Json out = Json::array();
  for (const std::string& words : {end_words(way, 0, assembly), end_words(way, 1, assembly)})
    if (!words.empty()) out.push_back(words);
  if (out.empty())
    out.push_back(fmt::format("All hinges stay closed from {:.0f} to {:.0f} degrees.",
                              to_degrees(way.turns.front()), to_degrees(way.turns.back())));
  if (!way.meets) return out;
  const auto& [back, forth] = *way.meets;
  for (const auto& met : {back, forth})
    if (met) out.push_back(meeting_words(*met, assembly));
  out.push_back(back || forth ? "The exact motion goes on through bodies that meet; the physics does not."
                              : "No two bodies meet on the way.");
  return out;
}

Json meets_json(const BodiesWay& way) {
  if (!way.meets) return nullptr;
  Json out = Json::array();
  for (const auto& met : *way.meets)
    out.push_back(met ? Json{{"turn_rad", met->turn}, {"bodies", met->bodies}} : Json(nullptr));
  return out;
}

Json opener(int hinge) { return hinge < 0 ? Json(nullptr) : Json(hinge); }

}  // namespace

Json meshes_message(const model::Assembly& assembly) {
  Json out = {{"type", "meshes"}};
  out.update(meshes_json(assembly));
  return out;
}

Json bodies_message(const Design& design, const Moving& moving) {
  const model::Assembly& assembly = *design.structure.assembly();
  const BodiesWay& way = *moving.way;
  return {{"type", "design"},
          {"name", design.name},
          {"structure", shown_bodies_json(assembly)},
          {"theta_rad", asked_theta(design, moving)},
          {"theta_range_rad", {moving.least_theta, moving.most_theta}},
          {"exact", way.turns.back() - way.turns.front() > rattles},
          {"family", moving.exact.name},
          {"why", why(way, assembly)},
          {"breaking", Json::array()},
          {"hinge", {{"kind", "bodies"}, {"text", "as they were imported"}}},
          {"drive", way.pulled ? "bodies that are pulled" : "one hinge that is turned"},
          {"flat_mm", size_json(assembly)},
          {"bodies",
           {{"driven", way.hinge},
            {"pulled", way.pulled},
            {"turn_per_theta", model::turn_at_theta(way.sense, 1)},
            {"turn_range_rad", {way.turns.front(), way.turns.back()}},
            {"opens", {opener(way.opens[0]), opener(way.opens[1])}},
            {"meets", meets_json(way)},
            {"following", !way.followed}}}};
}

}  // namespace kinetix::app::studio
