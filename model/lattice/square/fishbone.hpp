#pragma once

#include <array>
#include <vector>

#include "model/lattice/square/crease.hpp"

namespace kinetix::model {

/// One row of a fishbone that carries a rib.
struct FishboneRib {
  int row = 0;                        ///< of cells, from the spine's lower end
  std::array<int, 2> cells = {0, 0};  ///< beyond the spine, towards -x and +x
};

/// A spine one cell wide along y with ribs along x.
struct FishboneLayout {
  int rows = 0;                   ///< of cells of the spine
  std::vector<FishboneRib> ribs;  ///< rows ascending, at least one row of cells between two
};

/// A fishbone as a net, with the creases that its shape follows from. All hinges basic.
struct Fishbone {
  Structure structure;
  FishboneLayout layout;
  int spine_column = 0;                                  ///< i of the spine's cells
  std::vector<Crease> spine;                             ///< of the rows without a rib, from the lower end
  std::vector<std::array<std::vector<Crease>, 2>> ribs;  ///< of each rib and side, from the spine outwards
  int middle = 0;                                        ///< body of the spine's middle row, lower x
};

/// Which rib and side a body belongs to, and how many cells beyond the spine it is; rib -1 on the spine.
struct FishbonePlace {
  int rib = -1, side = 0, cells = 0;
};
FishbonePlace place_of(const Fishbone& fishbone, int body);

/// Lower and upper body of each column of a rib, from -x to +x; the spine's two columns are among them.
std::vector<std::array<int, 2>> rib_columns(const Fishbone& fishbone, const FishboneRib& rib);

/// Bodies of the lower and of the upper end of the spine, each from low to high x.
std::array<std::array<int, 2>, 2> spine_ends(const Fishbone& fishbone);

/// @throws InvalidInput for no row, ribs out of range or next to each other, and what make_structure refuses
Fishbone make_fishbone(const FishboneLayout& layout, const CellSize& size);

}  // namespace kinetix::model
