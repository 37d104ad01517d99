#include <limits>

#include "model/invalid_input.hpp"
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

void follow(const Structure& structure, const Elasticity& elasticity = {}, double theta = 0.3) {
  follow_load(structure, elasticity, plates_drive(Axis::y, theta));
}

Structure small_panel() { return make_structure(rectangle(2, 2), {}); }

HardCase bad_stiffness(const char* name, double Elasticity::*field) {
  return refused(name, std::string(name) + " is ", {0.0, -1.0, nan, inf, 1e-300, 1e300}, [=](double value) {
    Elasticity elasticity;
    elasticity.*field = value;
    follow(small_panel(), elasticity);
  });
}

HardCase bad_hinge(const char* name, double HingeParameters::*field, const std::vector<double>& values) {
  return refused(name, std::string(name) + " of the hinge on wall [[1, 0], [1, 1]] is ", values,
                 [=](double value) {
                   Structure s = small_panel();
                   s.hinges[*s.hinge_at({{1, 0}, Axis::y})].parameters.*field = value;
                   follow(s);
                 });
}

void add_walls(HardCases& cases) {
  cases.push_back(refused("walls in a cell of 10 mm, thickness", "wall thickness", {0.0, 5.0, 12.0, nan},
                          [](double thickness) {
                            make_structure(rectangle(1, 1), {10, thickness, 6});
                          }));
  cases.push_back(
      refused("walls tilted by 85 deg, height", "overlap in the flat state", {12.0, 40.0}, [](double height) {
        Structure s = alternating(4, 2, {.beta = 85 * deg}, basic_unit);
        s.size.height_mm = height;
        follow(s);
      }));
  cases.push_back(refused("walls 0.8 mm thick in a cell of 10 mm, hinges at t =", "overlap in the flat state",
                          {1e-3, 0.03, 0.97, 1 - 1e-3}, [](double t) { follow(crossable_grid(t, 3, 3)); }));
  cases.push_back(refused("the same cell, times", "cell [0, 0] is given twice", {2.0}, [](double) {
    make_structure({{0, 0}, {1, 0}, {0, 0}}, {});
  }));
}

void add_drives(HardCases& cases) {
  cases.push_back(refused("a drive on the wall of a hinge that is not there, in column", "is not a wall",
                          {7.0, -1.0}, [](double column) {
                            const Wall wall{{static_cast<int>(column), 0}, Axis::x};
                            follow_load(small_panel(), {}, hinge_drive(wall, 0.3));
                          }));
  cases.push_back(refused("plates to a compression of", "must be in [0, 1)", {-0.1, 1.0, 1.5, nan},
                          [](double compression) {
                            Drive drive;
                            drive.compression = compression;
                            follow_load(small_panel(), {}, drive);
                          }));
}

}  // namespace

HardCases input_cases() {
  HardCases cases = {bad_stiffness("k_point", &Elasticity::k_point),
                     bad_stiffness("k_turn", &Elasticity::k_turn),
                     bad_stiffness("reach_mm", &Elasticity::reach_mm),
                     bad_stiffness("k_contact", &Elasticity::k_contact),
                     bad_hinge("t", &HingeParameters::t, {0.0, 1.0, -0.5, nan}),
                     bad_hinge("alpha", &HingeParameters::alpha, {0.0, pi, nan}),
                     bad_hinge("beta", &HingeParameters::beta, {-pi / 2, pi / 2, inf, nan})};
  add_walls(cases);
  add_drives(cases);
  return cases;
}

}  // namespace kinetix::testing
