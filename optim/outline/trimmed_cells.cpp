#include "optim/outline/trimmed_cells.hpp"

#include <set>
#include <utility>

#include "model/base/box_of.hpp"
#include "model/lattice/planar/lattice_cut.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;
using model::LatticeCell;

constexpr std::size_t least_cells = 4;  // fewer form no shape
// Relative to the outline that just fills the rectangle. The pixels of a picture change most between these
// sizes.
constexpr double sizes[] = {1, 0.95, 1.05};
constexpr double shifts[] = {0, 0.5};  // of a column and of a row

}  // namespace

std::vector<std::vector<LatticeCell>> trimmed_cells(const model::PlanarLattice& lattice, double angle,
                                                    int columns, int rows, const targets::Outline& outline) {
  const Eigen::AlignedBox2d rectangle = model::lattice_box(lattice, columns, rows, angle),
                            drawn = model::box_of(outline.points());
  const double ratio = drawn.sizes().cwiseQuotient(rectangle.sizes()).maxCoeff();
  const model::LatticePitch pitch = model::lattice_pitch(lattice, angle);
  std::vector<std::vector<LatticeCell>> found;
  std::set<std::vector<LatticeCell>> known;
  for (const double size : sizes)
    for (const double i_shift : shifts)
      for (const double j_shift : shifts) {
        const double scale = ratio / size;  // mm of the outline per cell edge
        const Vector2d at = rectangle.center() + i_shift * pitch.column + j_shift * pitch.row;
        auto cells = model::cut_cells(lattice, columns, rows, angle, [&](const Vector2d& middle) {
          return outline.contains(drawn.center() + scale * (middle - at));
        });
        if (cells.size() >= least_cells && known.insert(cells).second) found.push_back(std::move(cells));
      }
  return found;
}

}  // namespace kinetix::optim
