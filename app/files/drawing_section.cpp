#include "app/files/drawing_section.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

/// mm of each unit that a file may name.
constexpr targets::Word<double> drawing_units[] = {
    {"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}, {"ft", 304.8}, {"pt", 25.4 / 72}, {"px", 25.4 / 96}};

// Ratio: from a drawing in micrometres to one in kilometres.
const targets::Bounds scales = targets::from_to(1e-6, 1e6);
// mm: from rounding to the longest wall.
const targets::Bounds joins = targets::from_to(1e-6, 1000, "mm");

}  // namespace

std::vector<targets::Key> drawing_keys() {
  std::vector<targets::Key> keys = {
      {"drawing", value::text("path of a DXF or SVG file, from the folder of the design"), targets::needed,
       "for `graph`: drawing whose visible lines are the walls. They are split where others end or cross, "
       "and lines "
       "that overlap are one wall"}};
  for (targets::Key& key : drawing_size_keys()) keys.push_back(std::move(key));
  return keys;
}

std::vector<targets::Key> drawing_size_keys() {
  return {
      {"unit", value::choice(drawing_units),
       targets::otherwise("the unit of the file: `$INSUNITS`, or `width` and `height`; else mm in a DXF "
                          "and px in an SVG"),
       "for drawings: unit of the numbers in the file. `pt` is 1/72 inch and `px` is 1/96 inch"},
      {"scale", value::number(scales), targets::by_default(1), "for drawings: factor of all lengths"},
      {"join_mm", value::number(joins), targets::otherwise("0.2 % of the median wall"),
       "for drawings: distance up to which ends of lines are joined"},
  };
}

targets::DrawnWalls examine_drawn_structure(const targets::Section& structure) {
  targets::DrawingSettings settings;
  settings.are_cuts = structure.knows("cuts");
  if (const auto unit = structure.optional("unit")) settings.unit_mm = read_word(*unit, drawing_units);
  structure.read("scale", settings.scale);
  structure.read("join_mm", settings.join_mm);
  const char* key = settings.are_cuts ? "cuts" : "drawing";
  return examine_drawing(structure.required(key, "path of a DXF or SVG file"), settings);
}

}  // namespace kinetix::app
