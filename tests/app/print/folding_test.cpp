#include <fmt/format.h>
#include <cstdlib>
#include <iostream>
#include <random>

#include "app/print/export_command.hpp"
#include "app/print/fit.hpp"
#include "app/print/sheet/path_clearance.hpp"
#include "app/print/sheet/print_path.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/print/folding_judge.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;

constexpr double step_rad =
    0.01 * radians_per_degree;       // rad: parts move by less than a micrometre per mm in a step
constexpr double allowed_mm = 0.01;  // mm: files store floats, and no printer is more accurate

struct Judged {
  std::string refused;  // empty: the design was exported
  Crossing crossing;
};

/// Interpolates the states of a path, whose thetas are unevenly spaced.
model::State between(const app::PrintPath& path, double part) {
  const auto last = static_cast<double>(path.states.size() - 1);
  const auto k = static_cast<std::size_t>(std::min(std::floor(part * last), last - 1));
  const double along = part * last - static_cast<double>(k);
  model::State out = path.states[k];
  for (std::size_t b = 0; b < out.size(); ++b) {
    const model::Pose& next = path.states[k + 1][b];
    out[b].p += along * (next.p - out[b].p);
    out[b].R = Eigen::Quaterniond(out[b].R).slerp(along, Eigen::Quaterniond(next.R)).toRotationMatrix();
  }
  return out;
}

app::PrintRequest request_of(const std::string& process, const std::string& hinge = "") {
  app::PrintRequest request;
  request.process = process;
  request.hinge = hinge;
  return request;
}

/// Exports a design and folds the written meshes.
Judged judged(const app::Design& design, const app::PrintRequest& asked) {
  const Scratch scratch;
  app::PrintRequest request = asked;
  request.formats = {"glb"};
  try {
    export_design(design, request, scratch / "out");
  } catch (const InvalidInput& e) {
    return {e.reason(), {}};
  }
  const std::string glb = text_of(scratch / ("out/" + design.name + ".glb"));
  const double edge = design.structure.size().edge_mm,
               scale = request.cell_mm > 0 ? request.cell_mm / edge : 1;
  const model::ExactMotion exact = exact_motion(design.structure);
  const int steps = static_cast<int>(std::ceil(std::abs(design.theta) / step_rad)) + 1;
  const auto share = [&](int k) { return steps > 1 ? static_cast<double>(k) / (steps - 1) : 0.0; };
  if (exact)
    return {"", fold_and_compare(
                    glb, steps,
                    [&](int k) { return app::with_edge({exact.at(design.theta * share(k))}, scale).front(); },
                    allowed_mm)};
  const app::PrintPath path = app::print_path(design);
  if (path.states.size() < 2) return {path.flat_only_reason, {}};
  return {"", fold_and_compare(
                  glb, steps,
                  [&](int k) { return app::with_edge({between(path, share(k))}, edge * scale).front(); },
                  allowed_mm)};
}

app::Design design_of(const model::Structure& squares, double theta, const std::string& name) {
  app::Design design;
  design.name = name;
  design.structure = squares;
  design.theta = theta;
  return design;
}

app::Design read(const std::string& text, const std::string& name) {
  const Scratch scratch;
  app::Design design = app::read_design(scratch.write(name + ".yaml", text));
  design.name = name;
  return design;
}

/// Returns a strip of alternating bending and shearing columns. It winds into a helix whose turns pass each other.
app::Design helix(int columns, double t, double beta_deg, double theta_deg, double height_mm,
                  double thickness_mm = 0.8) {
  auto design = model::ExactDesign<double>::basic(columns, 1);
  for (int c = 0; c < columns; ++c)
    (c % 2 == 0 ? design.t[c] : design.beta[c]) = c % 2 == 0 ? t : beta_deg * radians_per_degree;
  return design_of(structure_of(design, {10, thickness_mm, height_mm}), theta_deg * radians_per_degree,
                   "helix");
}

/// Returns the reason why no print of a design is prepared. Empty if one is.
std::string refusal(app::Design design, const std::string& process, model::HingeKind kind) try {
  // A larger cell is searched up to 100 times the design's cell. That search is not tested here and ends at once.
  const app::PrintChoice choice{.kind = kind, .edge_mm = design.structure.size().edge_mm};
  design.structure.squares()->size.edge_mm /= 100;
  prepared(design, *model::find_process(process), choice, false);
  return "";
} catch (const InvalidInput& e) {
  return e.what();
}

/// Regression: exported plates of such a helix overlapped by 1.1 mm between two of twenty steps, and were free in all
/// of these steps.
TEST(Folding, HelicesWhoseTurnsCrossBetweenTwoStepsAreRefused) {
  const auto expect_named = [](const app::Design& design, const char* process, model::HingeKind kind) {
    const std::string why = refusal(design, process, kind);
    EXPECT_THAT(why, HasSubstr("from a fold angle of")) << design.theta;
    EXPECT_TRUE(why.find("run into each other") != std::string::npos ||
                why.find("come nearer") != std::string::npos)
        << why;
  };
  expect_named(helix(24, 0.35, 35, 25.325, 3), "polyjet", model::HingeKind::pin);
  expect_named(helix(24, 0.35, 35, 25.325, 3), "polyjet", model::HingeKind::block);
  expect_named(helix(24, 0.35, -35, 25.325, 3), "sla", model::HingeKind::pin);
  expect_named(helix(26, 0.35, 35, 25.5, 3, 1), "polyjet", model::HingeKind::block);
}

/// The first theta of the message agrees with the meshes within 0.1 degrees.
TEST(Folding, RefusalNamesThePartsAndWhereTheyMeet) {
  const app::Design design = helix(24, 0.35, 35, 25.325, 3);
  const std::string why = refusal(design, "polyjet", model::HingeKind::block);
  double theta_deg = 0;
  const auto at = why.find("from a fold angle of ");
  ASSERT_NE(at, std::string::npos) << why;
  theta_deg = std::stod(why.substr(at + 21));
  app::Design before = design;
  before.theta = (theta_deg - 0.2) * radians_per_degree;
  const Judged free = judged(before, request_of("polyjet", "block"));
  EXPECT_EQ(free.refused, "");
  EXPECT_LE(free.crossing.mm, allowed_mm) << free.crossing.first << free.crossing.second;
}

/// Alternates between sheets with and without a closed form.
app::Design random_sheet(std::mt19937& random, int k) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const std::string name = "sheet" + std::to_string(k);
  const model::CellSize size{uniform(8, 20), uniform(0.8, 1.6), uniform(3, 10)};
  const auto plain = [&](const std::string& lattice) {
    return read(fmt::format("kinetix: 1\nstructure: {{lattice: {}, cells: [{}, {}], cell_mm: {}, wall_mm: "
                            "{{thickness: {}, height: {}}}}}\ndesign: {{theta_deg: {}}}\n",
                            lattice, whole(2, 3), whole(2, 3), size.edge_mm, size.thickness_mm,
                            size.height_mm, uniform(-40, 40)),
                name);
  };
  const model::Family families[] = {model::Family::F1, model::Family::F2, model::Family::F3};
  switch (k % 8) {
    case 0: {
      app::Design design = helix(whole(14, 26), uniform(0.3, 0.45), uniform(20, 50), uniform(-35, 35),
                                 uniform(2, 6), size.thickness_mm);
      design.name = name;
      return design;
    }
    case 1:
      return plain("honeycomb");
    case 2:
      return plain("brick");
    case 3: {
      model::Structure panel = make_structure(model::rectangle(whole(2, 3), whole(1, 2)), size);
      for (model::Hinge& hinge : panel.hinges) {
        hinge.parameters.t = 0.5 + 0.03 * uniform(-1, 1);
        hinge.parameters.alpha = pi / 2 + 0.05 * uniform(-1, 1);
        hinge.parameters.beta = 0.1 * uniform(-1, 1);
      }
      return design_of(panel, uniform(-0.4, 0.4), name);
    }
    default: {
      const bool strip = k % 2 == 0;
      model::ExactDesign<double> exact =
          random_design(families[k % 3], strip ? whole(6, 14) : whole(2, 5), strip ? 1 : whole(2, 3), random);
      const double milder = uniform(0.2, 1);
      for (double& t : exact.t) t = 0.5 + milder * (t - 0.5);
      for (double& b : exact.beta) b *= milder;
      return design_of(structure_of(exact, size), exact.theta, name);
    }
  }
}

/// Exports random sheets and folds the written meshes. KINETIX_SHEETS=200 changes their number, and KINETIX_SHEET=17
/// repeats one of them.
void expect_no_crossings(int usual_count) {
  const char* const many = std::getenv("KINETIX_SHEETS");
  const char* const one = std::getenv("KINETIX_SHEET");
  const int count = one ? std::atoi(one) + 1 : many ? std::atoi(many) : usual_count;
  const char* const processes[] = {"polyjet", "sla", "sls", "fdm"};
  const char* const hinges[] = {"", "pin", "block"};
  int exported = 0, largest_tests = 0;
  double deepest = 0;
  for (int k = one ? count - 1 : 0; k < count; ++k) {
    std::mt19937 random(1000 + k);
    const app::Design design = random_sheet(random, k);
    const std::string process = processes[random() % 4];
    const app::PrintRequest request = request_of(process, hinges[random() % 3]);
    const Judged found = judged(design, request);
    if (many || one)
      std::cout << k << ": theta " << design.theta / radians_per_degree << ", " << request.process << ", "
                << request.hinge << ": "
                << (found.refused.empty()
                        ? fmt::format("exported, {} mm, {} tests", found.crossing.mm, found.crossing.tests)
                        : found.refused)
                << std::endl;
    exported += found.refused.empty();
    largest_tests = std::max(largest_tests, found.crossing.tests);
    deepest = std::max(deepest, found.crossing.mm);
    EXPECT_LE(found.crossing.mm, allowed_mm)
        << "sheet " << k << ", theta " << design.theta / radians_per_degree << ", " << request.process << ": "
        << found.crossing.first << " and " << found.crossing.second << " at step " << found.crossing.step;
    if (request.hinge.empty()) {
      app::Design printed = design;
      printed.process = *model::find_process(process);
      const app::PrintAnswer answer = answer_of_export(printed);
      EXPECT_EQ(answer.is_accepted, found.refused.empty())
          << "sheet " << k << ": " << answer.why << found.refused;
      EXPECT_EQ(answer.why.empty(), answer.is_accepted) << "sheet " << k;
    }
  }
  ::testing::Test::RecordProperty("exported", exported);
  if (many) std::cout << exported << " of " << count << " exported, deepest " << deepest << " mm\n";
  if (one) return;
  EXPECT_GE(exported, count / 4) << "else little was judged";
  EXPECT_GT(largest_tests, 0);
}

TEST(Folding, NoExportOfRandomSheetsCrosses) { expect_no_crossings(6); }

/// Tests eight times as many sheets.
TEST(FoldingSoak, NoExportOfManyRandomSheetsCrosses) { expect_no_crossings(48); }

/// The judge detects a crossing and its depth in the design's own solids, without `--cell-mm`.
TEST(Folding, JudgeSeesWhatTheExporterIsNotAskedAbout) {
  const Scratch scratch;
  const app::Design design = read(panel, "panel");
  app::PrintRequest request = request_of("polyjet", "block");
  request.formats = {"glb"};
  ASSERT_NO_THROW(export_design(design, request, scratch / "out"));
  const model::ExactMotion exact = exact_motion(design.structure);
  const Crossing beyond = fold_and_compare(
      text_of(scratch / "out/panel.glb"), 400, [&](int k) { return exact.at(k * 0.2 * radians_per_degree); },
      0.3);
  EXPECT_GT(beyond.mm, 0.3) << "cells of a basic panel close at 45 degrees";
  EXPECT_GT(beyond.step * 0.2, 30);
  EXPECT_LT(beyond.step * 0.2, 60);
}

}  // namespace
}  // namespace kinetix::testing
