#pragma once

#include "targets/drawing/curve_chords.hpp"
#include "targets/drawing/dxf_groups.hpp"

namespace kinetix::targets {

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
