#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/invalid_input.hpp"
#include "targets/drawing/curve_chords.hpp"

namespace kinetix::targets {

/// A pair of lines of a text DXF: a group code, and a value whose meaning it determines.
struct DxfGroup {
  int code = 0;
  int line = 0;  ///< of the value, from 1
  std::string_view value;

  /// @throws InvalidInput with the line for values that are not numbers
  double number() const;
  int integer() const;
  InvalidInput error(const std::string& fault_text) const;
};

/// Part of a DXF file that begins with group 0: an entity, a layer, or the start or end of a section or block.
struct DxfEntity {
  std::string_view name;
  int line = 0;                  ///< of its name, from 1
  std::vector<DxfGroup> groups;  ///< without its name

  /// Returns the first group with a code, or null.
  const DxfGroup* find(int code) const;
  double number(int code, double otherwise) const;
  int integer(int code, int otherwise) const;
  std::string_view text(int code) const;
  /// Returns the point whose x has this code. @throws InvalidInput if a coordinate is missing
  Eigen::Vector2d point(int code) const;
  InvalidInput error(const std::string& fault_text) const;
};

/// Splits a DXF file. @throws InvalidInput for binary files, for other files, and for a file that is cut off
std::vector<DxfEntity> parse_dxf_entities(std::string_view text);

/// Part of a DXF entity: straight lines, or the chords of one curve.
struct DxfStroke {
  ChordPoints points;
  std::string curve;  ///< name of the curve; empty for straight lines
  int line = 0;       ///< of the file, from 1
};

/// Whether the plane of an entity is seen from below (extrusion along -z). @throws InvalidInput for a tilted plane
bool is_from_below(const DxfEntity& entity);

/// Returns the strokes of an entity, none for text, dimensions and other entities that are not lines.
/// @param vertices VERTEX entities of a POLYLINE
/// @throws InvalidInput for meshes, solids, lines that are not flat, and incomplete entities
std::vector<DxfStroke> dxf_strokes(const DxfEntity& entity, const std::vector<const DxfEntity*>& vertices);

}  // namespace kinetix::targets
