#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "app/files/design_file.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/contact/certified_range.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::bench {
namespace {

const char* const shapes = KINETIX_SHAPES;
constexpr double near_enough = 0.01;               // of the true range: what was asked for
constexpr double sample = 1 * radians_per_degree;  // between the states that theta_range looks at

struct Proven {
  model::ContactRange range;
  double time = 0;  ///< s
};

Proven prove(const model::Lattice& sheet) {
  const model::Linkage linkage = sheet;
  const model::ExactMotion exact = exact_motion(sheet);
  const std::vector<model::TurnLaw> laws = turn_laws(sheet);
  Proven out;
  out.time = seconds([&] { out.range = certified_range(linkage, exact, laws); });
  return out;
}

/// Returns the gap between the certified end and an overlap beyond it, as a fraction of theta; 1 if no overlap was
/// seen.
double bracket(const model::ContactLimit& limit) {
  if (!limit.touches) return 0;
  return limit.contact ? 1 - limit.theta / *limit.contact : 1;
}

double bracket(const model::ContactRange& range) {
  return range ? std::max(bracket(range.negative), bracket(range.positive)) : 1;
}

Figure basic_cells() {
  double most = 0;
  for (const double thickness : {0.1, 0.8, 2.0, 4.0}) {
    const Proven proven = prove(make_structure(model::rectangle(4, 4), {10, thickness, 6}));
    const double closed = std::atan(1 - thickness / 10);
    most = std::max({most, std::abs(closed - proven.range.positive.theta) / closed, bracket(proven.range)});
  }
  return {"range free of contact, proven: basic cells against tan(theta) = 1 - thickness / edge", "<= 1 %",
          fmt::format("{:.1e} of it", most), most <= near_enough};
}

/// Returns the sheet of a shipped file: the result of the search for a target, or the design.
model::Lattice shipped_sheet(const std::string& file, bool is_design) {
  if (is_design) return app::read_design(file).structure;
  return run_goal(*app::read_target(file).goal, {.verify = false, .certify = false}).design.structure;
}

Figure shipped(const std::string& name, bool is_design = false) {
  const model::Lattice sheet = shipped_sheet(std::string(shapes) + "/" + name + ".yaml", is_design);
  const std::string what = fmt::format("range free of contact, proven: {}, {} bodies", name, sheet.bodies());
  const model::ExactMotion exact = exact_motion(sheet);
  if (!exact) return {what, "said that there is no closed form", exact.why, !exact.why.empty()};
  const Proven proven = prove(sheet);
  const double off = bracket(proven.range);
  const double beyond = theta_range(sheet, exact).positive.theta;
  const bool missed = proven.range.positive.theta + sample < beyond;
  return {what, "<= 1 % from walls that overlap",
          fmt::format("theta {:.2f} to {:.2f} deg, {:.1e} from overlap{}, {:.2g} s",
                      to_degrees(proven.range.negative.theta), to_degrees(proven.range.positive.theta), off,
                      missed ? fmt::format(", samples say {:.2f} deg", to_degrees(beyond)) : "", proven.time),
          proven.range && off <= near_enough};
}

/// Proves a strip with columns that bend and columns that shear in turns.
Figure helix() {
  auto design = model::ExactDesign<double>::basic(24, 1);
  for (int c = 0; c < 24; c += 2) {
    design.beta[c] = 35 * radians_per_degree;
    design.t[c + 1] = 0.35;
  }
  const model::Structure s = testing::structure_of(design, {10, 0.8, 2});
  const Proven proven = prove(s);
  const double sampled = theta_range(s, exact_motion(s)).positive.theta;
  return {"range free of contact, proven: turns of a helix that brush past each other between samples",
          "below what samples a degree apart say",
          fmt::format("{:.2f} deg, samples say {:.2f} deg, {:.2g} s", to_degrees(proven.range.positive.theta),
                      to_degrees(sampled), proven.time),
          proven.range.positive.theta < sampled && bracket(proven.range) <= near_enough};
}

Figure large_panel() {
  const Proven proven = prove(make_structure(model::rectangle(100, 100), {}));
  return {"range free of contact, proven: basic panel of 100 x 100 cells", "<= 1 %",
          fmt::format("{:.1e} from overlap, {} states, {:.2g} s", bracket(proven.range), proven.range.states,
                      proven.time),
          bracket(proven.range) <= near_enough};
}

}  // namespace

std::vector<Figure> certified_figures() {
  std::vector<Figure> all = {basic_cells(), helix(), large_panel()};
  for (const char* name :
       {"helmet_rib",   "half_circle",     "spiral",     "helix",           "trefoil_arc",    "cube",
        "box_with_lid", "icosahedron",     "headform",   "letter_t",        "disc",           "cap",
        "vase",         "shrinking_block", "rubber_rib", "rubber_t",        "honeycomb_t",    "saddle",
        "stool",        "tetrahedron",     "octahedron", "open_tray",       "tray_in_mm",     "word",
        "s_curve",      "handle",          "heart",      "spectacle_frame", "square_to_disc", "qr_code",
        "circle"})
    all.push_back(shipped(name));
  for (const char* name : {"miura", "rosette"}) all.push_back(shipped(name, true));
  return all;
}

}  // namespace kinetix::bench
