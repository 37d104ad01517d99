#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

HardCase large(std::string name, std::function<Structure()> make, double allowed) {
  HardCase c = closed_form_case(
      std::move(name),
      [=] {
        const Structure s = make();
        return HardScene{s, drive_to(s, 30 * deg), of_ratio(1e-6)};
      },
      allowed);
  c.in_tests = false;
  return c;
}

Structure bending_by(double tilt) { return alternating(1000, 1, {.beta = tilt}, basic_unit); }

}  // namespace

HardCases size_cases() {
  HardCases cases;
  for (const int n : {30, 100})
    cases.push_back(large(
        text("panel of %d x %d basic cells", n, n), [=] { return make_structure(rectangle(n, n), {}); },
        1e-3));
  cases.push_back(large(
      "strip of 1000 basic cells", [] { return make_structure(rectangle(1000, 1), {}); }, 1e-2));
  cases.push_back(large(
      "strip of 1000 cells that bends by half a degree a pair", [] { return bending_by(0.5 * deg); }, 1e-2));
  return cases;
}

}  // namespace kinetix::testing
