#pragma once

#include "model/lattice/square/cell_rectangle.hpp"

namespace kinetix::targets {

/// Direction from one face to its neighbour in the flat net. The crease's columns follow one another across it.
using model::Side;

/// A flat rectangle of basic cells.
struct FoldFace {
  std::string name;
  int width = 0, height = 0;  ///< cells along x and y, >= 1
};

/// A fold between two faces.
struct FoldCrease {
  int first = 0, second = 0;  ///< indices of the faces
  Side side = Side::right;    ///< of the first face, beyond which the second one lies
  double angle = 0;           ///< rad, [-pi, pi]; positive: the faces rise towards +z, 0: one flat piece
  int shift = 0;              ///< of the second face's lower end along the crease against the first's, cells
  int columns = 0;            ///< bending columns over which the fold is spread; 0: for the search to choose
};

/// Faces in one plane and the creases that join them.
struct FoldNet {
  std::vector<FoldFace> faces;
  std::vector<FoldCrease> creases;
};

/// Most cells along a face or an edge of a box. The limit refuses wrong numbers before they are laid out.
inline constexpr int max_face_side = 200;
/// Most bending columns of a crease. By the crease law 20 of them fold by 180 deg with tilts of 7 deg and theta of 44
/// deg.
inline constexpr int max_crease_columns = 20;

/// "base-lid"
std::string crease_name(const FoldNet& net, const FoldCrease& crease);

/// Checks a net.
/// @throws InvalidInput, naming the face or crease, for a face without cells, a name given twice, and an angle outside
/// +-180 degrees. It also throws for a crease of a face with itself, two creases between the same faces, and faces
/// that are not connected.
void validate(const FoldNet& net);

/// The bending cells between two faces.
struct PlacedCrease {
  model::Axis axis = model::Axis::x;  ///< of the walls that tilt: x where the faces lie side by side along x
  model::CellRectangle cells;         ///< the fold lines run across the axis

  int columns() const { return cells.extent(axis); }  ///< cells along the axis
};

/// A net's faces and creases on the lattice.
struct NetLayout {
  std::vector<model::CellRectangle> faces;  ///< as in the net
  std::vector<PlacedCrease> creases;        ///< as in the net
  std::vector<model::Cell> cells;           ///< of all faces and creases, sorted, none negative
};

/// Places the faces one after the other along the creases, with each crease's columns between its faces.
/// @param columns of each crease, >= 1.
/// @throws InvalidInput, naming faces or creases, for a crease between faces that are not next to each other. Faces
/// that overlap or touch without a crease also throw, as do creases that need one cell to bend both ways. A ring of
/// faces with folds in both directions throws too.
/// @pre validate accepts the net
NetLayout lay_out(const FoldNet& net, const std::vector<int>& columns);

/// Returns the walls along the crease's axis in its cells, which tilt to bend it.
std::vector<model::Wall> bending_walls(const PlacedCrease& crease);

}  // namespace kinetix::targets
