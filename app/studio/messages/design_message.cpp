#include "app/studio/messages/design_message.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "app/print/format/print_format.hpp"
#include "app/result/state_json.hpp"
#include "app/run/forecast.hpp"
#include "app/studio/messages/message.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/version.hpp"
#include "model/base/angle.hpp"
#include "model/matter/material.hpp"
#include "model/matter/process.hpp"

namespace kinetix::app::studio {
namespace {

using Json = nlohmann::ordered_json;

Json hinge_json(const HingeSection& hinge) {
  if (!hinge.made)
    return {
        {"kind", "stiff"},
        {"text", fmt::format("They turn freely and hold without play. Where forces are asked for, they are "
                             "taken as {} N/mm, and {} N mm/rad against turning.",
                             plain_number(hinge.k_point), plain_number(hinge.k_turn))}};
  return {{"kind", to_string(hinge.made->kind)},
          {"material", hinge.made->material.name},
          {"text", hinge_text(hinge)}};
}

Json numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

constexpr double rattles = 2 * radians_per_degree;  // rad: hinges that give way by less count as fixed

Json size_json(const model::Assembly& assembly) {
  Eigen::AlignedBox3d box;
  for (const model::AssemblyBody& body : assembly.bodies)
    for (const Eigen::Vector3d& p : body.solid.points) box.extend(p);
  const Eigen::Vector3d size = box.sizes();
  return {size.x(), size.y(), size.z()};
}

std::string end_words(const BodiesMotion& way, int end, const model::Assembly& assembly) {
  if (way.opens[end] < 0) return "";
  return fmt::format("Beyond {:.0f} degrees {} opens first.",
                     to_degrees(end == 0 ? way.turns.front() : way.turns.back()),
                     assembly.hinges[way.opens[end]].name);
}

std::string meeting_words(const Meeting& met, const model::Assembly& assembly) {
  return fmt::format("At {:.0f} degrees {} and {} run into each other.", to_degrees(met.turn),
                     assembly.bodies[met.bodies[0]].name, assembly.bodies[met.bodies[1]].name);
}

Json why(const BodiesMotion& way, const model::Assembly& assembly) {
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

Json meets_json(const BodiesMotion& way) {
  if (!way.meets) return nullptr;
  Json out = Json::array();
  for (const auto& met : *way.meets)
    out.push_back(met ? Json{{"turn_rad", met->turn}, {"bodies", met->bodies}} : Json(nullptr));
  return out;
}

Json opener(int hinge) { return hinge < 0 ? Json(nullptr) : Json(hinge); }

}  // namespace

Json hello_message(const std::string& name) {
  Json out = {{"type", "hello"}, {"version", version}, {"name", name}};
  for (const char* list : {"templates", "processes", "materials", "formats"}) out[list] = Json::array();
  for (const Template& one : templates())
    out["templates"].push_back({{"name", one.name}, {"about", one.about}});
  for (const model::Process& process : model::processes()) out["processes"].push_back(process.name);
  for (const model::Material& material : model::materials()) out["materials"].push_back(material.name);
  for (const PrintFormat* format : print_formats())
    out["formats"].push_back({{"name", format->name}, {"about", format->meaning}});
  return out;
}

Json design_message(const Design& design, const Moving& moving) {
  if (moving.bodies) return bodies_message(design, moving);
  return {{"type", "design"},
          {"name", design.name},
          {"structure", sheet_json(design)},
          {"theta_rad", design.theta},
          {"theta_range_rad", {moving.least_theta, moving.most_theta}},
          {"exact", static_cast<bool>(moving.exact)},
          {"family", moving.exact.name},
          {"why", moving.exact.why},
          {"breaking", moving.nearest ? moving.nearest->changed : std::vector<int>{}},
          {"hinge", hinge_json(design.hinge)},
          {"drive", design.drive ? describe(*design.drive) : ""},
          {"flat_mm", numbers(flat_size(moving.linkage))}};
}

Json state_message(const Player& player) {
  const char* modes[] = {"exact", "equilibrium", "bullet"};
  return {{"type", "state"},
          {"mode", modes[static_cast<int>(player.mode())]},
          {"paused", player.paused()},
          {"gravity", player.gravity()},
          {"springs", player.springs()},
          {"speed", player.speed()},
          {"fixed", player.fixed()},
          {"driven", player.driven()}};
}

Json error_message(const std::string& what, double id, const std::string& about) {
  Json out = {{"type", "error"}, {"message", what}};
  if (!about.empty()) out["about"] = about;
  if (id > 0) out["id"] = id;
  return out;
}

Json progress_message(const char* job, const std::string& stage, double done, const std::string& so_far) {
  Json out = {{"type", "progress"},
              {"job", job},
              {"text", so_far.empty() ? stage : stage + ": " + so_far},
              {"done", nullptr},
              {"left_s", nullptr}};
  if (done >= 0) out["done"] = done;
  return out;
}

Json meshes_message(const model::Assembly& assembly) {
  Json out = {{"type", "meshes"}};
  out.update(meshes_json(assembly));
  return out;
}

Json bodies_message(const Design& design, const Moving& moving) {
  const model::Assembly& assembly = *design.structure.assembly();
  const BodiesMotion& way = *moving.way;
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
