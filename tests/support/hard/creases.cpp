#include <algorithm>
#include <cmath>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/hinge/crease_law.hpp"
#include "model/lattice/origami/origami_sheet.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/miura.hpp"
#include "tests/support/random_mesh.hpp"

namespace kinetix::testing {
namespace {

using model::PlanarStructure;
using Stop = model::EquilibriumPath::Stop;

// Each facet follows from the one before along some ten creases, and each crease adds its rounding.
constexpr double crease_closure = 1e-11;                  // cell edges, rad
constexpr double fold_probes[] = {1e-9, 0.4, 1.2, -0.7};  // rad

/// The largest part of the closure equations, and where another method stands apart.
struct CreasedCheck {
  double closure = INFINITY, apart = 0;
  int freedoms = 0;
  std::string why;
};

CreasedCheck checked(const PlanarStructure& s, const std::function<model::State(double)>& other = {}) {
  const model::ExactMotion exact = exact_motion(s);
  if (!exact) return {INFINITY, INFINITY, 0, exact.why};
  CreasedCheck out{0, 0, model::null_space(s, exact.at(0.4)).dofs(), {}};
  for (const double theta : fold_probes) {
    out.closure = std::max(out.closure, closure_residual(s, exact.at(theta)).cwiseAbs().maxCoeff());
    if (other) out.apart = std::max(out.apart, aligned_distance(s, exact.at(theta), other(theta)).max);
  }
  return out;
}

HardAnswer folds_exactly(const PlanarStructure& s, const std::function<model::State(double)>& other = {}) {
  const CreasedCheck c = checked(s, other);
  HardAnswer a = closed_to(std::max(c.closure, c.apart), crease_closure, "closure and other method to");
  a.exact += text(", %d freedoms", c.freedoms) + c.why;
  if (c.freedoms != 1) a.mark = HardAnswer::Mark::wrong;
  return a;
}

HardAnswer fold_mesh(const model::QuadMesh& mesh) {
  const model::OrigamiSheet sheet = origami_sheet(mesh, {});
  return folds_exactly(sheet.structure, [&](double theta) { return fold(sheet, theta); });
}

model::QuadMesh miura_mesh(int facets, double angle, double multiplier) {
  return march(model::miura(facets, facets, angle, multiplier)).mesh;
}

const char* fold_requirement = "closure equations and the frames of facets to 1e-11; one freedom";

void add_miura(HardCases& cases) {
  for (const double off : {44.9, 1.0, 1e-3, 1e-6})
    cases.push_back({text("4x4 Miura sheet, sectors of 90 deg -+ %g deg", off), fold_requirement,
                     [=] { return fold_mesh(miura_mesh(4, (90 - off) * deg, 1)); }});
  for (const double multiplier : {1e-3, 1e-6, 1e2, 1e4})
    cases.push_back({text("4x4 Miura sheet of 75 deg, fold multiplier %g", multiplier), fold_requirement,
                     [=] { return fold_mesh(miura_mesh(4, 75 * deg, multiplier)); }});
  for (const double angle : {45.5, 89.0})
    cases.push_back({text("Miura's pattern on 6x6 hexagons, %g deg between creases", angle),
                     "closure equations to 1e-11; one freedom",
                     [=] { return folds_exactly(miura_of_hexagons(6, 6, angle * deg, 0.9)); }});
  cases.push_back({"6x6 facets at random, edges by 10 %, angles by 5 %", fold_requirement, [] {
                     std::mt19937 random(31);
                     return fold_mesh(random_mesh(6, 6, 0.1, random).mesh);
                   }});
  cases.push_back({"rhombi of 30 deg with two creases of multipliers 0.8 and -1.7",
                   "closure equations to 1e-11; one freedom",
                   [] { return folds_exactly(creased_rhombi(5, 4, 30 * deg)); }});
}

/// Checks how far vertices rise, over theta: near flat this is a constant of the sheet.
HardAnswer fold_hardly(double theta) {
  const PlanarStructure s = miura_of_hexagons(4, 4, 60 * deg, 0.9);
  const model::ExactMotion exact = exact_motion(s);
  const auto rise = [&](double at) {
    std::vector<double> out;
    for (const model::Pose& pose : exact.at(at)) out.push_back(pose.p.z() / (s.size.edge_mm * at));
    return out;
  };
  const auto small = rise(theta), usual = rise(1e-4);
  double worst = 0, most = 0;
  for (std::size_t b = 0; b < small.size(); ++b) {
    worst = std::max(worst, std::abs(small[b] - usual[b]));
    most = std::max(most, std::abs(usual[b]));
  }
  HardAnswer a = closed_to(worst / most, 1e-6, text("rises by %.4g theta, to", most));
  if (!(most > 0.1)) a.mark = HardAnswer::Mark::wrong;
  return a;
}

/// @param by part by which the straight creases miss their multiplier
PlanarStructure crooked_miura(double by) {
  PlanarStructure s = miura_of_hexagons(4, 4, 60 * deg, 0.9);
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    if (std::abs(s.graph.along(static_cast<int>(h)).x()) < 1e-9)
      s.hinges[h].beta = std::atan((1 + by) * std::tan(s.hinges[h].beta));
  return s;
}

HardAnswer refuse_crooked(double by) {
  const PlanarStructure s = crooked_miura(by);
  const model::ExactMotion exact = exact_motion(s);
  const model::Mobility m = mobility(s, exact);
  return check_distinct(!exact && exact.why.find("no flat-foldable vertex") != std::string::npos &&
                            m.verdict != model::Verdict::mobile,
                        exact.why, to_string(m.verdict) + ": " + m.why);
}

/// Files have six digits: up to 1e-4 rad a reader takes a mesh, and the sheet must still not pass for exact.
HardAnswer refuse_moved_vertex(double by) {
  model::QuadMesh mesh = miura_mesh(4, 75 * deg, 1);
  mesh.at(2, 2).x() += by;
  try {
    const model::OrigamiSheet sheet = origami_sheet(mesh, {});
    const model::ExactMotion exact = exact_motion(sheet.structure);
    return check_distinct(!exact, exact ? exact.name + " although it does not close" : exact.why, "");
  } catch (const InvalidInput& e) {
    return check_distinct(std::string(e.what()).find("not flat-foldable") != std::string::npos, "",
                          std::string("refused: ") + e.what());
  }
}

HardAnswer refuse_narrow(double angle) {
  try {
    origami_sheet(miura_mesh(4, angle, 1), {});
  } catch (const InvalidInput& e) {
    return check_distinct(std::string(e.what()).find("too uneven") != std::string::npos, "",
                          std::string("refused: ") + e.what());
  }
  return check_distinct(false, "", "accepted");
}

/// Rows across the folds of a sheet bend by a share of a cell that no unit of length changes.
HardAnswer refuse_bent_rows(double edge_mm) {
  PlanarStructure s = miura_of_hexagons(4, 4, 60 * deg, 0.01);
  s.size = {edge_mm, 0.08 * edge_mm, 0.6 * edge_mm};
  const model::ExactMotion exact = exact_motion(s);
  try {
    const double theta = exact.theta_of(plate_drive(s, model::Axis::y, 0.1, 1));
    return check_distinct(false, exact.why, text("taken to theta %g", theta));
  } catch (const InvalidInput& e) {
    return check_distinct(std::string(e.what()).find("would keep rows straight") != std::string::npos,
                          exact.name, std::string("refused: ") + e.what());
  }
}

void add_refused(HardCases& cases) {
  for (const double theta : {1e-6, 1e-9})
    cases.push_back({text("Miura's pattern on 4x4 hexagons, theta = %g", theta),
                     "rises in proportion to theta, to 1e-6", [=] { return fold_hardly(theta); }});
  for (const double by : {1e-1, 1e-4, 1e-7})
    cases.push_back({text("Miura's pattern on 4x4 hexagons, one line's multipliers off by %g", by),
                     "no closed form, by the vertex that does not fold; not mobile",
                     [=] { return refuse_crooked(by); }});
  for (const double by : {1e-3, 5e-5, 1e-7})
    cases.push_back({text("4x4 Miura sheet, one vertex off by %g", by),
                     "refused as not flat-foldable, or no closed form",
                     [=] { return refuse_moved_vertex(by); }});
  for (const double angle : {5.0, 20 - 1e-6})
    cases.push_back({text("4x4 Miura sheet, sectors of %.8g deg", angle),
                     "refused: bodies are round a vertex from 20 deg on",
                     [=] { return refuse_narrow(angle * deg); }});
}

/// A sheet folded by a hinge inside a facet.
LinkageScene folding_scene(const PlanarStructure& s, double theta, double ratio) {
  model::LinkageDrive drive = hinge_drive(s, 0, 0.1);
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h)
    if (s.hinges[h].beta == 0) {
      drive = hinge_drive(s, h, model::turn_at_theta(s.senses[s.graph.edges[h].from], theta));
      break;
    }
  return {{s, drive, exact_motion(s)}, of_ratio(ratio)};
}

HardAnswer fold_softly(const PlanarStructure& s, double theta) {
  return follow_softly([&](double ratio) { return folding_scene(s, theta, ratio); }, theta);
}

void add_elastic(HardCases& cases) {
  cases.push_back({"Miura's pattern on 3x3 hexagons, hinge to theta = 30 deg, stiffness ratio 1e8",
                   expected_first_order,
                   [] { return fold_softly(miura_of_hexagons(3, 3, 60 * deg, 0.9), 30 * deg); }});
  cases.push_back(
      {"2x2 Miura sheet of 60 deg, hinge to theta = 60 deg, stiffness ratio 1e8", expected_first_order,
       [] { return fold_softly(origami_sheet(miura_mesh(2, 60 * deg, 1), {}).structure, 60 * deg); }});
  cases.push_back({"3x3 random quads with a crease, hinge to theta = 60 deg, stiffness ratio 1e8",
                   expected_first_order, [] { return fold_softly(creased_quads(3, 2), 60 * deg); }});
  cases.push_back(
      {"Miura's pattern on 4x4 hexagons, one line's multipliers off by 0.1, hinge to theta = 20 deg",
       "work is energy to 1e-3",
       [] { return follow_strained(folding_scene(crooked_miura(0.1), 20 * deg, 1e-4), 1e-3); }});
  for (const double edge : {10.0, 1e-3, 1e-6})
    cases.push_back({text("Miura's pattern on 4x4 hexagons that hardly folds, plates, cells of %g mm", edge),
                     "refused: rows bend", [=] { return refuse_bent_rows(edge); }});
}

}  // namespace

HardCases crease_cases() {
  HardCases cases;
  add_miura(cases);
  add_refused(cases);
  add_elastic(cases);
  return cases;
}

}  // namespace kinetix::testing
