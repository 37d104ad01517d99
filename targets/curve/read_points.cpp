#include "targets/curve/read_points.hpp"

#include <cctype>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

// Of every coordinate, mm: the limit of read_curve.hpp on either side of 0.
const Bounds coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");
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
  CsvReader(const std::string& file, const std::string& second_axis)
      : file_(file), second_(second_axis), text_(read_text_file(file, max_csv_bytes)) {}

  PlanePoints read() {
    while (next_line()) {
      if (!has_header_)
        read_header();
      else
        read_point();
    }
    if (!has_header_) throw InvalidInput("holds no points; " + wanted_header(), {file_});
    PlanePoints out{std::move(points_), {}, {file_}};
    for (const int line : line_of_point_) out.places.push_back({file_, line, 1});
    return out;
  }

 private:
  /// The end of messages about the first line: what would be right.
  std::string wanted_header() const {
    return "the first line must be the header `x," + second_ + "`, with points in millimetres";
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
    if (has_digits) refuse(0, "the header is missing; " + wanted_header());
    if (fields.size() != 2)
      refuse(0, in_ticks(line_) + " is not the header of two columns; " + wanted_header());
    for (int k = 0; k < 2; ++k) check_title(fields[k], k == 0 ? "x" : second_);
  }

  void check_title(const Field& field, const std::string& wanted) const {
    const Title title = title_of(field.text);
    if (title.axis != wanted)
      refuse(field.position,
             in_ticks(field.text) + " stands where `" + wanted + "` belongs; " + wanted_header());
    if (!title.unit.empty() && title.unit != "mm")
      refuse(field.position, in_ticks(field.text) +
                                 " names another unit, but points are in millimetres; convert "
                                 "the numbers and write the header `x," +
                                 second_ + "`");
  }

  void read_point() {
    const auto fields = fields_of(line_);
    if (fields.size() != 2) refuse_columns(fields.size());
    if (points_.size() == max_curve_points)
      refuse(0, "too many points; at most " + std::to_string(max_curve_points) + " are allowed");
    points_.emplace_back(number(fields[0]), number(fields[1]));
    line_of_point_.push_back(number_);
  }

  [[noreturn]] void refuse_columns(std::size_t count) const {
    const bool has_semicolon = line_.find(';') != std::string_view::npos;
    const char* hint = has_semicolon ? "; separate the columns by a comma, not by `;`"
                       : count > 2   ? "; write decimals with a point, not a comma"
                                     : "";
    refuse(0, in_ticks(line_) + " has " + std::to_string(count) + (count == 1 ? " column" : " columns") +
                  "; give two, x and " + second_ + " in millimetres" + hint);
  }

  double number(const Field& field) const {
    try {
      return parse_number(field.text, coordinate);
    } catch (const InvalidInput& e) {
      refuse(field.position, e.reason());
    }
  }

  const std::string& file_;
  const std::string second_;  ///< name of the second axis
  const std::string text_;
  std::size_t next_ = 0, start_ = 0;
  std::string_view line_;
  int number_ = 0;
  bool has_header_ = false;
  std::vector<Vector2d> points_;
  std::vector<int> line_of_point_;
};

PlanePoints read_inline(const Node& list, const std::string& form) {
  const auto nodes = list.list("the path of a CSV file or a list of points [" + form + ", ...] in mm");
  if (nodes.size() > max_curve_points)
    throw list.error("too many points; at most " + std::to_string(max_curve_points) + " are allowed");
  PlanePoints out{{}, {}, list.place()};
  for (const Node& node : nodes) {
    const auto xy = node.list_of(2, "a point " + form + ", in mm");
    out.points.emplace_back(xy[0].number(coordinate), xy[1].number(coordinate));
    out.places.push_back(node.place());
  }
  return out;
}

}  // namespace

ValueType points_type(const std::string& second_axis) {
  const std::string form = "[x, " + second_axis + "]";
  return value::either({value::text("path of a CSV file"),
                        value::list(value::list(value::number(coordinate), "`" + form + "`", 2, 2),
                                    "a list of points `[" + form + ", ...]`", 1, max_curve_points)});
}

PlanePoints read_points_csv(const std::string& file, const std::string& second_axis) {
  return CsvReader(file, second_axis).read();
}

PlanePoints read_points(const Node& points, const std::string& second_axis) {
  if (points.kind() != Node::Kind::scalar) return read_inline(points, "[x, " + second_axis + "]");
  const std::string name = points.text("the path of a CSV file");
  const std::string file = (std::filesystem::path(points.folder()) / name).string();
  try {
    return read_points_csv(file, second_axis);
  } catch (const InvalidInput& e) {
    const bool is_unreadable = e.place().line == 0;
    if (is_unreadable) throw points.error(e.what());
    throw;
  }
}

}  // namespace kinetix::targets
