#include "targets/curve/read_curve.hpp"

#include <filesystem>

#include "targets/document/length_unit.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

using Axes = std::vector<std::string>;

// Range of every coordinate, mm: the limit of point_files.hpp on either side of 0.
const Bounds coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");
// Range of lengths over which points are averaged, mm.
const Bounds average_bounds = above(0, "mm");

/// "[x, z]".
std::string form_of(const Axes& axes) {
  std::string text;
  for (const std::string& axis : axes) text += (text.empty() ? "" : ", ") + axis;
  return "[" + text + "]";
}

/// "the path of a CSV, SVG, DXF, GPX or DAT file".
std::string files_of(const PointForm& form) {
  return std::string("the path of ") + point_files + (form.is_closed ? " or a picture" : "");
}

FilePoints read_inline(const Node& list, const PointForm& wanted) {
  const std::string form = form_of(wanted.axes);
  const auto nodes = list.list(files_of(wanted) + ", or a list of points [" + form + ", ...] in mm");
  if (nodes.size() > wanted.most)
    throw list.error("there are too many points. Give at most " + std::to_string(wanted.most));
  FilePoints out{{}, {}, list.place()};
  for (const Node& node : nodes) {
    Eigen::Vector3d& p = out.points.emplace_back(Eigen::Vector3d::Zero());
    int k = 0;
    for (const Node& number : node.list_of(wanted.axes.size(), "a point " + form + ", in mm"))
      p[k++] = number.number(coordinate);
    out.places.push_back(node.place());
  }
  return out;
}

FilePoints read_any_points(const Node& points, const PointForm& form) {
  if (points.kind() != Node::Kind::scalar) return read_inline(points, form);
  const std::string name = points.text(files_of(form));
  const std::string file = (std::filesystem::path(points.folder()) / name).string();
  const HiddenQuotes hidden(file, points.folder());
  try {
    return read_point_file(file, form);
  } catch (const InvalidInput& e) {
    const bool is_unreadable = e.place().line == 0;
    if (is_unreadable) throw points.error(e.what());
    throw;
  }
}

double largest_side(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return points.empty() ? 0 : box.sizes().maxCoeff();
}

[[noreturn]] void ask_for_pixel(double pixels, const Place& place) {
  throw InvalidInput("the shape in the picture is " + number_text(pixels) +
                         " pixels long, and the size of a pixel is " + "not known. " +
                         advise_unit(pixels, 120, 119, 121),
                     place);
}

/// Sets the points in mm and mends them. @param unit as the target gives it   @return advice on noise
std::string prepare(FilePoints& points, std::optional<double> unit, PointRequest request) {
  const double size = largest_side(points.points);
  if (points.in_pixels && !unit) ask_for_pixel(size, points.place);
  const double mm = unit.value_or(points.unit_mm.value_or(1));
  if (mm != 1)
    for (std::size_t k = 0; k < points.points.size(); ++k) {
      points.points[k] *= mm;
      if (points.points[k].cwiseAbs().maxCoeff() > max_coordinate_mm)
        throw InvalidInput("the point is more than a kilometre from 0. " + advise_unit(size, 200, 20, 2000),
                           points.places[k]);
    }
  request.checks_size = request.checks_size && !unit;
  mend_points(points, request, size);
  std::string advice = advise_on_noise(points.points);
  if (!advice.empty()) points.notes.push_back(advice);
  return advice;
}

PlanePoints in_plane(FilePoints read, std::string advice) {
  PlanePoints out{{}, std::move(read.places), read.place, std::move(read.notes), std::move(advice)};
  for (const Eigen::Vector3d& p : read.points) out.points.push_back(p.head<2>());
  return out;
}

/// Reads what the keys `units` and `smooth` of a target request.
FilePoints read_requested(const Section& target, std::string_view key, const GoalPoints& wanted,
                          std::string& advice) {
  const Node node = *target.optional(key);
  PointRequest request{.is_closed = wanted.form.is_closed, .checks_size = wanted.checks_size};
  if (const auto smooth = target.optional("smooth")) {
    const std::string text = smooth->text("true, or a length in mm");
    request.smooth = true;
    if (text == "true" || text == "false")
      request.smooth = smooth->boolean();
    else
      request.average_mm = smooth->number(average_bounds);
  }
  FilePoints read = read_any_points(node, wanted.form);
  try {
    advice = prepare(read, read_unit(target, "units"), request);
  } catch (const InvalidInput& e) {
    const bool is_in_document = e.place().file.empty() || e.place().line == 0;
    if (is_in_document) throw node.error(e.reason());
    throw;
  }
  return read;
}

ValueType type_of(const PointForm& wanted) {
  const std::string form = form_of(wanted.axes);
  const std::size_t count = wanted.axes.size();
  return value::either({value::text(files_of(wanted)),
                        value::list(value::list(value::number(coordinate), "`" + form + "`", count, count),
                                    "a list of points `[" + form + ", ...]`", 1, wanted.most)});
}

const Axes space = {"x", "y", "z"};

}  // namespace

ValueType points_type(const std::string& second_axis, bool is_closed) {
  return type_of({{"x", second_axis}, max_curve_points, is_closed});
}

ValueType space_points_type(std::size_t most) { return type_of({space, most}); }

std::vector<Key> point_keys() {
  return {
      {"units", unit_type(), otherwise("the unit that the file names, or mm"),
       "unit of the points, or the mm in one unit of them: a pixel of a picture, the chord of an airfoil, a "
       "metre of "
       "a GPX track. Without it, points that span less than 2 mm or more than 10 m are refused"},
      {"smooth", value::either({value::boolean(), value::number(average_bounds)}), by_default("false"),
       "`true`: a smooth curve goes through the points. A length in mm: points are averaged over it along "
       "the line "
       "before"},
  };
}

PlanePoints read_points_csv(const std::string& file, const std::string& second_axis) {
  FilePoints read = read_point_file(file, {{"x", second_axis}});
  std::string advice = prepare(read, {}, {});
  return in_plane(std::move(read), std::move(advice));
}

PlanePoints read_points(const Node& points, const std::string& second_axis) {
  FilePoints read = read_any_points(points, {{"x", second_axis}});
  std::string advice = prepare(read, {}, {});
  return in_plane(std::move(read), std::move(advice));
}

PlanePoints read_points(const Section& target, std::string_view key, const GoalPoints& wanted) {
  std::string advice;
  FilePoints read = read_requested(target, key, wanted, advice);
  return in_plane(std::move(read), std::move(advice));
}

SpacePoints read_space_points(const Section& target, std::string_view key, const GoalPoints& wanted) {
  std::string advice;
  FilePoints read = read_requested(target, key, wanted, advice);
  return {std::move(read.points), std::move(read.places), read.place, std::move(read.notes),
          std::move(advice)};
}

namespace {

const std::string second_axis = "z";

Curve make_curve(std::vector<Eigen::Vector2d> points) { return Curve(std::move(points)); }

}  // namespace

const KeyTable& curve_target_keys() {
  static const KeyTable keys({
      goal_kind_key("curve"),
      {"points", points_type(second_axis), needed,
       "goal curve, in mm: open, not crossing itself. A table has one point per row, and may start with the "
       "header "
       "`x,z`. A drawing has one path"},
      point_keys()[0],
      point_keys()[1],
  });
  return keys;
}

Curve read_curve_csv(const std::string& file) {
  return make_from_points(read_points_csv(file, second_axis), make_curve);
}

Curve read_curve(const Section& target, bool checks_size, std::vector<std::string>& notes) {
  PlanePoints read = read_points(target, "points", {{{"x", second_axis}}, checks_size});
  notes.insert(notes.end(), read.notes.begin(), read.notes.end());
  return make_from_points(std::move(read), make_curve);
}

Curve read_curve(const Node& points) {
  return make_from_points(read_points(points, second_axis), make_curve);
}

}  // namespace kinetix::targets
