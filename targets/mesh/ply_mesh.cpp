#include "targets/mesh/mesh_formats.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>

#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::targets {
namespace {

/// Description of the data in a PLY file, from its header.
struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian };

  struct Number {
    int bytes = 0;
    bool is_float = false, is_signed = false;
  };
  struct Property {
    std::string name;
    Number number;
    bool is_list = false;
    Number count = {};  ///< of a list's length
  };
  struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;

    /// Position of a property; -1 when there is none.
    int find(const std::string& property) const;
    /// Bytes that one of these elements takes at least (every list empty).
    std::size_t min_bytes(Encoding encoding) const;
  };

  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data start
  int lines = 0;        ///< of the header
};

using Number = PlyHeader::Number;

// Most corners of strips in one list: as many as the allowed triangles need, with ends of strips between them.
constexpr std::size_t max_strip_corners = 2 * max_mesh_triangles;

// Longest header, bytes: real ones have hundreds. The limit avoids a search through a whole file.
constexpr std::size_t longest_header = 1 << 16;

std::optional<Number> number_named(std::string_view name) {
  static const std::map<std::string_view, Number> types = {
      {"char", {1, false, true}},    {"int8", {1, false, true}},    {"uchar", {1, false, false}},
      {"uint8", {1, false, false}},  {"short", {2, false, true}},   {"int16", {2, false, true}},
      {"ushort", {2, false, false}}, {"uint16", {2, false, false}}, {"int", {4, false, true}},
      {"int32", {4, false, true}},   {"uint", {4, false, false}},   {"uint32", {4, false, false}},
      {"float", {4, true, true}},    {"float32", {4, true, true}},  {"double", {8, true, true}},
      {"float64", {8, true, true}}};
  const auto it = types.find(name);
  return it == types.end() ? std::nullopt : std::optional(it->second);
}

/// Returns the bytes of the header with its last line end; throws if it does not end.
std::size_t header_end(const std::string& bytes) {
  const std::string_view start = std::string_view(bytes).substr(0, longest_header);
  for (std::size_t at = start.find("end_header"); at != std::string_view::npos;
       at = start.find("end_header", at + 1)) {
    if (at == 0 || (start[at - 1] != '\n' && start[at - 1] != '\r')) continue;
    const std::size_t line_end = start.find_first_of("\r\n", at);
    if (line_end == std::string_view::npos) break;
    return line_end + (start.substr(line_end).starts_with("\r\n") ? 2 : 1);
  }
  throw InvalidInput("is not a PLY file, or is cut short: its header does not end with `end_header`");
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : tokens_(text) {}

  PlyHeader read() {
    tokens_.next_line();
    if (tokens_.word() != "ply") throw tokens_.error("is not a PLY file: it does not start with `ply`");
    while (tokens_.next_line()) {
      ++header_.lines;
      read_line(tokens_.word());
    }
    if (!has_format_) throw InvalidInput("is damaged: its header names no format");
    return header_;
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "format") return read_format();
    if (keyword == "element") return read_element();
    if (keyword == "property") return read_property();
    const bool is_ignorable =
        keyword == "comment" || keyword == "obj_info" || keyword == "end_header" || keyword.empty();
    if (!is_ignorable) throw tokens_.error(in_ticks(keyword) + " is not known in the header of a PLY file");
  }

  void read_format() {
    using enum PlyHeader::Encoding;
    static const std::map<std::string_view, PlyHeader::Encoding> encodings = {
        {"ascii", ascii}, {"binary_little_endian", little_endian}, {"binary_big_endian", big_endian}};
    const auto it = encodings.find(tokens_.word());
    if (it == encodings.end())
      throw tokens_.error(in_ticks(tokens_.last_word()) +
                          " is not a format; allowed: ascii, binary_little_endian, binary_big_endian");
    header_.encoding = it->second;
    has_format_ = true;
    if (tokens_.word() != "1.0") throw tokens_.error("is an unknown version of PLY; allowed: 1.0");
  }

  void read_element() {
    PlyHeader::Element element;
    element.name = tokens_.word();
    const std::string_view count = tokens_.word();
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size())
      throw tokens_.error(in_ticks(count) + " is not a number of elements");
    header_.elements.push_back(element);
  }

  void read_property() {
    if (header_.elements.empty()) throw tokens_.error("a property is before the first element");
    PlyHeader::Property property;
    property.is_list = tokens_.word() == "list";
    if (property.is_list) {
      property.count = type(tokens_.word());
      if (property.count.is_float) throw tokens_.error("the length of a list cannot be a fraction");
      tokens_.word();
    }
    property.number = type(tokens_.last_word());
    property.name = tokens_.word();
    header_.elements.back().properties.push_back(property);
  }

  Number type(std::string_view name) const {
    const auto number = number_named(name);
    if (!number) throw tokens_.error(in_ticks(name) + " is not a type of PLY");
    return *number;
  }

  MeshTokens tokens_;
  PlyHeader header_;
  bool has_format_ = false;
};

int PlyHeader::Element::find(const std::string& property) const {
  const auto it = std::find_if(properties.begin(), properties.end(),
                               [&](const Property& p) { return p.name == property; });
  return it == properties.end() ? -1 : static_cast<int>(it - properties.begin());
}

std::size_t PlyHeader::Element::min_bytes(Encoding encoding) const {
  if (encoding == Encoding::ascii) return 2 * std::max<std::size_t>(properties.size(), 1) - 1;
  std::size_t bytes = 0;
  for (const Property& p : properties) bytes += p.is_list ? p.count.bytes : p.number.bytes;
  return bytes;
}

/// @throws InvalidInput with the line as place for anything that is not a header of PLY 1.0
PlyHeader parse_ply_header(const std::string& bytes) {
  const std::size_t end = header_end(bytes);
  PlyHeader header = HeaderReader(std::string_view(bytes).substr(0, end)).read();
  header.end = end;
  header.lines += 1;
  return header;
}

/// Numbers of the data, one after the other.
class PlyNumbers {
 public:
  virtual ~PlyNumbers() = default;
  virtual double next(const PlyHeader::Number& type) = 0;
  /// Returns an error at the last number.
  virtual InvalidInput error(const std::string& fault_text) const = 0;
};

class TextNumbers : public PlyNumbers {
 public:
  TextNumbers(std::string_view text, int line) : tokens_(text, false, line) {}
  double next(const PlyHeader::Number&) override { return tokens_.number_of_any_line("a number"); }
  InvalidInput error(const std::string& fault_text) const override { return tokens_.error(fault_text); }

 private:
  MeshTokens tokens_;
};

class BinaryNumbers : public PlyNumbers {
 public:
  BinaryNumbers(std::string_view bytes, bool is_big_endian) : bytes_(bytes), is_big_endian_(is_big_endian) {}

  double next(const PlyHeader::Number& type) override {
    const auto size = static_cast<std::size_t>(type.bytes);
    if (bytes_.size() - at_ < size) throw InvalidInput("is cut short: its data end early");
    std::uint64_t raw = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t from = is_big_endian_ ? size - 1 - k : k;
      raw |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at_ + from])) << (8 * k);
    }
    at_ += size;
    return value(raw, type);
  }
  InvalidInput error(const std::string& fault_text) const override { return InvalidInput(fault_text); }

 private:
  static double value(std::uint64_t raw, const PlyHeader::Number& type) {
    if (type.is_float && type.bytes == 8) return std::bit_cast<double>(raw);
    if (type.is_float) return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    const int unused = 64 - 8 * type.bytes;
    if (type.is_signed) return static_cast<double>(static_cast<std::int64_t>(raw << unused) >> unused);
    return static_cast<double>(raw);
  }

  std::string_view bytes_;
  bool is_big_endian_;
  std::size_t at_ = 0;
};

std::unique_ptr<PlyNumbers> numbers_of(const std::string& bytes, const PlyHeader& header) {
  const std::string_view data = std::string_view(bytes).substr(header.end);
  if (header.encoding == PlyHeader::Encoding::ascii)
    return std::make_unique<TextNumbers>(data, header.lines + 1);
  return std::make_unique<BinaryNumbers>(data, header.encoding == PlyHeader::Encoding::big_endian);
}

void check_counts(const PlyHeader& header, std::size_t data_bytes) {
  std::size_t left = data_bytes + 1;  // the last line of a text may lack its end
  for (const PlyHeader::Element& element : header.elements) {
    const std::size_t each =
        element.min_bytes(header.encoding) + (header.encoding == PlyHeader::Encoding::ascii);
    if (each == 0 ? element.count > max_mesh_bytes : element.count > left / each)
      throw InvalidInput("is damaged: its header names " + std::to_string(element.count) + " elements `" +
                         element.name + "`, more than its " + byte_count(data_bytes) + " of data can hold");
    left -= element.count * each;
  }
}

class PlyReader {
 public:
  PlyReader(const std::string& bytes, const PlyHeader& header)
      : header_(header), numbers_(numbers_of(bytes, header)) {}

  TriangleMesh read() {
    for (const PlyHeader::Element& element : header_.elements) {
      if (element.name == "vertex" && mesh_.vertices.empty())
        read_vertices(element);
      else if (element.name == "tristrips")
        read_strips(element, corners_of(element));
      else
        read_faces(element, element.name == "face" ? corners_of(element) : -1);
    }
    check_corners();
    return std::move(mesh_);
  }

 private:
  static int corners_of(const PlyHeader::Element& element) {
    for (const char* name : {"vertex_indices", "vertex_index"}) {
      const int property = element.find(name);
      if (property >= 0 && element.properties[property].is_list) return property;
    }
    return -1;
  }

  void read_vertices(const PlyHeader::Element& element) {
    const int axis[] = {element.find("x"), element.find("y"), element.find("z")};
    for (const int property : axis)
      if (property < 0 || element.properties[property].is_list)
        throw InvalidInput("its vertices lack one of the properties x, y, z");
    mesh_.vertices.reserve(element.count);
    for (std::size_t v = 0; v < element.count; ++v) {
      Eigen::Vector3d& p = mesh_.vertices.emplace_back();
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        read_property(element.properties[k]);
        for (int c = 0; c < 3; ++c)
          if (axis[c] == k) p[c] = values_[0];
      }
    }
  }

  /// @param corners position of the property that lists a face's corners; -1 to skip the element
  void read_faces(const PlyHeader::Element& element, int corners) {
    if (element.properties.empty()) return;  // however many there are: each is nothing
    for (std::size_t f = 0; f < element.count; ++f)
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        read_property(element.properties[k]);
        if (k == corners) add_face();
      }
  }

  /// @param corners position of the property that lists the corners of strips; -1 to skip the element
  void read_strips(const PlyHeader::Element& element, int corners) {
    if (element.properties.empty()) return;
    for (std::size_t s = 0; s < element.count; ++s)
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        read_property(element.properties[k], max_strip_corners);
        if (k == corners) add_strips();
      }
  }

  /// Adds the triangles of strips: each corner makes one with the two before it. A corner of -1 ends a strip.
  void add_strips() {
    std::size_t start = 0;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      if (values_[k] == -1) {
        start = k + 1;
        continue;
      }
      if (k < start + 2) continue;
      const bool is_odd = (k - start) % 2 == 1;
      const Triangle triangle = {corner(is_odd ? k - 1 : k - 2), corner(is_odd ? k - 2 : k - 1), corner(k)};
      const bool has_area =
          triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
      if (has_area) add_triangle(triangle);
    }
  }

  void read_property(const PlyHeader::Property& property, std::size_t most = max_face_corners) {
    const double length = property.is_list ? numbers_->next(property.count) : 1;
    if (!(length >= 0 && length <= static_cast<double>(most)) || length != std::floor(length))
      throw numbers_->error("is damaged: a list of " + number_text(length) + " entries; at most " +
                            std::to_string(most) + " are allowed");
    values_.clear();
    for (int k = 0; k < static_cast<int>(length); ++k) values_.push_back(numbers_->next(property.number));
  }

  void add_face() {
    for (std::size_t k = 2; k < values_.size(); ++k) add_triangle({corner(0), corner(k - 1), corner(k)});
  }

  void add_triangle(const Triangle& triangle) {
    if (mesh_.triangles.size() == max_mesh_triangles)
      throw InvalidInput("has too many triangles; at most " + std::to_string(max_mesh_triangles) +
                         " are allowed. Thin the mesh out");
    mesh_.triangles.push_back(triangle);
  }

  int corner(std::size_t k) const {
    const double value = values_[k];
    if (!(value >= 0 && value < 2147483647.0) || value != std::floor(value))
      throw numbers_->error("is damaged: " + number_text(value) + " is not an index of a vertex");
    return static_cast<int>(value);
  }

  void check_corners() const {
    const int count = static_cast<int>(mesh_.vertices.size());
    for (const Triangle& triangle : mesh_.triangles)
      for (const int corner : triangle)
        if (corner >= count)
          throw InvalidInput("is damaged: a face names the vertex " + std::to_string(corner) +
                             " (from 0), but there are only " + std::to_string(count));
  }

  const PlyHeader& header_;
  std::unique_ptr<PlyNumbers> numbers_;
  TriangleMesh mesh_;
  std::vector<double> values_;  // of the last property
};

}  // namespace

TriangleMesh parse_ply(const std::string& bytes) {
  const PlyHeader header = parse_ply_header(bytes);
  check_counts(header, bytes.size() - header.end);
  return PlyReader(bytes, header).read();
}

}  // namespace kinetix::targets
