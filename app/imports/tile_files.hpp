#pragma once

#include <string>

#include "model/assembly/tiles.hpp"

namespace kinetix::app {

/// Whether a path is a folder of tiles: it holds vertices.txt.
bool is_tile_folder(const std::string& path);

/// A folder of tiles in the form of PyKirigami (https://github.com/andy-qhjiang/PyKirigami):
/// vertices.txt, a tile a line, `x y z` of each corner; constraints.txt, a joint a line, `tile corner tile corner [face]`, counted from 0,
/// where face is 1 (bottom, the default), 2 (top) or 3 (both; 1 and 2 of the same corners in two lines are the same as 3); and, where it
/// is there, target.txt in the form of vertices.txt.
/// @throws InvalidInput with file, line and column: files that are not there or too large, words that are no numbers, another number
/// of them, faces but 1 to 3, a target with other corners than the tiles
model::TileSheet read_tiles(const std::string& folder);

}  // namespace kinetix::app
