#pragma once

#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Reads the exact design off a sheet's hinges, as classify() does, but many times for one set of cells: a
/// microsecond for a strip. Families F1, F2 and F3 along x only.
class SheetReader {
 public:
  /// @param structure gives the cells; its hinges' parameters do not matter
  explicit SheetReader(const Structure& structure);

  /// The design that the hinges have, each column and row as its first hinge has it; theta is left alone.
  /// @param structure the same cells; @param tolerance on fractions (absolute) and angles (rad)
  /// @return false where the hinges keep none of the three families' rules; `design` is then of no use
  bool read(const Structure& structure, ExactDesign<double>& design, double tolerance = 1e-9) const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  int columns_ = 0, rows_ = 0;
};

}  // namespace kinetix::model
