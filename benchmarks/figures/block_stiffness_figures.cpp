#include <fmt/format.h>

#include <array>
#include <cmath>

#include "benchmarks/figure.hpp"
#include "tests/support/calculix_block.hpp"

namespace kinetix::bench {
namespace {

constexpr double allowed =
    0.1;  // fraction of CalculiX's stiffness: springs within it fold a sheet almost equally
constexpr double lengths[] = {1, 2, 3, 4}, heights[] = {5, 7.5, 10};  // over the thickness
constexpr double nus[] = {0.3, 0.48};  // of what hardly yields at the ends, and of rubber

struct Direction {
  const char* name;
  double largest = 0;                     ///< difference, of CalculiX's stiffness
  double length = 0, height = 0, nu = 0;  ///< of the block that has it
};

std::array<double, 6> ratios(const model::HingeStiffness& k, const testing::BlockStiffness& m) {
  return {k.axial / m.axial, k.shear / m.shear,          k.along / m.along,
          k.turn / m.turn,   k.rock.value() / m.rocking, k.twist.value() / m.twist};
}

}  // namespace

std::vector<Figure> block_stiffness_figures() {
  const std::string what = "block hinges, L/t 1 to 4, h/t 5 to 10, nu 0.3 and 0.48, against CalculiX: ";
  std::array<Direction, 6> all{{{"axial"}, {"shear"}, {"along"}, {"turn"}, {"rocking"}, {"twist"}}};
  if (!testing::has_calculix())
    return {{what + "stiffness", "within 10 %", "CalculiX is not installed", false}};
  int blocks = 0;
  for (const double length : lengths)
    for (const double height : heights)
      for (const double nu : nus) {
        const model::ManufacturedHinge block = testing::block_of(length, height, nu);
        const auto measured = testing::calculix_stiffness(block);
        if (!measured) return {{what + "stiffness", "within 10 %", "CalculiX failed", false}};
        const std::array<double, 6> ratio = ratios(stiffness(block), *measured);
        for (std::size_t k = 0; k < all.size(); ++k)
          if (const double off = std::abs(ratio[k] - 1); !(off <= all[k].largest))
            all[k] = {all[k].name, off, length, height, nu};
        ++blocks;
      }
  std::vector<Figure> figures;
  for (const Direction& d : all)
    figures.push_back({what + d.name, "within 10 %",
                       fmt::format("{:.1f} % at most, of {} blocks at L/t {:g}, h/t {:g}, nu {:g}",
                                   100 * d.largest, blocks, d.length, d.height, d.nu),
                       d.largest <= allowed});
  return figures;
}

}  // namespace kinetix::bench
