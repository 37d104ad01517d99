#include "app/goals/helmet/helmet_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/files/file_header.hpp"
#include "app/files/goal_settings.hpp"
#include "app/files/structure_section.hpp"
#include "model/contact/wall_contact.hpp"
#include "targets/document/bound_key.hpp"
#include "targets/helmet/read_head.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr double share_of_coverage = 1.0 / 30;  // allowed error over coverage: 3 mm for the usual 90 mm
constexpr double helmet_cell_mm = 6;            // a tenth of a head's radius: ribs can follow its curves
constexpr int most_ribs = 200;                  // input limit: one rib per two millimetres of a head
constexpr double least_helmet_cell_mm = 1;      // for cells and rib spacing: less makes too many cells
constexpr double most_cell_mm = 60;             // about a head's radius: larger cells cannot follow it

targets::KeyTable helmet_target_keys() {
  using Spec = optim::RibsSpec;
  std::vector<targets::Key> keys = targets::head_keys();
  keys.insert(keys.begin(), targets::goal_kind_key("helmet"));
  keys.insert(
      keys.end(),
      {{"ribs", &Spec::ribs, value::integer(1, most_ribs),
        "how many there are along the spine, evenly spaced"},
       {"spacing_mm", &Spec::spacing_mm, value::number(targets::from_to(least_helmet_cell_mm, 1000, "mm")),
        targets::otherwise("follows from `ribs`"),
        "distance of the ribs instead of their number: they are as many, evenly spaced, as come "
        "nearest to it"},
       targets::coverage_key(),
       {"clearance_mm", &Spec::clearance_mm, value::number(targets::from_to(0, 100, "mm")),
        "distance of the helmet from the head"}});
  return targets::KeyTable(std::move(keys));
}

targets::KeyTable helmet_structure_keys() {
  return targets::KeyTable({cell_mm_key(targets::by_default(helmet_cell_mm),
                                        targets::from_to(least_helmet_cell_mm, most_cell_mm, "mm")),
                            wall_mm_key()});
}

void read_structure(const targets::Section& root, HelmetFile& file) {
  const auto node = root.optional("structure");
  if (const auto cells = node ? node->optional("cells") : std::nullopt)
    throw cells->key_error("the cells of a helmet follow from the head, target.ribs and structure.cell_mm");
  file.spec.size = read_size(root.section("structure"), helmet_cell_mm);
}

void read_ribs(const targets::Section& target, HelmetFile& file) {
  const auto ribs = target.optional("ribs"), spacing = target.optional("spacing_mm");
  if (ribs && spacing) throw spacing->key_error("and target.ribs say the same thing; give one of them");
  target.read_into(file.spec);
  if (spacing && *file.spec.spacing_mm < 2 * file.spec.size.edge_mm * std::cos(file.spec.start_theta))
    throw spacing->error("ribs so close overlap flat: leave two cells at least, which are " +
                         targets::shortest_text(2 * file.spec.size.edge_mm) + " mm flat");
  file.spec.coverage_mm = file.head.coverage_mm;
}

void read_variables(const targets::Section& root, optim::RibsSpec& spec) {
  const NetVariables read = read_net_variables(root, spec.size, {spec.tilt, spec.theta});
  spec.tilt = read.tilt;
  spec.theta = {read.theta.lower, std::min(read.theta.upper, closing_theta(spec.size))};
  spec.start_theta = std::clamp(spec.start_theta, spec.theta.lower, spec.theta.upper);
}

/// Returns the default maximum error in mm: the value for adults, scaled down for small heads and small cells.
double usual_max_mm(const HelmetFile& file) {
  return std::min({HelmetFile::usual_max_mm, GoalSettings::grain * file.spec.size.edge_mm,
                   share_of_coverage * file.head.coverage_mm});
}

void read_tolerance(const targets::Section& root, HelmetFile& file) {
  file.max_mm = usual_max_mm(file);
  file.rms_mm = HelmetFile::usual_rms_mm * file.max_mm / HelmetFile::usual_max_mm;
  root.read_into(file);
}

/// Rejects solvers and solver keys that only apply to other kinds of goals.
void check_solver(const targets::Section& root) {
  const auto solver = root.optional("solver");
  if (!solver || solver->kind() != targets::Node::Kind::map) return;
  if (const auto starts = solver->optional("starts"))
    throw starts->key_error(
        "a helmet is searched from one start, the net that is laid out on the head; leave it out");
  const auto name = solver->optional("name");
  if (name && read_solver_name(*name) != optim::SolverName::ceres)
    throw name->error("a helmet's hundreds of tilts need second-order steps; allowed: ceres");
}

}  // namespace

const targets::KeyTable& helmet_keys() {
  static const optim::RibsSpec usual{};
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", helmet_target_keys(), "the goal", targets::needed},
          {"structure", helmet_structure_keys(), "the flat helmet"},
          {"variables", net_variables_keys(usual.tilt, usual.theta),
           "what the search may change, and how far"},
          {"tolerance",
           targets::KeyTable({
               {"rms_mm", &HelmetFile::rms_mm, value::number(targets::above(0, "mm")),
                targets::otherwise(
                    fmt::format("{:g}; less with a smaller `max_mm` by default", HelmetFile::usual_rms_mm)),
                "most of the [distance](#distances-of-a-helmet) from head plus clearance, root mean square"},
               {"max_mm", &HelmetFile::max_mm, value::number(targets::above(0, "mm")),
                targets::otherwise(fmt::format(
                    "{:g}, or half a cell, or a thirtieth of `target.coverage_mm` where that is less",
                    HelmetFile::usual_max_mm)),
                "likewise, the largest"},
               {"covered_share", &HelmetFile::covered_share, value::number(targets::Bounds{0, 1, true, true}),
                targets::otherwise("any will do"), "least of [covered_share](#covered_share)"},
               verify_key(),
           }),
           "when the goal is met"},
          {"solver", solver_keys({optim::SolverName::ceres}, {}, helmet_evaluations, "of the search"),
           "how the search is run"},
      },
      any_hinge);
  return keys;
}

HelmetFile read_helmet_file(const targets::Node& node) {
  const targets::Section root = read_root(node, helmet_keys());
  const targets::Section target = root.section("target");
  // A separate statement, because GCC 12 frees bases twice if a later initializer throws.
  targets::Head head = read_head(target);
  HelmetFile file{{}, std::move(head)};
  read_structure(root, file);
  read_variables(root, file.spec);
  read_ribs(target, file);
  check_solver(root);
  read_tolerance(root, file);
  read_settings(root, file.spec.size.edge_mm, file);
  read_hinges(root, file.spec.size, file);
  return file;
}

}  // namespace kinetix::app
