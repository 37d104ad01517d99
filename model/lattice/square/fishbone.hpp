#pragma once

#include "model/lattice/square/crease.hpp"

namespace kinetix::model {

/// A row of a fishbone with a rib.
struct FishboneRib {
  int row = 0;                        ///< row of cells, from the spine's lower end
  std::array<int, 2> cells = {0, 0};  ///< number of cells beyond the spine, towards -x and +x
};

/// A spine one cell wide along y with ribs along x.
struct FishboneLayout {
  int rows = 0;                   ///< number of cells of the spine
  std::vector<FishboneRib> ribs;  ///< rows ascending, at least one row of cells between two
};

/// A fishbone as a net, with the creases that determine its shape. All hinges are basic.
struct Fishbone {
  Structure structure;
  FishboneLayout layout;
  int spine_column = 0;       ///< i of the spine's cells
  std::vector<Crease> spine;  ///< creases of the rows without a rib, from the lower end
  std::vector<std::array<std::vector<Crease>, 2>> ribs;  ///< per rib and side, from the spine outwards
  int middle = 0;                                        ///< body of the spine's middle row, lower x
};

/// Rib and side of a body, and its number of cells beyond the spine; rib -1 on the spine.
struct FishbonePlace {
  int rib = -1, side = 0, cells = 0;
};
FishbonePlace place_of(const Fishbone& fishbone, int body);

/// Returns the lower and upper body of each column of a rib, from -x to +x, including the spine's two columns.
std::vector<std::array<int, 2>> rib_columns(const Fishbone& fishbone, const FishboneRib& rib);

/// Returns the bodies of the lower and of the upper end of the spine, each from low to high x.
std::array<std::array<int, 2>, 2> spine_ends(const Fishbone& fishbone);

/// Creates a fishbone. @throws InvalidInput for no row, ribs out of range or next to each other, and as
/// make_structure
Fishbone make_fishbone(const FishboneLayout& layout, const CellSize& size);

}  // namespace kinetix::model
