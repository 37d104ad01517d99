#include "benchmarks/speed_error/scene.hpp"

#include <fmt/format.h>
#include <cmath>

#include "benchmarks/scenes.hpp"
#include "benchmarks/speed_error/equilibrium_points.hpp"
#include "benchmarks/speed_error/exact_points.hpp"
#include "optim/fold/fit_fold.hpp"
#include "optim/ribs/fit_ribs.hpp"
#include "targets/helmet/head.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

// Scale of the cells of the picture, k, with which the search for displays starts (optim::DisplayOptions::rule_k). The
// second number is the compression by the plates, a little more than the default of displays, so that hinges turn far.
constexpr double display_k = 0.15, display_compression = 0.14;

SpeedErrorScene exact_scene(const std::string& name, const model::Structure& structure, double theta) {
  SpeedErrorScene scene{name, structure, drive_to(structure, theta), classify(structure), {}};
  scene.reference = fold(scene.family, structure, theta);
  scene.reference_error = rounding_error(scene);
  return scene;
}

SpeedErrorScene rib_or_circle(const std::string& name, const std::string& curve) {
  model::Structure structure;
  const Scene scene{curve, targets::read_curve_csv(std::string(KINETIX_SHAPES "/") + curve + ".csv")};
  const optim::FreeCurveDesign found = fitted_strip(scene, 40, structure);
  return exact_scene(name, structure, found.design.design.theta);
}

SpeedErrorScene cube() {
  optim::FoldOptions options;
  options.size = {10, 0.8, 6};
  const optim::FoldedNet net = fit_fold(targets::box_goal({4, 4, 4}), options).folded;
  return exact_scene(fmt::format("cube, {} bodies", net.structure.bodies.size()), net.structure, net.theta);
}

SpeedErrorScene helmet() {
  const targets::Head head = make_head(targets::read_mesh(KINETIX_SHAPES "/headform.obj"), {});
  optim::RibsSpec spec;
  spec.size = walls_of(6);
  const optim::RibsDesign design = fit_helmet(head.dome, Eigen::Vector3d::Zero(), spec, {});
  const model::Structure& structure = design.fishbone.structure;
  return exact_scene(fmt::format("helmet, {} bodies", structure.bodies.size()), structure,
                     design.shape.theta);
}

/// Makes a sheet that bends into half a cylinder at any size.
SpeedErrorScene sheet(int cells) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(cells, cells, design);
  return exact_scene(fmt::format("sheet, {0} x {0} cells", cells), structure, design.theta);
}

/// Returns the cells of a disc that fills a panel except a boundary of one cell.
model::Structure circle_panel(int cells) {
  return testing::rule_panel(display_k, cells, [=](int i, int j) {
    return std::hypot(i + 0.5 - cells / 2.0, j + 0.5 - cells / 2.0) <= cells / 2.0 - 1;
  });
}

SpeedErrorScene display(const std::string& name, const model::Structure& structure) {
  SpeedErrorScene scene{
      name, structure, model::Plates{.compression = display_compression}, classify(structure), {}};
  set_finest_equilibrium(scene);
  return scene;
}

}  // namespace

std::vector<SpeedErrorScene> speed_error_scenes() {
  return {rib_or_circle("helmet rib, 40 columns", "helmet_rib"),
          rib_or_circle("half circle, 40 columns", "half_circle"),
          cube(),
          helmet(),
          display("letter T, 10 x 10 cells", testing::letter_panel(display_k)),
          display("circle, 12 x 12 cells", circle_panel(12)),
          sheet(10),
          sheet(20),
          sheet(50)};
}

}  // namespace kinetix::bench
