#include "targets/drawing/dxf_groups.hpp"

#include <algorithm>

#include "targets/document/number.hpp"

namespace kinetix::targets {
namespace {

/// Lines of a DXF file without the spaces around them.
class DxfLines {
 public:
  explicit DxfLines(std::string_view text) : text_(text) {
    while (!text_.empty() && (text_.back() == '\n' || text_.back() == '\r' || text_.back() == ' '))
      text_.remove_suffix(1);
  }

  bool at_end() const { return text_.empty(); }
  int number() const { return number_; }
  std::string_view next() {
    const std::size_t end = text_.find('\n');
    const std::string_view out = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++number_;
    const std::size_t first = out.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return out.substr(first, out.find_last_not_of(" \t\r") + 1 - first);
  }

 private:
  std::string_view text_;
  int number_ = 0;
};

}  // namespace

InvalidInput DxfGroup::error(const std::string& fault_text) const {
  return InvalidInput(fault_text, {"", line, 1});
}

double DxfGroup::number() const {
  try {
    return parse_number(value);
  } catch (const InvalidInput& e) {
    throw error(e.reason());
  }
}

int DxfGroup::integer() const {
  constexpr int most = 1'000'000;  // flags, counts and units are small
  try {
    return parse_integer(value, -most, most);
  } catch (const InvalidInput& e) {
    throw error(e.reason());
  }
}

const DxfGroup* DxfEntity::find(int code) const {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const DxfGroup& g) { return g.code == code; });
  return found == groups.end() ? nullptr : &*found;
}

double DxfEntity::number(int code, double otherwise) const {
  const DxfGroup* group = find(code);
  return group ? group->number() : otherwise;
}

int DxfEntity::integer(int code, int otherwise) const {
  const DxfGroup* group = find(code);
  return group ? group->integer() : otherwise;
}

std::string_view DxfEntity::text(int code) const {
  const DxfGroup* group = find(code);
  return group ? group->value : std::string_view();
}

Eigen::Vector2d DxfEntity::point(int code) const {
  constexpr int to_y = 10;  // codes of y are those of x plus 10
  const DxfGroup *x = find(code), *y = find(code + to_y);
  if (!x || !y)
    throw error(std::string(name) + " has no coordinate " + (x ? "y" : "x") + ". Save the drawing again");
  return {x->number(), y->number()};
}

InvalidInput DxfEntity::error(const std::string& fault_text) const {
  return InvalidInput(fault_text, {"", line, 1});
}

// DXF in its text form is pairs of lines, a group code and a value. One of Debian's readers is under version 2 of the
// GPL alone, which is not compatible with parts under the Apache licence. The other has had no release since 2011.
std::vector<DxfEntity> parse_dxf_entities(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    throw InvalidInput("this is a binary DXF. Save it as text (ASCII)");
  std::vector<DxfEntity> entities;
  DxfLines lines(text);
  bool is_whole = false, has_sections = false;
  while (!lines.at_end() && !is_whole) {
    const DxfGroup code{0, lines.number() + 1, lines.next()};
    const std::string_view value = lines.next();
    const DxfGroup group{code.integer(), lines.number(), value};
    if (group.code == 0) {
      entities.push_back({value, group.line, {}});
      has_sections = has_sections || value == "SECTION";
      is_whole = value == "EOF";
    } else if (!entities.empty()) {
      entities.back().groups.push_back(group);
    }
  }
  if (!has_sections && !is_whole) throw InvalidInput("this is not a DXF file. Save the drawing as DXF");
  if (!is_whole) throw InvalidInput("the file is cut off: a DXF file ends with EOF. Save the drawing again");
  return entities;
}

}  // namespace kinetix::targets
