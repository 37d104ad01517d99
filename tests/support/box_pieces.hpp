#pragma once

#include "model/elastic/contact/piece_contact.hpp"

namespace kinetix::testing {

/// Returns a box along the axes as a piece of a body. @param middle, half mm
inline model::ContactPiece box_piece(int body, const Eigen::Vector3d& middle, const Eigen::Vector3d& half) {
  model::ContactPiece piece{body, {}, Eigen::MatrixX4d(6, 4)};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        piece.corners.push_back(middle + half.cwiseProduct(Eigen::Vector3d(x, y, z)));
  for (int k = 0; k < 6; ++k) {
    const double side = k % 2 == 0 ? 1 : -1;
    piece.faces.row(k).setZero();
    piece.faces(k, k / 2) = side;
    piece.faces(k, 3) = side * middle[k / 2] + half[k / 2];
  }
  return piece;
}

}  // namespace kinetix::testing
