#pragma once

#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Reads the exact design from a sheet's hinges, as classify() does, but repeatedly for one set of cells: a
/// microsecond for a strip. It supports only families F1, F2 and F3 along x.
class SheetReader {
 public:
  /// @param structure provides the cells; its hinges' parameters do not matter
  explicit SheetReader(const Structure& structure);

  /// Reads the design of the hinges, each column and row from its first hinge; theta does not change.
  /// @param structure the same cells; @param tolerance on fractions (absolute) and angles (rad)
  /// @return false if the hinges satisfy none of the three families' rules; `design` is then invalid
  bool read(const Structure& structure, ExactDesign<double>& design, double tolerance = 1e-9) const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  int columns_ = 0, rows_ = 0;
};

}  // namespace kinetix::model
