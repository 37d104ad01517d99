#include "app/run/plan.hpp"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "model/base/algorithms.hpp"
#include "model/lattice/planar/exact_designs.hpp"

namespace kinetix::app {
namespace {

/// Bodies: above this the numeric rank costs more than a search. The exact families have one degree of freedom by
/// their closed form.
constexpr std::size_t max_bodies_for_rank = 500;

std::string wall_sentence(const model::ContactRange& range) {
  const double degrees = range.positive.theta / radians_per_degree;
  if (!range.positive.touches) return fmt::format("no walls touch up to a fold angle of {:.1f} deg", degrees);
  return fmt::format("walls touch at a fold angle of {:.2f} deg", degrees);
}

std::string model_sentence(const Plan& plan, const model::Linkage& structure) {
  if (plan.model == Model::exact)
    return "states follow from the analytic motion; only the simulation has contact";
  if (plan.model == Model::bullet) return "the state comes from the simulation";
  const auto leaning = std::find_if_not(structure.hinges.begin(), structure.hinges.end(),
                                        [](const model::RestHinge& hinge) { return is_vertical(hinge); });
  return "states are equilibria of rigid bodies, elastic hinges and walls in contact, followed from flat; " +
         (plan.planar
              ? "planar: all hinges stand upright"
              : "spatial: the hinge on wall " +
                    structure.wall_name(static_cast<int>(leaning - structure.hinges.begin())) + " leans");
}

/// Describes how many parameters choose the t of upright hinges, or by how much t must change for an exact design.
std::string designs_sentence(const model::PlanarStructure& planar, bool is_exact) {
  const int numbers = model::ExactDesigns(planar).dimension();
  if (is_exact)
    return fmt::format("{} numbers may choose the t of its {} hinges, and every cell still closes", numbers,
                       planar.hinges.size());
  const model::PlanarStructure nearest = nearest_exact(planar);
  double change = 0;
  for (std::size_t h = 0; h < planar.hinges.size(); ++h)
    change = std::max(change, std::abs(nearest.hinges[h].t - planar.hinges[h].t));
  return fmt::format("every cell would close if each t moved by {:.2g} or less", change);
}

/// Warns of several degrees of freedom. Between plates such a structure follows its lowest mode, which is not the
/// motion of the closed form.
std::string floppy_sentence(const Plan& plan) {
  return fmt::format(
      "underconstrained: {} degrees of freedom. Driving one leaves the rest undetermined. Add bracing walls "
      "or "
      "set `structure.rim: closed`",
      plan.mobility->dofs_along);
}

}  // namespace

std::string to_string(Model model) {
  switch (model) {
    case Model::exact:
      return "exact";
    case Model::equilibrium:
      return "equilibrium";
    case Model::bullet:
      break;
  }
  return "bullet";
}

Plan make_brief_plan(const model::Lattice& sheet, std::optional<Model> model, model::ExactMotion exact) {
  Plan plan;
  plan.exact = exact ? std::move(exact) : exact_motion(sheet);
  plan.model = model.value_or(plan.exact ? Model::exact : Model::bullet);
  plan.planar = !sheet.assembly() && all_vertical(model::Linkage(sheet));
  return plan;
}

Plan make_plan(const model::Lattice& sheet, std::optional<Model> model, model::ExactMotion exact) {
  Plan plan = make_brief_plan(sheet, model, std::move(exact));
  const model::Linkage structure = sheet;
  if (sheet.assembly()) return plan;
  plan.why.push_back(plan.exact.why);
  if (plan.planar && (sheet.planar() || !plan.exact))
    plan.why.push_back(designs_sentence(planar_structure(sheet), static_cast<bool>(plan.exact)));
  if (structure.bodies.size() <= max_bodies_for_rank) {
    plan.mobility = mobility(structure, plan.exact);
    plan.why.push_back("mobility: " + plan.mobility->why);
    if (plan.is_floppy()) plan.why.push_back(floppy_sentence(plan));
  } else {
    plan.why.push_back(
        fmt::format("mobility: numeric rank not computed above {} bodies", max_bodies_for_rank));
  }
  if (plan.exact) {
    plan.free_range = theta_range(structure, plan.exact);
    plan.why.push_back(wall_sentence(*plan.free_range));
  }
  plan.why.push_back(model_sentence(plan, structure));
  plan.decided = plan.why.size();
  return plan;
}

namespace {

// Seconds per loop: median over the shapes of targets/shapes, whose simulations take 0.01 to 2 s.
constexpr double seconds_per_loop = 0.0012;
constexpr double seconds_of_block = 2.4;  // s for 1000 bodies that fill space; 0.7 s for 384, 27 s for 4952
// Seconds for 175 bodies: the path to the goal and the compensation for elastic hinges. Measured: 0.5 to 2.6 s for 34
// to 173 bodies.
constexpr double elastic_seconds_of_175 = 2.5;
constexpr double contact_seconds_of_10000 = 2.4;
constexpr double bytes_of_program = 55e6, bytes_per_body = 65e3;

/// Rounds to one significant digit: 23.4 becomes 20.
double one_digit(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)));
  return unit * std::round(x / unit);
}

}  // namespace

double compensation_seconds(const GoalSettings& settings, const model::Lattice& sheet) {
  return settings.hinge.model == HingeSection::Model::elastic
             ? elastic_seconds_of_175 * std::pow(sheet.bodies() / 175.0, 1.25)
             : 0;
}

void add_settings(const GoalSettings& settings, Forecast& forecast) {
  model::append(settings.input_notes, forecast.notes);
  note_process(settings, forecast.sheet.size(), forecast.notes);
  forecast.search_s += compensation_seconds(settings, forecast.sheet);
}

Eigen::Vector3d flat_size(const model::Linkage& linkage) { return size_of(linkage, rest_state(linkage)); }

namespace {

/// Returns the eight corners of a half wall.
std::array<Eigen::Vector3d, 8> corners_of_wall(const OrientedBox& box) {
  std::array<Eigen::Vector3d, 8> out;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d side((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    Eigen::Vector3d at = side.cwiseProduct(box.half);
    if (side.x() > 0) at.x() += box.slant * at.y();
    out[k] = box.center + box.axes * at;
  }
  return out;
}

/// Calls `see` with the plate of each half wall in a state, one by one: the half walls of a million cells take half as
/// much memory as their linkage.
template <class See>
void see_walls(const model::Linkage& linkage, const model::State& state, See see) {
  model::Linkage one;
  one.size = linkage.size;
  for (const model::Plate& plate : linkage.plates) {
    one.plates = {plate};
    const model::HalfWall wall = half_walls(one).front();
    see(placed(wall, state[wall.body]));
  }
}

Eigen::Vector3d extents(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(Eigen::Vector3d(axes.transpose() * p));
  return box.sizes();
}

/// Returns the points that are extreme along one of many directions, evenly spread by the golden angle.
std::vector<Eigen::Vector3d> extreme_points(const std::vector<Eigen::Vector3d>& points) {
  constexpr int directions = 100;
  constexpr double golden_angle = 2.399963229728653;  // rad
  std::vector<Eigen::Vector3d> out;
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2 * k + 1.0) / directions, r = std::sqrt(1 - z * z), angle = golden_angle * k;
    const Eigen::Vector3d along(r * std::cos(angle), r * std::sin(angle), z);
    out.push_back(*std::max_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return a.dot(along) < b.dot(along);
    }));
  }
  return out;
}

/// Turns a box about each of its edges until no turn makes it smaller.
Eigen::Matrix3d turned_smallest(const std::vector<Eigen::Vector3d>& points, Eigen::Matrix3d axes) {
  constexpr int rounds = 8, steps = 45;  // a step is 1 degree, then less
  const auto volume = [&](const Eigen::Matrix3d& at) { return extents(points, at).prod(); };
  double least = volume(axes);
  for (int round = 0; round < rounds; ++round) {
    const double before = least, step = pi / 180 / (round < 2 ? 1 : 8 << round);
    for (int edge = 0; edge < 3; ++edge) {
      const Eigen::Matrix3d start = axes;
      for (int k = -steps; k <= steps; ++k) {
        const Eigen::Matrix3d turned =
            start * Eigen::AngleAxisd(k * step, Eigen::Vector3d::Unit(edge)).toRotationMatrix();
        if (const double v = volume(turned); v < least) {
          least = v;
          axes = turned;
        }
      }
    }
    if (round >= 2 && least == before) break;
  }
  return axes;
}

}  // namespace

Eigen::Vector3d size_of(const model::Linkage& linkage, const model::State& state) {
  Eigen::AlignedBox3d all;
  see_walls(linkage, state, [&](const OrientedBox& box) {
    for (const Eigen::Vector3d& corner : corners_of_wall(box)) all.extend(corner);
  });
  return all.sizes();
}

Eigen::Vector3d smallest_box(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> few = extreme_points(points);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : few) middle += p / static_cast<double>(few.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : few) spread += (p - middle) * (p - middle).transpose();
  const Eigen::Matrix3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  Eigen::Vector3d best = extents(points, Eigen::Matrix3d::Identity());
  for (const Eigen::Matrix3d& start : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), principal}) {
    const Eigen::Vector3d found = extents(points, turned_smallest(few, start));
    if (found.prod() < best.prod()) best = found;
  }
  std::sort(best.data(), best.data() + 3, std::greater<>());
  return best;
}

Eigen::Vector3d folded_size(const model::Linkage& linkage, const model::State& state) {
  constexpr std::size_t most_plates =
      100'000;  // more take longer to turn than all else that the summary needs
  if (linkage.plates.size() > most_plates) return size_of(linkage, state);
  std::vector<Eigen::Vector3d> points;
  see_walls(linkage, state, [&](const OrientedBox& box) {
    for (const Eigen::Vector3d& corner : corners_of_wall(box)) points.push_back(corner);
  });
  return smallest_box(points);
}

double physics_seconds(const model::Lattice& sheet) {
  if (sheet.sodalite()) return seconds_of_block * std::pow(sheet.bodies() / 1000.0, 1.45);
  const double loops = sheet.hinges() - sheet.bodies() + 1.0;
  return seconds_per_loop * std::max(loops, 1.0);
}

double contact_seconds(const model::Lattice& sheet) {
  return contact_seconds_of_10000 * std::pow(sheet.bodies() / 1e4, 1.33);
}

double memory_needed(const model::Linkage& linkage) {
  return bytes_of_program + bytes_per_body * static_cast<double>(linkage.bodies.size());
}

std::string about(double seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 100) return fmt::format("about {:g} s", one_digit(seconds));
  if (seconds < 100 * 60) return fmt::format("about {:g} minutes", one_digit(seconds / 60));
  return fmt::format("about {:g} hours", one_digit(seconds / 3600));
}

}  // namespace kinetix::app
