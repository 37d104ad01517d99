#include <cmath>
#include <limits>

#include "model/invalid_input.hpp"
#include "tests/support/hard/kit.hpp"

namespace kinetix::testing {
namespace {

using Mark = HardAnswer::Mark;

/// Refused, with every word asked for in the message.
HardCase refused(std::string name, std::string words, std::function<void()> use) {
  return {std::move(name), "refused, with: " + words, [=]() -> HardAnswer {
            try {
              use();
            } catch (const InvalidInput& e) {
              const bool says = std::string(e.what()).find(words) != std::string::npos;
              return {says ? Mark::diagnosed : Mark::wrong, "", std::string("refused: ") + e.what(), {}};
            }
            return {Mark::wrong, "", "accepted", {}};
          }};
}

void follow(const Elasticity& elasticity, const Drive& drive) {
  follow_load(make_structure(rectangle(2, 2), {}), elasticity, drive);
}

void add_stiffnesses(HardCases& cases) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  const std::pair<const char*, double Elasticity::*> fields[] = {{"k_point", &Elasticity::k_point},
                                                                 {"k_turn", &Elasticity::k_turn},
                                                                 {"reach_mm", &Elasticity::reach_mm},
                                                                 {"k_contact", &Elasticity::k_contact}};
  for (const auto& [name, field] : fields)
    for (const double value : {0.0, -1.0, nan, inf})
      cases.push_back(refused(text("%s = %g", name, value),
                              text("%s is %g, must be positive and finite", name, value),
                              [field = field, value] {
                                Elasticity elasticity;
                                elasticity.*field = value;
                                follow(elasticity, plates_drive(Axis::y, 0.3));
                              }));
}

void add_walls(HardCases& cases) {
  for (const double thickness : {0.0, 5.0, 12.0})
    cases.push_back(refused(text("walls %g mm thick in a cell of 10 mm", thickness), "wall thickness", [=] {
      make_structure(rectangle(1, 1), {10, thickness, 6});
    }));
  cases.push_back(refused("a cell given twice", "cell [0, 0] is given twice", [] {
    make_structure({{0, 0}, {1, 0}, {0, 0}}, {});
  }));
}

void add_drives(HardCases& cases) {
  cases.push_back(
      refused("a drive on a hinge that is not there", "drive.wall [[7, 0], [8, 0]] is not a wall", [] {
        follow({}, hinge_drive({{7, 0}, Axis::x}, 0.3));
      }));
  for (const double compression : {-0.1, 1.0, 1.5}) {
    Drive drive;
    drive.compression = compression;
    cases.push_back(refused(text("plates to a compression of %g", compression), "must be in [0, 1)",
                            [=] { follow({}, drive); }));
  }
}

}  // namespace

HardCases input_cases() {
  HardCases cases;
  add_stiffnesses(cases);
  add_walls(cases);
  add_drives(cases);
  return cases;
}

}  // namespace kinetix::testing
