#include "targets/surface/ribbed_surface.hpp"

#include "model/base/geometry.hpp"
#include "targets/curve/read_curve.hpp"
#include "targets/document/length_unit.hpp"
#include "targets/document/wording.hpp"
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
constexpr double usual_side = 200;                       // mm: the unit that comes nearest to it is suggested
constexpr double whole_turn = 360 * radians_per_degree;  // rad: ribs go all round a profile
const char* const height_axis = "z";                     // of points of a profile, behind x, the radius

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

TriangleMesh read_mesh_in_mm(const Section& target, const Node& node, const MeshReader& read) {
  const std::optional<double> unit = read_unit(target, "units");
  const FileMesh file = read_mesh_at(node, read);
  TriangleMesh mesh = wound_alike(file.mesh);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= unit.value_or(file.unit_mm.value_or(1));
  return mesh;
}

SurfacePatch read_mesh_surface(const Section& target, const Node& node, const MeshReader& read) {
  const TriangleMesh mesh = read_mesh_in_mm(target, node, read);
  try {
    return mesh_patch(mesh);
  } catch (const InvalidInput& e) {
    throw node.error(std::string(e.what()) + ". For any mesh give `target.ribs`");
  }
}

RibbedSurface ribbed_mesh(const TriangleMesh& mesh) {
  const double side = bounds(mesh).sizes().maxCoeff();
  if (!(side >= min_side && side <= most_side))
    throw InvalidInput("the mesh is " + number_text(side) + " mm large, and 20 mm to 5 m are allowed. " +
                       advise_unit(side, usual_side, min_side, most_side));
  return ribbed_surface(mesh);
}

void refuse_sizes(const Section& target) {
  refuse(target, {"width_mm", "arc_deg", "rise", "height_mm", "radius_mm", "swell_mm"},
         "only applies to a shape, and a mesh has a size. Remove the key");
}

const std::initializer_list<const char*> sizes_but_arc = {"width_mm", "rise", "height_mm", "radius_mm",
                                                          "swell_mm"};

/// Profile of a surface of revolution, and its arc in rad.
struct Turned {
  Profile profile;
  double arc;
};
Turned read_turned(const Section& target, const Node& node, double usual) {
  refuse(target, sizes_but_arc, "only applies to a shape, and a profile has a size. Remove the key");
  refuse(target, {"units"}, "only applies to a mesh, and a profile is in mm. Remove the key");
  double arc = usual;
  target.read("arc_deg", arc);
  const auto make = [](std::vector<Eigen::Vector2d> points) { return Profile(std::move(points)); };
  return {make_from_points(read_points(node, height_axis), make), arc};
}

SurfacePatch read_shape(const Section& target, Shape shape) {
  Sizes of;
  target.read_into(of);
  if (shape != Shape::vase)
    refuse(target, {"radius_mm", "height_mm", "swell_mm"}, "only applies to a vase. Remove the key");
  if (shape == Shape::vase)
    refuse(target, {"width_mm"},
           "does not apply to a vase, which has height_mm and radius_mm. Remove the key");
  if (shape != Shape::saddle) refuse(target, {"rise"}, "only applies to a saddle. Remove the key");
  if (shape == Shape::saddle)
    refuse(target, {"arc_deg"}, "does not apply to a saddle, which has a rise. Remove the key");
  if (shape == Shape::cap) return cap_patch(of.width, of.arc);
  if (shape == Shape::saddle) return saddle_patch(of.width, of.rise);
  return vase_patch(of.height, of.radius, of.swell.value_or(of.radius / 5), of.arc);
}

}  // namespace

std::vector<Key> surface_keys() {
  return {
      {"mesh", value::text(std::string("path of a mesh: ") + mesh_formats), otherwise("`shape` is given"),
       "mesh of the surface. A sheet needs an open surface without holes, and covers its rectangle or a "
       "rectangle of its area. Ribs cover any surface"},
      {"units", unit_type(), otherwise("the unit that the file names, or mm"),
       "unit of the mesh, or the mm in one unit of it"},
      {"shape", value::choice(shapes), otherwise("`mesh` is given"),
       "`cap`: part of a sphere over the square in its rim. `saddle`: z = rise (x\u00b2 \u2212 y\u00b2) / "
       "half of the width. `vase`: the front of a vase, with belly and neck"},
      {"profile", points_type(height_axis), otherwise("`mesh` or `shape` is given"),
       "surface of revolution: points `[x, z]` with the radius x and the height z on the axis, ascending. A "
       "smooth line goes through them"},
      {"width_mm", &Sizes::width, value::number(size), "width of the square of a cap or saddle"},
      {"arc_deg", &Sizes::arc, value::angle(arc_turn),
       "for a cap: angle of its surface from corner to corner. For a vase: angle about its axis from edge to "
       "edge, at most 120. For a `profile` the same, and up to 360, the default, with `ribs`"},
      {"rise", &Sizes::rise, value::number({0, 1, false, true}),
       "for a saddle: height in the middle of a side, relative to half its width"},
      {"height_mm", &Sizes::height, value::number(size), "height of a vase along its axis"},
      {"radius_mm", &Sizes::radius, value::number(size), "radius of a vase in the middle of its height"},
      {"swell_mm", &Sizes::swell, value::number(from_to(0, 2500, "mm")), otherwise("a fifth of `radius_mm`"),
       "for a vase: radius of the belly minus that of the middle, and of the middle minus that of the neck. "
       "At most half the radius. The neck must be as wide as the front, which is `arc_deg` of the middle"},
  };
}

SurfacePatch read_surface(const Section& target, const MeshReader& read) {
  const auto mesh = target.optional("mesh"), shape = target.optional("shape"),
             profile = target.optional("profile");
  if (mesh && shape)
    throw shape->key_error(
        "cannot be combined with target.mesh, which also sets the surface. Remove one of the two keys");
  if (profile && (mesh || shape))
    throw profile->key_error(
        "cannot be combined with a mesh or shape, which also sets the surface. Remove one of the two keys");
  if (!mesh && !shape && !profile)
    throw target.error("needs a `mesh` or a `shape`: cap, saddle or vase, or a `profile`");
  if (profile) {
    const Turned turned = read_turned(target, *profile, Sizes{}.arc);
    return profile->located([&] { return revolution_patch(turned.profile, turned.arc); });
  }
  if (mesh) {
    refuse_sizes(target);
    return read_mesh_surface(target, *mesh, read);
  }
  refuse(target, {"units"}, "only applies to a mesh, and shapes are in mm. Remove the key");
  return shape->located([&] { return read_shape(target, read_word(*shape, shapes)); });
}

std::string surface_name(const Section& target) {
  const auto shape = target.optional("shape");
  if (shape) return shape->text("the name of a shape");
  return target.optional("profile") ? "profile" : "mesh";
}

RibbedSurface read_ribbed_surface(const Section& target, const MeshReader& read_file) {
  const auto mesh = target.optional("mesh"), profile = target.optional("profile");
  if (profile && !mesh && !target.optional("shape")) {
    const Turned turned = read_turned(target, *profile, whole_turn);
    return profile->located([&] { return ribbed_revolution(turned.profile, turned.arc); });
  }
  if (!mesh || profile || target.optional("shape")) return ribbed_surface(read_surface(target, read_file));
  refuse_sizes(target);
  const TriangleMesh read = read_mesh_in_mm(target, *mesh, read_file);
  return mesh->located([&] { return ribbed_mesh(read); });
}

}  // namespace kinetix::targets
