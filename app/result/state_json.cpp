#include "app/result/state_json.hpp"

#include <bit>

#include "app/io/bytes.hpp"

#include "app/result/result_json.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const model::Pose& pose) {
  const Eigen::Quaterniond q(pose.R);
  return {{"position_mm", {pose.p.x(), pose.p.y(), pose.p.z()}},
          {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}}};
}

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

/// Returns the kind of a hinge, such as block, pin or ball. A pin without a rod is a "hinge".
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

bool is_near(const Json& a, const Json& b, double rounding) {
  if (a.is_number() && b.is_number()) {
    const double x = a, y = b;
    return std::abs(x - y) <= rounding * std::max(1.0, std::abs(x));
  }
  if (a.is_structured() && a.type() == b.type() && a.size() == b.size())
    return std::equal(a.begin(), a.end(), b.begin(),
                      [&](const Json& p, const Json& q) { return is_near(p, q, rounding); });
  return a == b;
}

/// Removes reach_mm from hinges for a comparison, because reports omit it.
Json compared(Json part) {
  for (Json& entry : part)
    if (entry.is_object()) entry.erase("reach_mm");
  return part;
}

}  // namespace

Json poses_json(const model::State& state) {
  Json poses = Json::array();
  for (const model::Pose& pose : state) poses.push_back(pose_json(pose));
  return poses;
}

Json points_json(const std::vector<Eigen::Vector2d>& points) {
  Json out = Json::array();
  for (const auto& p : points) out.push_back({p.x(), p.y()});
  return out;
}

nlohmann::ordered_json point_json(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

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

Json sheet_json(const Design& design) {
  const double edge = design.structure.size().edge_mm;
  return structure_json(design, design.hinge.reach_mm.value_or(sim::PhysicsOptions{}.reach * edge));
}

bool matches_sheet(const Json& result, const Design& design, double rounding) {
  if (!result.is_object() || !result.contains("structure")) return false;
  const Json &known = result["structure"], sheet = sheet_json(design);
  const auto is_kept = [&](const char* part) {
    return known.is_object() && known.contains(part) &&
           is_near(compared(known[part]), compared(sheet[part]), rounding);
  };
  return is_kept("cell_mm") && is_kept("wall_mm") && is_kept("bodies") && is_kept("hinges");
}

}  // namespace kinetix::app
