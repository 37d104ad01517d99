#include <limits>

#include "model/base/invalid_input.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

using Mark = HardAnswer::Mark;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();

/// Every value refused, with the words asked for in the message.
HardCase refused(const std::string& name, const std::string& words, const std::vector<double>& values,
                 const std::function<void(double)>& use) {
  std::string all = name;
  for (const double value : values) all += text(&value == &values[0] ? " %g" : ", %g", value);
  return {all, "refused: " + words, [=]() -> HardAnswer {
            std::string said;
            for (const double value : values) try {
                use(value);
                return {Mark::wrong, "", text("accepted %g", value), {}};
              } catch (const InvalidInput& e) {
                said = e.what();
                if (said.find(words) == std::string::npos) return {Mark::wrong, "", said, {}};
              }
            return {Mark::diagnosed, "", "refused: " + said, {}};
          }};
}

void follow(const model::Structure& structure, const model::Elasticity& elasticity = {}, double theta = 0.3) {
  trace_equilibrium(driven(structure, plates_drive(model::Axis::y, theta)), elasticity);
}

model::Structure small_panel() { return model::make_structure(model::rectangle(2, 2), {}); }

HardCase bad_stiffness(const char* name, double model::Elasticity::*field) {
  return refused(name, std::string(name) + " is ", {0.0, -1.0, nan, inf, 1e-300, 1e300}, [=](double value) {
    model::Elasticity elasticity;
    elasticity.*field = value;
    follow(small_panel(), elasticity);
  });
}

HardCase bad_hinge(const char* name, double model::HingeParameters::*field,
                   const std::vector<double>& values) {
  return refused(name, std::string(name) + " of the hinge on wall [[1, 0], [1, 1]] is ", values,
                 [=](double value) {
                   model::Structure s = small_panel();
                   s.hinges[*s.hinge_at({{1, 0}, model::Axis::y})].parameters.*field = value;
                   follow(s);
                 });
}

void add_walls(HardCases& cases) {
  cases.push_back(refused("walls in a cell of 10 mm, thickness", "wall thickness", {0.0, 5.0, 12.0, nan},
                          [](double thickness) {
                            model::make_structure(model::rectangle(1, 1), {10, thickness, 6});
                          }));
  cases.push_back(
      refused("walls tilted by 85 deg, height", "overlap in the flat state", {12.0, 40.0}, [](double height) {
        model::Structure s = alternating(4, 2, {.beta = 85 * deg}, basic_unit);
        s.size.height_mm = height;
        follow(s);
      }));
  cases.push_back(refused("walls 0.8 mm thick in a cell of 10 mm, hinges at t =", "overlap in the flat state",
                          {1e-3, 0.03, 0.97, 1 - 1e-3}, [](double t) { follow(crossable_grid(t, 3, 3)); }));
  cases.push_back(refused("the same cell, times", "cell [0, 0] is given twice", {2.0}, [](double) {
    model::make_structure({{0, 0}, {1, 0}, {0, 0}}, {});
  }));
}

void add_drives(HardCases& cases) {
  cases.push_back(refused("a drive on the wall of a hinge that is not there, in column", "is not a wall",
                          {7.0, -1.0}, [](double column) {
                            const model::Wall wall{{static_cast<int>(column), 0}, model::Axis::x};
                            trace_equilibrium(driven(small_panel(), hinge_drive(small_panel(), wall, 0.3)),
                                              {});
                          }));
  cases.push_back(refused("plates to a compression of", "must be in [0, 1)", {-0.1, 1.0, 1.5, nan},
                          [](double compression) {
                            const model::Plates drive{.compression = compression};
                            trace_equilibrium(driven(small_panel(), drive), {});
                          }));
}

}  // namespace

HardCases input_cases() {
  HardCases cases = {bad_stiffness("k_point", &model::Elasticity::k_point),
                     bad_stiffness("k_turn", &model::Elasticity::k_turn),
                     bad_stiffness("reach_mm", &model::Elasticity::reach_mm),
                     bad_stiffness("k_contact", &model::Elasticity::k_contact),
                     bad_hinge("t", &model::HingeParameters::t, {0.0, 1.0, -0.5, nan}),
                     bad_hinge("alpha", &model::HingeParameters::alpha, {0.0, pi, nan}),
                     bad_hinge("beta", &model::HingeParameters::beta, {-pi / 2, pi / 2, inf, nan})};
  add_walls(cases);
  add_drives(cases);
  return cases;
}

}  // namespace kinetix::testing
