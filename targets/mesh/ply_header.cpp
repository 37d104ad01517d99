#include "targets/mesh/ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_words.hpp"

namespace kinetix::targets {
namespace {

using Number = PlyHeader::Number;

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
  explicit HeaderReader(std::string_view text) : words_(text) {}

  PlyHeader read() {
    words_.next_line();
    if (words_.word() != "ply") throw words_.error("is not a PLY file: it does not start with `ply`");
    while (words_.next_line()) {
      ++header_.lines;
      read_line(words_.word());
    }
    if (!has_format_) throw InvalidInput("is damaged: its header names no format");
    return header_;
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "format") return read_format();
    if (keyword == "element") return read_element();
    if (keyword == "property") return read_property();
    const bool says_nothing =
        keyword == "comment" || keyword == "obj_info" || keyword == "end_header" || keyword.empty();
    if (!says_nothing) throw words_.error(in_ticks(keyword) + " is not known in the header of a PLY file");
  }

  void read_format() {
    using enum PlyHeader::Encoding;
    static const std::map<std::string_view, PlyHeader::Encoding> encodings = {
        {"ascii", ascii}, {"binary_little_endian", little_endian}, {"binary_big_endian", big_endian}};
    const auto it = encodings.find(words_.word());
    if (it == encodings.end())
      throw words_.error(in_ticks(words_.last_word()) +
                         " is no format; allowed: ascii, binary_little_endian, binary_big_endian");
    header_.encoding = it->second;
    has_format_ = true;
    if (words_.word() != "1.0") throw words_.error("is an unknown version of PLY; allowed: 1.0");
  }

  void read_element() {
    PlyHeader::Element element;
    element.name = words_.word();
    const std::string_view count = words_.word();
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size())
      throw words_.error(in_ticks(count) + " is no number of elements");
    header_.elements.push_back(element);
  }

  void read_property() {
    if (header_.elements.empty()) throw words_.error("a property stands before any element");
    PlyHeader::Property property;
    property.is_list = words_.word() == "list";
    if (property.is_list) {
      property.count = type(words_.word());
      if (property.count.is_float) throw words_.error("the length of a list cannot be a fraction");
      words_.word();
    }
    property.number = type(words_.last_word());
    property.name = words_.word();
    header_.elements.back().properties.push_back(property);
  }

  Number type(std::string_view name) const {
    const auto number = number_named(name);
    if (!number) throw words_.error(in_ticks(name) + " is no type of PLY");
    return *number;
  }

  MeshWords words_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

int PlyHeader::Element::find(const std::string& property) const {
  const auto it = std::find_if(properties.begin(), properties.end(),
                               [&](const Property& p) { return p.name == property; });
  return it == properties.end() ? -1 : static_cast<int>(it - properties.begin());
}

std::size_t PlyHeader::Element::least_bytes(Encoding encoding) const {
  if (encoding == Encoding::ascii) return 2 * std::max<std::size_t>(properties.size(), 1) - 1;
  std::size_t bytes = 0;
  for (const Property& p : properties) bytes += p.is_list ? p.count.bytes : p.number.bytes;
  return bytes;
}

PlyHeader parse_ply_header(const std::string& bytes) {
  const std::size_t end = header_end(bytes);
  PlyHeader header = HeaderReader(std::string_view(bytes).substr(0, end)).read();
  header.end = end;
  header.lines += 1;
  return header;
}

}  // namespace kinetix::targets
