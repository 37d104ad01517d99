#include "targets/surface/ribbed_surface.hpp"

#include <filesystem>

#include "model/base/geometry.hpp"
#include "targets/curve/read_curve.hpp"
#include "targets/document/wording.hpp"
#include "targets/helmet/head_pose.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/surface/revolution.hpp"

namespace kinetix::targets {
namespace {

enum class Shape { cap, saddle, vase };
// Words of the key `shape`.
constexpr Word<Shape> shapes[] = {{"cap", Shape::cap}, {"saddle", Shape::saddle}, {"vase", Shape::vase}};
const Bounds arc_turn = {0, 360, false, true, "degrees"};  // of arcs: shapes allow less
const Bounds size = from_to(1, 5000, "mm");                // of surfaces: a fingertip to a room
constexpr double min_side = 20, most_side = 5000;          // mm, of the box of a mesh that ribs go over
constexpr double whole_turn = 360 * radians_per_degree;    // rad: ribs go all round a profile
const char* const height_axis = "z";                       // of points of a profile, behind x, the radius

/// Sizes of shapes, as requested or by default.
struct Sizes {
  double width = 100;                    ///< mm: a sheet of it prints on any machine
  double radius = 50;                    ///< mm, of vases: a drinking glass
  double height = 120;                   ///< mm, of vases
  double arc = 60 * radians_per_degree;  ///< rad: as much as eight facets follow well
  /// Rise of a saddle over half its width: its edges are 17 deg steep. Eight facets stay within 1.5 % of it, but not
  /// of a saddle of 0.3.
  double rise = 0.15;
  std::optional<double> swell = {};  ///< mm, of vases: a fifth of the radius
};

void refuse(const Section& target, std::initializer_list<const char*> keys, const std::string& why) {
  for (const char* key : keys)
    if (const auto node = target.optional(key)) throw node->key_error(why);
}

TriangleMesh in_mm(TriangleMesh mesh, LengthUnit unit) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= mm_per(unit);
  return mesh;
}

TriangleMesh read_mesh_in_mm(const Section& target, const Node& mesh) {
  LengthUnit unit = LengthUnit::mm;
  target.read("units", unit, length_units);
  const std::string name = mesh.text("the path of an OBJ, STL or PLY file");
  const std::string file = (std::filesystem::path(mesh.folder()) / name).string();
  const HiddenQuotes hidden(file, mesh.folder());
  return mesh.located([&] { return in_mm(read_mesh(file), unit); });
}

SurfacePatch read_mesh_surface(const Section& target, const Node& node) {
  const TriangleMesh mesh = read_mesh_in_mm(target, node);
  try {
    return mesh_patch(mesh);
  } catch (const InvalidInput& e) {
    throw node.error(std::string(e.what()) + "; or give `target.ribs`, which go over any mesh");
  }
}

RibbedSurface ribbed_mesh(const TriangleMesh& mesh) {
  const double side = bounds(mesh).sizes().maxCoeff();
  if (!(side >= min_side && side <= most_side))
    throw InvalidInput("the mesh is " + number_text(side) +
                       " mm large; allowed: from 20 mm to 5 m; `units` says what its numbers are");
  return ribbed_surface(mesh);
}

void refuse_sizes(const Section& target) {
  refuse(target, {"width_mm", "arc_deg", "rise", "height_mm", "radius_mm", "swell_mm"},
         "belongs to a shape; a mesh has its own size, leave it out");
}

const std::initializer_list<const char*> sizes_but_arc = {"width_mm", "rise", "height_mm", "radius_mm",
                                                          "swell_mm"};

/// Profile of a surface of revolution, and its arc in rad.
struct Turned {
  Profile profile;
  double arc;
};
Turned read_turned(const Section& target, const Node& node, double usual) {
  refuse(target, sizes_but_arc, "belongs to a shape; a profile has its own size, leave it out");
  refuse(target, {"units"}, "belongs to a mesh; a profile is in mm, leave it out");
  double arc = usual;
  target.read("arc_deg", arc);
  const auto make = [](std::vector<Eigen::Vector2d> points) { return Profile(std::move(points)); };
  return {make_from_points(read_points(node, height_axis), make), arc};
}

SurfacePatch read_shape(const Section& target, Shape shape) {
  Sizes of;
  target.read_into(of);
  if (shape != Shape::vase)
    refuse(target, {"radius_mm", "height_mm", "swell_mm"}, "belongs to a vase. Leave it out");
  if (shape == Shape::vase) refuse(target, {"width_mm"}, "a vase has height_mm and radius_mm. Leave it out");
  if (shape != Shape::saddle) refuse(target, {"rise"}, "belongs to a saddle. Leave it out");
  if (shape == Shape::saddle) refuse(target, {"arc_deg"}, "a saddle has a rise. Leave it out");
  if (shape == Shape::cap) return cap_patch(of.width, of.arc);
  if (shape == Shape::saddle) return saddle_patch(of.width, of.rise);
  return vase_patch(of.height, of.radius, of.swell.value_or(of.radius / 5), of.arc);
}

}  // namespace

std::vector<Key> surface_keys() {
  return {
      {"mesh", value::text("path of an OBJ, STL or PLY file"), otherwise("`shape` is given"),
       "the surface: for a sheet an open one without holes, of which it covers the rectangle in which it "
       "lies, or one "
       "of its area; for ribs any"},
      {"units", value::choice(length_units), by_default("mm"), "of the mesh"},
      {"shape", value::choice(shapes), otherwise("`mesh` is given"),
       "`cap`: of a sphere, over the square in its rim; `saddle`: z = rise (x\u00b2 \u2212 y\u00b2) / half "
       "of the width; "
       "`vase`: the front of one, with belly and neck"},
      {"profile", points_type(height_axis), otherwise("`mesh` or `shape` is given"),
       "a surface of revolution: points `[x, z]`, x the radius, z the height on the axis, ascending; a "
       "smooth line goes "
       "through them"},
      {"width_mm", &Sizes::width, value::number(size), "of the square of a cap or saddle"},
      {"arc_deg", &Sizes::arc, value::angle(arc_turn),
       "of a cap: what its surface turns by from corner to corner; of a vase: from rim to rim round its "
       "axis, at most 120; of a `profile` likewise, with `ribs` up to 360, which is then the default"},
      {"rise", &Sizes::rise, value::number({0, 1, false, true}),
       "of a saddle: its height in the middle of a side, over half of its width"},
      {"height_mm", &Sizes::height, value::number(size), "of a vase, along its axis"},
      {"radius_mm", &Sizes::radius, value::number(size), "of a vase, in the middle of its height"},
      {"swell_mm", &Sizes::swell, value::number(from_to(0, 2500, "mm")), otherwise("a fifth of `radius_mm`"),
       "of a vase: how much its belly is wider than its middle, and its neck narrower; at most half the "
       "radius, and so that the front, as wide as `arc_deg` of the middle, keeps within the neck"},
  };
}

SurfacePatch read_surface(const Section& target) {
  const auto mesh = target.optional("mesh"), shape = target.optional("shape"),
             profile = target.optional("profile");
  if (mesh && shape) throw shape->key_error("and target.mesh both say what the surface is. Give one of them");
  if (profile && (mesh || shape))
    throw profile->key_error("and a mesh or shape both say what the surface is. Give one of them");
  if (!mesh && !shape && !profile)
    throw target.error("needs a `mesh` or a `shape`: cap, saddle or vase, or a `profile`");
  if (profile) {
    const Turned turned = read_turned(target, *profile, Sizes{}.arc);
    return profile->located([&] { return revolution_patch(turned.profile, turned.arc); });
  }
  if (mesh) {
    refuse_sizes(target);
    return read_mesh_surface(target, *mesh);
  }
  refuse(target, {"units"}, "belongs to a mesh; shapes are in mm, leave it out");
  return shape->located([&] { return read_shape(target, read_word(*shape, shapes)); });
}

std::string surface_name(const Section& target) {
  const auto shape = target.optional("shape");
  if (shape) return shape->text("the name of a shape");
  return target.optional("profile") ? "profile" : "mesh";
}

RibbedSurface read_ribbed_surface(const Section& target) {
  const auto mesh = target.optional("mesh"), profile = target.optional("profile");
  if (profile && !mesh && !target.optional("shape")) {
    const Turned turned = read_turned(target, *profile, whole_turn);
    return profile->located([&] { return ribbed_revolution(turned.profile, turned.arc); });
  }
  if (!mesh || profile || target.optional("shape")) return ribbed_surface(read_surface(target));
  refuse_sizes(target);
  const TriangleMesh read = read_mesh_in_mm(target, *mesh);
  return mesh->located([&] { return ribbed_mesh(read); });
}

}  // namespace kinetix::targets
