#include "targets/curve/read_curve.hpp"

#include <cctype>
#include <filesystem>

#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

using Axes = std::vector<std::string>;

// Range of every coordinate, mm: the limit of read_points.hpp on either side of 0.
const Bounds coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");

/// Points of as many numbers as there are axes.
struct Rows {
  std::vector<std::vector<double>> points;
  std::vector<Place> places;
  Place place;
};

/// Names with ", " or "," between them.
std::string joined_axes(const Axes& axes, const std::string& between) {
  std::string text;
  for (const std::string& axis : axes) text += (text.empty() ? "" : between) + axis;
  return text;
}

/// "x and z", "x, y and z".
std::string describe(const Axes& axes) {
  return joined_axes({axes.begin(), axes.end() - 1}, ", ") + " and " + axes.back();
}

std::string spell_count(const Axes& axes) { return axes.size() == 2 ? "two" : "three"; }

/// "[x, z]".
std::string form_of(const Axes& axes) { return "[" + joined_axes(axes, ", ") + "]"; }

struct Field {
  std::string_view text;
  std::size_t position;  ///< in the line
};

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    const std::size_t first = std::min(line.find_first_not_of(" \t", start), end);
    const std::size_t last = line.find_last_not_of(" \t", end - 1);
    const std::size_t length = first == end ? 0 : last + 1 - first;
    fields.push_back({line.substr(first, length), first});
    start = end + 1;
  }
  return fields;
}

/// "x_mm", "x [mm]" and "X(mm)" name the axis x in the unit mm.
struct Title {
  std::string axis, unit;
};

Title title_of(std::string_view text) {
  Title title;
  bool is_unit = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    is_unit = is_unit || !std::isalnum(byte);
    if (std::isalnum(byte)) (is_unit ? title.unit : title.axis) += static_cast<char>(std::tolower(byte));
  }
  return title;
}

class CsvReader {
 public:
  CsvReader(const std::string& file, const Axes& axes, std::size_t most)
      : file_(file), axes_(axes), most_(most), text_(read_text_file(file, max_csv_bytes)) {}

  Rows read() {
    while (next_line()) {
      if (!has_header_)
        read_header();
      else
        read_point();
    }
    if (!has_header_) throw InvalidInput("the file has no points. " + wanted_header(), {file_});
    Rows out{std::move(points_), {}, {file_}};
    for (const int line : line_of_point_) out.places.push_back({file_, line, 1});
    return out;
  }

 private:
  /// The end of messages about the first line: what would be right.
  std::string wanted_header() const {
    return "Write the header `" + joined_axes(axes_, ",") + "` as the first line, with points in millimetres";
  }

  /// Moves to the next line that is neither empty nor a comment.
  bool next_line() {
    while (next_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', next_), text_.size());
      line_ = std::string_view(text_).substr(next_, end - next_);
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      start_ = std::exchange(next_, end + 1);
      ++number_;
      const std::size_t first = line_.find_first_not_of(" \t");
      if (first != std::string_view::npos && line_[first] != '#') return true;
    }
    return false;
  }

  [[noreturn]] void refuse(std::size_t position, const std::string& reason) const {
    throw InvalidInput(reason, {file_, number_, 1 + characters(text_, start_, start_ + position)});
  }

  void read_header() {
    has_header_ = true;
    const auto fields = fields_of(line_);
    const bool has_digits = line_.find_first_not_of("+-.,;0123456789eE \t") == std::string_view::npos;
    if (has_digits) refuse(0, "the header is missing. " + wanted_header());
    if (fields.size() != axes_.size())
      refuse(0,
             in_ticks(line_) + " is not a header of " + spell_count(axes_) + " columns. " + wanted_header());
    for (std::size_t k = 0; k < fields.size(); ++k) check_title(fields[k], axes_[k]);
  }

  void check_title(const Field& field, const std::string& wanted) const {
    const Title title = title_of(field.text);
    if (title.axis != wanted)
      refuse(field.position, in_ticks(field.text) + " is not the name `" + wanted +
                                 "` that is expected here. " + wanted_header());
    if (!title.unit.empty() && title.unit != "mm")
      refuse(
          field.position,
          in_ticks(field.text) +
              " has another unit, and points are in millimetres. Convert the numbers and write the header `" +
              joined_axes(axes_, ",") + "`");
  }

  void read_point() {
    const auto fields = fields_of(line_);
    if (fields.size() != axes_.size()) refuse_columns(fields.size());
    if (points_.size() == most_)
      refuse(0, "there are too many points. Give at most " + std::to_string(most_));
    points_.emplace_back();
    for (const Field& field : fields) points_.back().push_back(number(field));
    line_of_point_.push_back(number_);
  }

  [[noreturn]] void refuse_columns(std::size_t count) const {
    const bool has_semicolon = line_.find(';') != std::string_view::npos;
    const char* hint = has_semicolon          ? ". Separate the columns by a comma, not by `;`"
                       : count > axes_.size() ? ". Write decimals with a point, not a comma"
                                              : "";
    refuse(0, in_ticks(line_) + " has " + std::to_string(count) + (count == 1 ? " column" : " columns") +
                  ". Give " + spell_count(axes_) + ", " + describe(axes_) + " in millimetres" + hint);
  }

  double number(const Field& field) const {
    try {
      return parse_number(field.text, coordinate);
    } catch (const InvalidInput& e) {
      refuse(field.position, e.reason());
    }
  }

  const std::string& file_;
  const Axes axes_;
  const std::size_t most_;
  const std::string text_;
  std::size_t next_ = 0, start_ = 0;
  std::string_view line_;
  int number_ = 0;
  bool has_header_ = false;
  std::vector<std::vector<double>> points_;
  std::vector<int> line_of_point_;
};

Rows read_inline(const Node& list, const Axes& axes, std::size_t most) {
  const std::string form = form_of(axes);
  const auto nodes = list.list("the path of a CSV file or a list of points [" + form + ", ...] in mm");
  if (nodes.size() > most)
    throw list.error("there are too many points. Give at most " + std::to_string(most));
  Rows out{{}, {}, list.place()};
  for (const Node& node : nodes) {
    out.points.emplace_back();
    for (const Node& number : node.list_of(axes.size(), "a point " + form + ", in mm"))
      out.points.back().push_back(number.number(coordinate));
    out.places.push_back(node.place());
  }
  return out;
}

Rows read_rows(const Node& points, const Axes& axes, std::size_t most) {
  if (points.kind() != Node::Kind::scalar) return read_inline(points, axes, most);
  const std::string name = points.text("the path of a CSV file");
  const std::string file = (std::filesystem::path(points.folder()) / name).string();
  const HiddenQuotes hidden(file, points.folder());
  try {
    return CsvReader(file, axes, most).read();
  } catch (const InvalidInput& e) {
    const bool is_unreadable = e.place().line == 0;
    if (is_unreadable) throw points.error(e.what());
    throw;
  }
}

ValueType type_of(const Axes& axes, std::size_t most) {
  const std::string form = form_of(axes);
  const std::size_t count = axes.size();
  return value::either({value::text("path of a CSV file"),
                        value::list(value::list(value::number(coordinate), "`" + form + "`", count, count),
                                    "a list of points `[" + form + ", ...]`", 1, most)});
}

PlanePoints in_plane(Rows rows) {
  PlanePoints out{{}, std::move(rows.places), rows.place};
  for (const auto& p : rows.points) out.points.emplace_back(p[0], p[1]);
  return out;
}

const Axes space = {"x", "y", "z"};

}  // namespace

ValueType points_type(const std::string& second_axis) {
  return type_of({"x", second_axis}, max_curve_points);
}

ValueType space_points_type(std::size_t most) { return type_of(space, most); }

PlanePoints read_points_csv(const std::string& file, const std::string& second_axis) {
  return in_plane(CsvReader(file, {"x", second_axis}, max_curve_points).read());
}

PlanePoints read_points(const Node& points, const std::string& second_axis) {
  return in_plane(read_rows(points, {"x", second_axis}, max_curve_points));
}

SpacePoints read_space_points(const Node& points, std::size_t most) {
  Rows rows = read_rows(points, space, most);
  SpacePoints out{{}, std::move(rows.places), rows.place};
  for (const auto& p : rows.points) out.points.emplace_back(p[0], p[1], p[2]);
  return out;
}

namespace {

const std::string second_axis = "z";

Curve make_curve(std::vector<Eigen::Vector2d> points) { return Curve(std::move(points)); }

}  // namespace

const KeyTable& curve_target_keys() {
  static const KeyTable keys({
      goal_kind_key("curve"),
      {"points", points_type(second_axis), needed,
       "goal curve, in mm: open, not crossing itself. The CSV file has the header `x,z`, then one point per "
       "row"},
  });
  return keys;
}

Curve read_curve_csv(const std::string& file) {
  return make_from_points(read_points_csv(file, second_axis), make_curve);
}

Curve read_curve(const Node& points) {
  return make_from_points(read_points(points, second_axis), make_curve);
}

}  // namespace kinetix::targets
