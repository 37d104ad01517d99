#include <ceres/jet.h>
#include <fmt/format.h>
#include <map>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/lattice/square/family/exact_derivatives.hpp"
#include "model/lattice/square/family/net.hpp"
#include "tests/support/exact_derivatives.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/random_nets.hpp"

namespace kinetix::bench {
namespace {

Figure closure() {
  std::mt19937 random(1);
  double worst = 0, worst_axis = 0;
  int sheets = 0;
  for (const model::Family family : {model::Family::F1, model::Family::F2, model::Family::F3})
    for (const int columns : {1, 2, 5, 17, 40, 100})
      for (const int rows : {1, 3, 10, 100})
        for (int repeat = 0; repeat < 5; ++repeat, ++sheets) {
          const auto design = testing::random_design(family, columns, rows, random);
          const model::Structure structure = testing::structure_of(design);
          const model::HingeGaps gaps = hinge_gaps(structure, fold(design, structure));
          worst = std::max(worst, gaps.max);
          worst_axis = std::max(worst_axis, gaps.axis_max);
        }
  return {fmt::format("loop closure, {} random F1, F2, F3 sheets, 1x1 to 100x100, any theta", sheets),
          "<= 1e-12 cell edges", fmt::format("{:.1e} (axes {:.1e} rad)", worst, worst_axis), worst <= 1e-12};
}

Figure net_closure() {
  std::mt19937 random(1);
  double worst = 0, worst_axis = 0;
  constexpr int nets = 300;
  for (int k = 0; k < nets; ++k) {
    const model::Structure net = testing::random_net(5 + k, random);
    const model::NetTree tree = make_net_tree(net);
    for (const double theta : {-1.2, -0.3, 1e-6, 0.4, 0.78, 1.5}) {
      const model::HingeGaps gaps = hinge_gaps(net, fold_net(tree, net, theta));
      worst = std::max(worst, gaps.max);
      worst_axis = std::max(worst_axis, gaps.axis_max);
    }
  }
  return {
      fmt::format("net closure (F4), {} random nets of 5 to {} cells, theta -69 to 86 deg", nets, 4 + nets),
      "<= 1e-12 cell edges", fmt::format("{:.1e} (axes {:.1e} rad)", worst, worst_axis), worst <= 1e-12};
}

model::ExactDesign<double> strip(int columns) {
  std::mt19937 random(2);
  return testing::random_design(model::Family::F3, columns, 1, random);
}

Figure state_time() {
  auto design = strip(40);
  model::State poses;
  const double t = median_seconds(21, 2000, [&] {
    design.theta += 1e-9;
    fold(design, 8.0, poses);
  });
  return {"one state of a 40-column strip (82 bodies)", "<= 5 us", fmt::format("{:.2f} us", 1e6 * t),
          t <= 5e-6};
}

Figure jacobian_time() {
  auto design = strip(40);
  model::State poses;
  model::ExactJacobian jacobian;
  const double t = median_seconds(21, 500, [&] {
    design.theta += 1e-9;
    fold_with_jacobian(design, 8.0, poses, jacobian);
  });
  return {fmt::format("its state and full Jacobian ({} parameters)", jacobian.parameters()), "<= 50 us",
          fmt::format("{:.2f} us", 1e6 * t), t <= 50e-6};
}

/// A design in every lane. @param turned rad, by which theta differs from lane to lane
model::ExactDesign<model::Lanes> in_lanes(const model::ExactDesign<double>& design, double turned) {
  auto out = model::ExactDesign<model::Lanes>::basic(design.columns(), design.rows());
  std::copy(design.beta.begin(), design.beta.end(), out.beta.begin());
  std::copy(design.t.begin(), design.t.end(), out.t.begin());
  std::copy(design.s.begin(), design.s.end(), out.s.begin());
  out.gamma = design.gamma;
  for (int lane = 0; lane < model::Lanes::count; ++lane) out.theta.set(lane, design.theta + lane * turned);
  return out;
}

/// Times a thousand designs as a batch has them, on one core: state, then the pass back, one design per lane.
Figure gradient_time() {
  constexpr int designs = 1000;
  std::vector<model::ExactDesign<model::Lanes>> batch(designs / model::Lanes::count,
                                                      in_lanes(strip(40), 1e-6));
  std::vector<model::PoseOf<model::Lanes>> poses;
  fold(batch[0], 8.0, poses);
  Eigen::Matrix<model::Lanes, Eigen::Dynamic, 1> by_state(6 * static_cast<Eigen::Index>(poses.size()));
  for (Eigen::Index k = 0; k < by_state.size(); ++k) by_state[k] = 1e-3 * static_cast<double>(k);
  model::ExactDesign<model::Lanes> gradient;
  const double t = median_seconds(21, 2,
                                  [&] {
                                    for (const auto& design : batch) {
                                      fold(design, 8.0, poses);
                                      fold_gradient(design, 8.0, poses, by_state, gradient);
                                    }
                                  }) /
                   designs;
  return {"state and gradient of a function of it by all 83 parameters, each of 1000 such strips",
          "<= 2.5 us", fmt::format("{:.2f} us", 1e6 * t), t <= 2.5e-6};
}

/// Compares the Jacobian (tilts, gamma and theta) from dual numbers with the analytic one, as a ratio of times.
Figure dual_number_ratio() {
  using Jet = ceres::Jet<double, 42>;
  const auto design = strip(40);
  auto dual = model::ExactDesign<Jet>::basic(40, 1);
  for (int c = 0; c < 40; ++c) dual.beta[c] = Jet(design.beta[c], c);
  dual.gamma = Jet(design.gamma, 40);
  dual.theta = Jet(design.theta, 41);
  std::vector<model::PoseOf<Jet>> dual_poses;
  model::State poses;
  model::ExactJacobian jacobian;
  const double by_jets = median_seconds(21, 20, [&] { fold(dual, 8.0, dual_poses); });
  const double analytic = median_seconds(21, 200, [&] { fold_with_jacobian(design, 8.0, poses, jacobian); });
  return {"analytic Jacobian against dual numbers through the same recursion", "-",
          fmt::format("{:.0f} times faster", by_jets / analytic), by_jets > analytic};
}

Figure derivatives() {
  std::mt19937 random(3);
  double worst = 0;
  int designs = 0;
  for (const model::Family family : {model::Family::F1, model::Family::F2, model::Family::F3})
    for (const double theta : {0.0, 1e-9, 1e-4, 0.1, 0.5, 0.76})
      for (int repeat = 0; repeat < 5; ++repeat, ++designs) {
        auto design = testing::random_design(family, 12, 2, random);
        design.theta = theta;
        design.beta[repeat] = 0;
        worst = std::max(worst, testing::jacobian_mismatch(design, 8.0));
      }
  return {fmt::format(
              "derivatives against central differences, {} random designs, beta = 0 and theta = 0 among them",
              designs),
          "<= 1e-7 relative", fmt::format("{:.1e}", worst), worst <= 1e-7};
}

}  // namespace

std::vector<Figure> model_figures() {
  return {closure(),       net_closure(),       state_time(), jacobian_time(),
          gradient_time(), dual_number_ratio(), derivatives()};
}

}  // namespace kinetix::bench
