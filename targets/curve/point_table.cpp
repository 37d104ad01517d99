#include <cctype>
#include <cmath>
#include <filesystem>

#include "targets/curve/point_files.hpp"
#include "targets/document/length_unit.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

// Range of every coordinate: the limit of point_files.hpp on either side of 0.
const Bounds table_coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");

struct Field {
  std::string_view text;
  std::size_t position;  ///< in the line
};

/// Splits a line at a separator, or at blanks if it is a blank.
std::vector<Field> split_line(std::string_view line, char separator) {
  std::vector<Field> fields;
  const char* const blanks = separator == '\t' ? " " : " \t";
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t first = line.find_first_not_of(blanks, start);
    if (separator == ' ' && first == std::string_view::npos) break;
    const std::size_t from = separator == ' ' ? first : start;
    const std::size_t end = std::min(
        separator == ' ' ? line.find_first_of(" \t", from) : line.find(separator, from), line.size());
    const std::size_t begin = std::min(line.find_first_not_of(blanks, from), end);
    const std::size_t last = line.find_last_not_of(blanks, end - 1);
    const std::size_t length = begin >= end ? 0 : last + 1 - begin;
    fields.push_back({line.substr(begin, length), begin});
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

bool has_numbers_alone(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return line.find_first_not_of("+-.,;0123456789eE \t") == std::string_view::npos &&
         line.find_first_of("0123456789") != std::string_view::npos && line[first] != 'e' &&
         line[first] != 'E';
}

class TableReader {
 public:
  TableReader(const std::string& file, const PointForm& form)
      : file_(file), form_(form), text_(read_text_file(file, max_csv_bytes)) {
    out_.place = {file};
  }

  FilePoints read() {
    while (next_line()) {
      if (!has_started_ && !has_numbers_alone(line_))
        read_title();
      else
        read_point();
    }
    if (!has_started_ && name_.line > 0) refuse_title(name_);
    if (!has_started_ && !has_header_) throw InvalidInput("the file has no points. " + wanted(), {file_});
    check_airfoil();
    return std::move(out_);
  }

 private:
  /// Line of the file, numbered from 1.
  struct NumberedLine {
    std::string_view text = {};
    int line = 0;
  };

  std::string axes_between(const char* between) const {
    std::string text;
    for (const std::string& axis : form_.axes) text += (text.empty() ? "" : between) + axis;
    return text;
  }

  /// Returns the end of messages: what would be right.
  std::string wanted() const {
    return "Give one point per line, with the header `" + axes_between(",") + "`";
  }

  std::string spelled_count() const { return form_.axes.size() == 2 ? "two" : "three"; }

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

  static char separator_of(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t"), last = line.find_last_not_of(" \t");
    line = line.substr(first, last + 1 - first);
    for (const char c : {';', '\t', ','})
      if (line.find(c) != std::string_view::npos) return c;
    return ' ';
  }

  /// Reads a line of words before the first point: a header, or the name of an airfoil.
  void read_title() {
    const char separator = separator_of(line_);
    const std::vector<Field> fields = split_line(line_, separator);
    const bool names_axis = std::any_of(fields.begin(), fields.end(), [](const Field& field) {
      const std::string axis = title_of(field.text).axis;
      return axis == "x" || axis == "y" || axis == "z";
    });
    if (names_axis) return read_header(fields);
    if (has_header_ && name_.line == 0) return read_point();
    const bool is_table = separator != ' ' && fields.size() == form_.axes.size();
    const NumberedLine title{line_, number_};
    if (has_header_ || is_table) refuse_title(title);
    has_header_ = true;
    name_ = title;
  }

  [[noreturn]] void refuse_title(const NumberedLine& title) const {
    throw InvalidInput(
        in_ticks(title.text) + " is not a point or a header of " + spelled_count() + " columns. " + wanted(),
        {file_, title.line, 1});
  }

  void read_header(const std::vector<Field>& fields) {
    if (has_header_) refuse(0, "this is a second header. Remove it");
    has_header_ = true;
    if (fields.size() != form_.axes.size())
      refuse(0, in_ticks(line_) + " is not a header of " + spelled_count() + " columns. " + wanted());
    for (std::size_t k = 0; k < fields.size(); ++k) check_title(fields[k], k);
  }

  /// In a plane the second axis may be named y or z: points [x, y] of a drawing are points [x, z] of a strip.
  void check_title(const Field& field, std::size_t k) {
    const Title title = title_of(field.text);
    const bool is_known = title.axis == form_.axes[k] ||
                          (k == 1 && form_.axes.size() == 2 && (title.axis == "y" || title.axis == "z"));
    if (!is_known)
      refuse(field.position, in_ticks(field.text) + " is not the name `" + form_.axes[k] +
                                 "` that is expected here. " + wanted());
    if (title.unit.empty()) return;
    const std::optional<double> mm = find_unit(title.unit);
    if (!mm)
      refuse(field.position, in_ticks(field.text) + " has an unknown unit. Give one of " +
                                 joined(names_of(length_units)) + ", such as `" + form_.axes[k] + "_mm`");
    if (out_.unit_mm && *out_.unit_mm != *mm)
      refuse(field.position, "the columns have different units. Give all in the same unit");
    out_.unit_mm = mm;
  }

  void read_point() {
    if (!has_started_) separator_ = separator_of(line_);
    has_started_ = true;
    const std::vector<Field> fields = split_line(line_, separator_);
    if (fields.size() != form_.axes.size()) refuse_columns(fields.size());
    if (out_.points.size() == form_.most)
      refuse(0, "there are too many points. Give at most " + std::to_string(form_.most));
    Eigen::Vector3d& p = out_.points.emplace_back(Eigen::Vector3d::Zero());
    for (std::size_t k = 0; k < fields.size(); ++k) p[static_cast<int>(k)] = number(fields[k]);
    out_.places.push_back({file_, number_, 1});
  }

  [[noreturn]] void refuse_columns(std::size_t count) const {
    const bool has_decimal_commas = separator_ == ',' && count > form_.axes.size();
    const bool is_mixed = separator_ != ';' && line_.find(';') != std::string_view::npos;
    refuse(0, in_ticks(line_) + " has " + std::to_string(count) + (count == 1 ? " column" : " columns") +
                  ". Give " + spelled_count() + ", `" + axes_between(",") + "`" +
                  (is_mixed             ? ", separated as in the first line"
                   : has_decimal_commas ? ", with decimal points, or with `;` between columns"
                                        : ""));
  }

  double number(const Field& field) const {
    std::string text(field.text);
    const bool has_decimal_comma = separator_ != ',' && std::count(text.begin(), text.end(), ',') == 1 &&
                                   text.find('.') == std::string::npos;
    if (has_decimal_comma) text[text.find(',')] = '.';
    try {
      return parse_number(text, table_coordinate);
    } catch (const InvalidInput& e) {
      refuse(field.position, e.reason());
    }
  }

  /// Refuses an airfoil in Lednicer's form, which starts with the numbers of points of both surfaces.
  void check_airfoil() const {
    if (out_.points.size() < 3) return;
    const Eigen::Vector3d counts = out_.points[0];
    const double rows = static_cast<double>(out_.points.size() - 1);
    const bool has_counts = counts.x() >= 2 && counts.y() >= 2 && counts.x() + counts.y() == rows;
    if (!has_counts) return;
    for (std::size_t k = 1; k < out_.points.size(); ++k)
      if (std::abs(out_.points[k].x()) > 1) return;
    throw InvalidInput(
        "this airfoil is in Lednicer's form, with one surface after the other. Give it in Selig's form, as "
        "one line "
        "around it",
        out_.places[0]);
  }

  const std::string& file_;
  const PointForm& form_;
  const std::string text_;
  std::size_t next_ = 0, start_ = 0;
  std::string_view line_;
  int number_ = 0;
  bool has_header_ = false, has_started_ = false;
  NumberedLine name_;
  char separator_ = ',';
  FilePoints out_;
};

}  // namespace

FilePoints read_point_table(const std::string& file, const PointForm& form) {
  return TableReader(file, form).read();
}

}  // namespace kinetix::targets
