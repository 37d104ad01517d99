#include <Eigen/Geometry>
#include <map>
#include <set>

#include "model/base/geometry.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/drawing.hpp"
#include "targets/drawing/dxf_groups.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

constexpr int deepest_block = 16;                 // blocks in each other
constexpr std::size_t max_dxf_parts = 2'000'000;  // entities, those of repeated blocks included

/// Unit of $INSUNITS.
struct DxfUnit {
  const char* name;
  double mm;
};

// Values 1 to 24 of $INSUNITS, by Autodesk's DXF reference.
constexpr double us_foot = 1200.0 / 3937 * 1000;
constexpr DxfUnit dxf_units[] = {{"inches", 25.4},
                                 {"feet", 304.8},
                                 {"miles", 1609344},
                                 {"mm", 1},
                                 {"cm", 10},
                                 {"m", 1000},
                                 {"km", 1e6},
                                 {"microinches", 25.4e-6},
                                 {"mils", 25.4e-3},
                                 {"yards", 914.4},
                                 {"angstroms", 1e-7},
                                 {"nanometres", 1e-6},
                                 {"micrometres", 1e-3},
                                 {"decimetres", 100},
                                 {"decametres", 1e4},
                                 {"hectometres", 1e5},
                                 {"gigametres", 1e12},
                                 {"astronomical units", 1.495978707e14},
                                 {"light years", 9.4607304725808e18},
                                 {"parsecs", 3.0856775814913673e19},
                                 {"US survey feet", us_foot},
                                 {"US survey inches", us_foot / 12},
                                 {"US survey yards", 3 * us_foot},
                                 {"US survey miles", 5280 * us_foot}};

struct DxfLayer {
  bool is_hidden = false;
  int colour = 0;  ///< 0xRRGGBB
};

struct DxfBlock {
  Vector2d base = {0, 0};
  std::vector<const DxfEntity*> entities;
};

/// Parts of a DXF file.
struct DxfContents {
  std::vector<const DxfEntity*> entities;
  std::map<std::string_view, DxfBlock> blocks;
  std::map<std::string_view, DxfLayer> layers;
  const DxfGroup* unit = nullptr;  ///< value of $INSUNITS
};

/// Returns a colour of AutoCAD's index as 0xRRGGBB; black for all but the first six.
int indexed_colour(int index) {
  static const std::map<int, int> known = {{1, 0xFF0000}, {2, 0xFFFF00}, {3, 0x00FF00},
                                           {4, 0x00FFFF}, {5, 0x0000FF}, {6, 0xFF00FF}};
  const auto found = known.find(std::abs(index));
  return found == known.end() ? 0 : found->second;
}

DxfLayer layer_of(const DxfEntity& entity) {
  constexpr int frozen = 1;
  const int colour = entity.integer(62, 7);
  const bool is_for_notes =
      lower_case(entity.text(2)) == "defpoints";  // points of dimensions are never plotted
  return {(entity.integer(70, 0) & frozen) != 0 || colour < 0 || is_for_notes, indexed_colour(colour)};
}

/// Finds $INSUNITS in the groups of the header, which follow its SECTION.
const DxfGroup* unit_group(const DxfEntity& header) {
  for (std::size_t k = 1; k < header.groups.size(); ++k)
    if (header.groups[k - 1].code == 9 && header.groups[k - 1].value == "$INSUNITS") return &header.groups[k];
  return nullptr;
}

DxfContents contents_of(const std::vector<DxfEntity>& all) {
  DxfContents contents;
  std::string_view section;
  DxfBlock* block = nullptr;
  for (const DxfEntity& entity : all) {
    if (entity.name == "SECTION") {
      section = entity.text(2);
      if (section == "HEADER") contents.unit = unit_group(entity);
    } else if (entity.name == "ENDSEC") {
      section = {};
    } else if (section == "TABLES" && entity.name == "LAYER") {
      contents.layers[entity.text(2)] = layer_of(entity);
    } else if (section == "BLOCKS" && entity.name == "BLOCK") {
      block = &contents.blocks[entity.text(2)];
      block->base = {entity.number(10, 0), entity.number(20, 0)};
    } else if (section == "BLOCKS" && block) {
      if (entity.name == "ENDBLK")
        block = nullptr;
      else
        block->entities.push_back(&entity);
    } else if (section == "ENTITIES") {
      contents.entities.push_back(&entity);
    }
  }
  return contents;
}

/// Draws entities and the blocks that they insert.
class DxfReader {
 public:
  explicit DxfReader(const DxfContents& contents) : contents_(contents) {}

  Drawing run() {
    draw(contents_.entities, Affine2d::Identity(), "0", 0);
    set_unit();
    return std::move(out_);
  }

 private:
  using Entities = std::vector<const DxfEntity*>;

  void draw(const Entities& entities, const Affine2d& at, std::string_view layer, int depth) {
    for (std::size_t k = 0; k < entities.size(); ++k) {
      const DxfEntity& entity = *entities[k];
      if (++parts_ > max_dxf_parts)
        throw entity.error("the drawing has more than 2 million entities. Give a smaller drawing");
      Entities vertices;
      if (entity.name == "POLYLINE")
        while (k + 1 < entities.size() && entities[k + 1]->name == "VERTEX")
          vertices.push_back(entities[++k]);
      draw_one(entity, vertices, at, layer, depth);
    }
  }

  void draw_one(const DxfEntity& entity, const Entities& vertices, const Affine2d& at, std::string_view above,
                int depth) {
    const bool is_on_paper = entity.integer(67, 0) != 0, is_invisible = entity.integer(60, 0) != 0;
    std::string_view layer = entity.text(8);
    if (layer.empty() || layer == "0") layer = above;  // layer 0 in a block is the layer of its insertion
    const auto known = contents_.layers.find(layer);
    if (is_on_paper || is_invisible || (known != contents_.layers.end() && known->second.is_hidden)) return;
    if (entity.name == "INSERT") return insert(entity, at, layer, depth);
    constexpr int by_layer = 256;
    const int index = entity.integer(62, by_layer);
    const int layer_colour = known == contents_.layers.end() ? 0 : known->second.colour;
    const int colour = index == by_layer ? layer_colour : indexed_colour(index);
    static const std::set<std::string_view> in_space = {"LINE", "ELLIPSE", "SPLINE", "3DFACE"};
    Affine2d placed = at;
    const std::vector<DxfStroke> strokes = dxf_strokes(entity, vertices);
    if (!strokes.empty() && !in_space.contains(entity.name) && is_from_below(entity))
      placed.scale(Vector2d(-1, 1));
    for (const DxfStroke& stroke : strokes) add(stroke, placed, colour);
  }

  void insert(const DxfEntity& entity, const Affine2d& above, std::string_view layer, int depth) {
    const auto block = contents_.blocks.find(entity.text(2));
    if (block == contents_.blocks.end())
      throw entity.error("the block " + in_ticks(entity.text(2)) +
                         " is not in the file. Remove its insertion, or save the drawing with its blocks");
    if (depth >= deepest_block)
      throw entity.error("blocks are nested more than " + std::to_string(deepest_block) +
                         " levels deep. Explode them into lines");
    Affine2d at = above;
    if (is_from_below(entity)) at.scale(Vector2d(-1, 1));
    at.translate(entity.point(10)).rotate(entity.number(50, 0) * radians_per_degree);
    const Vector2d scale(entity.number(41, 1), entity.number(42, 1));
    const Vector2d step(entity.number(44, 0), entity.number(45, 0));
    const int columns = std::max(1, entity.integer(70, 1)), rows = std::max(1, entity.integer(71, 1));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        if (++parts_ > max_dxf_parts)
          throw entity.error("blocks are inserted more than 2 million times. Give a smaller drawing");
        Affine2d one = at;
        one.translate(step.cwiseProduct(Vector2d(column, row))).scale(scale).translate(-block->second.base);
        draw(block->second.entities, one, layer, depth + 1);
      }
  }

  void add(const DxfStroke& stroke, const Affine2d& at, int colour) {
    int curve = -1;
    if (!stroke.curve.empty()) {
      curve = static_cast<int>(out_.curves.size());
      out_.curves.push_back(stroke.curve);
    }
    for (std::size_t k = 1; k < stroke.points.size(); ++k) {
      out_.lines.push_back({at * stroke.points[k - 1], at * stroke.points[k], stroke.line, colour, curve});
      if (!out_.lines.back().from.allFinite() || !out_.lines.back().to.allFinite())
        throw InvalidInput("a coordinate is too large. Give smaller numbers", {"", stroke.line, 1});
    }
    if (out_.lines.size() > max_drawn_lines)
      throw InvalidInput("the drawing has more than a million lines. Give a smaller drawing",
                         {"", stroke.line, 1});
  }

  void set_unit() {
    out_.unit_source = "mm, assumed because the file has no $INSUNITS";
    if (!contents_.unit) return;
    const int number = contents_.unit->integer();
    if (number < 1 || number > static_cast<int>(std::size(dxf_units))) {
      out_.unit_source = "mm, assumed because $INSUNITS is " + std::to_string(number) + ", which has no unit";
      return;
    }
    out_.unit_mm = dxf_units[number - 1].mm;
    out_.has_unit = true;
    out_.unit_source = "$INSUNITS " + std::to_string(number) + ", " + dxf_units[number - 1].name;
  }

  const DxfContents& contents_;
  Drawing out_;
  std::size_t parts_ = 0;
};

}  // namespace

Drawing parse_dxf(const std::string& text) {
  const std::vector<DxfEntity> all = parse_dxf_entities(text);
  return DxfReader(contents_of(all)).run();
}

}  // namespace kinetix::targets
