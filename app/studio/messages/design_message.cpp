#include "app/studio/messages/design_message.hpp"

#include <fmt/format.h>

#include "app/print/format/formats.hpp"
#include "app/result/same_sheet.hpp"
#include "app/run/forecast.hpp"
#include "app/studio/messages/bodies_message.hpp"
#include "app/studio/messages/plain_number.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/version.hpp"
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

}  // namespace kinetix::app::studio
