#include "tests/support/hard/hard_cases.hpp"

#include "tests/support/hard/kit.hpp"

namespace kinetix::testing {

std::string to_string(HardAnswer::Mark mark) {
  switch (mark) {
    case HardAnswer::Mark::right:
      return "right";
    case HardAnswer::Mark::diagnosed:
      return "diagnosed";
    case HardAnswer::Mark::wrong:
      break;
  }
  return "**wrong**";
}

HardCases hard_cases() {
  HardCases all;
  for (const auto& theme : {bifurcation_cases, range_cases, near_flat_cases, size_cases, mobility_cases,
                            wall_cases, sameness_cases, input_cases, planar_lattice_cases, crease_cases,
                            block_cases, made_hinge_cases, linkage_sameness_cases})
    for (HardCase& c : theme()) all.push_back(std::move(c));
  return all;
}

}  // namespace kinetix::testing
