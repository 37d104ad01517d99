#pragma once

#include <string>

#include "model/assembly/tiles.hpp"

namespace kinetix::app {

/// Checks whether a path is a folder of tiles: it holds vertices.txt.
bool is_tile_folder(const std::string& path);

/// Reads a folder of tiles in the form of PyKirigami (https://github.com/andy-qhjiang/PyKirigami).
/// vertices.txt has a tile per line: `x y z` of each corner.
/// constraints.txt has a joint per line: `tile corner tile corner [face]`, counted from 0. A face is 1 (bottom, the
/// default), 2 (top) or 3 (both). Faces 1 and 2 of the same corners in two lines mean 3.
/// target.txt may be missing. It has the form of vertices.txt.
/// @throws InvalidInput with file, line and column: missing or too large files, words that are not numbers, a wrong
/// count of numbers, faces other than 1 to 3. Also for a target with other corners than the tiles
model::TileSheet read_tiles(const std::string& folder);

}  // namespace kinetix::app
