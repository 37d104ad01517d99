#include "app/result/bodies_json.hpp"

#include <nlohmann/json.hpp>

#include "app/result/state_json.hpp"

namespace kinetix::app {
namespace {

nlohmann::ordered_json joint_json(const model::AssemblyHinge& h) {
  nlohmann::ordered_json out = {{"name", h.name},
                                {"bodies", {h.lower, h.upper}},
                                {"point_mm", point_json(h.point)},
                                {"axis", point_json(h.axis)},
                                {"reach_mm", h.reach_mm},
                                {"k", stiffness_json(h.k)}};
  if (h.ball) out["ball"] = true;
  return out;
}

}  // namespace

nlohmann::ordered_json bodies_json(const model::Assembly& a) {
  auto bodies = nlohmann::ordered_json::array(), hinges = bodies, cells = bodies;
  for (const model::AssemblyBody& b : a.bodies)
    bodies.push_back({{"name", b.name}, {"position_mm", point_json(b.position)}});
  for (const model::AssemblyHinge& h : a.hinges) hinges.push_back(joint_json(h));
  return {{"cell_mm", a.edge_mm}, {"bodies", bodies}, {"hinges", hinges}, {"cells", cells}};
}

nlohmann::ordered_json stiffness_json(const model::HingeStiffness& k) {
  nlohmann::ordered_json out = {{"axial", k.axial}, {"shear", k.shear}, {"along", k.along}, {"turn", k.turn}};
  if (k.rock) out["rock"] = *k.rock;
  if (k.twist) out["twist"] = *k.twist;
  return out;
}

}  // namespace kinetix::app
