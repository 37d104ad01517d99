#include "app/result/bodies_json.hpp"

#include <bit>
#include <nlohmann/json.hpp>

#include "app/io/base64.hpp"
#include "app/result/state_json.hpp"

namespace kinetix::app {
namespace {

template <class Number>
void add_bytes(std::string& out, Number value) {
  static_assert(std::endian::native == std::endian::little, "meshes are little-endian");
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

nlohmann::ordered_json mesh_json(const model::Polyhedron& solid) {
  std::string points, triangles;
  for (const Eigen::Vector3d& p : solid.points)
    for (const double v : {p.x(), p.y(), p.z()}) add_bytes(points, static_cast<float>(v));
  for (const auto& triangle : solid.triangles)
    for (const int corner : triangle) add_bytes(triangles, static_cast<std::uint32_t>(corner));
  return {{"points", to_base64(points)}, {"triangles", to_base64(triangles)}};
}

/// Block, pin or ball; a hinge where there is no rod.
std::string kind_of(const model::AssemblyHinge& hinge) {
  if (hinge.ball) return "ball";
  return hinge.kind == model::HingeKind::pin && hinge.rod_mm == 0 ? "hinge" : to_string(hinge.kind);
}

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

nlohmann::ordered_json shown_bodies_json(const model::Assembly& assembly) {
  nlohmann::ordered_json out = bodies_json(assembly);
  for (std::size_t h = 0; h < assembly.hinges.size(); ++h) {
    const model::AssemblyHinge& hinge = assembly.hinges[h];
    nlohmann::ordered_json& one = out["hinges"][h];
    one["kind"] = kind_of(hinge);
    one["along"] = {hinge.along.x(), hinge.along.y(), hinge.along.z()};
    one["confidence"] = hinge.confidence;
    if (hinge.rod_mm > 0) one["diameter_mm"] = hinge.rod_mm;
    if (hinge.rod_mm > 0) one["clearance_mm"] = hinge.clearance_mm;
  }
  return out;
}

nlohmann::ordered_json meshes_json(const model::Assembly& assembly) {
  auto bodies = nlohmann::ordered_json::array(), hinges = bodies;
  for (const model::AssemblyBody& body : assembly.bodies) bodies.push_back(mesh_json(body.solid));
  for (const model::AssemblyHinge& hinge : assembly.hinges)
    hinges.push_back(hinge.soft.points.empty() ? nlohmann::ordered_json(nullptr) : mesh_json(hinge.soft));
  return {{"bodies", bodies}, {"hinges", hinges}};
}

nlohmann::ordered_json stiffness_json(const model::HingeStiffness& k) {
  nlohmann::ordered_json out = {{"axial", k.axial}, {"shear", k.shear}, {"along", k.along}, {"turn", k.turn}};
  if (k.rock) out["rock"] = *k.rock;
  if (k.twist) out["twist"] = *k.twist;
  return out;
}

}  // namespace kinetix::app
