#include "optim/surface/fit_surface.hpp"

#include <fmt/format.h>
#include <mutex>
#include <numeric>
#include <random>

#include "model/base/invalid_input.hpp"
#include "model/base/parallel_runs.hpp"
#include "model/contact/wall_contact.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector2d;

constexpr double first_boundary_weight = 0.3;  // of the first steps, which size the sheet
constexpr double min_progress =
    1e-5;                  // of the cost, per step: below, a sheet creeps along a valley for hundreds of
                           // steps
constexpr int longer = 2;  // iterations of the second stage over those requested: most searches end earlier
constexpr int shaken_per_round =
    4;  // searches from the best sheet: few, so that each round soon starts from a better one
/// Standard deviation of shakes, in logarithms of multipliers, rad and mean edges. Twice as much mostly ruins
/// a sheet, and a tenth leads back to the same minimum.
constexpr double shake = 4e-3;
constexpr double slack = 1e-3;  // rad and mean edges: largest violation of a bound by least squares

// Fraction of the largest allowed fold. Gentle tilts leave room between the bounds for the starts, whose
// straight creases fold by half of what the others do.
constexpr double least_of_most_fold = 0.25;

MeshBounds bounds_of(const SurfaceOptions& options) {
  MeshBounds out = options.bounds;
  out.multiplier = std::tan(options.tilt) * std::sin(options.theta);
  out.min_fold = std::min(out.min_fold, least_of_most_fold * out.multiplier);
  return out;
}

double covered(const targets::SurfacePatch& patch, const model::QuadMesh& m,
               const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<Vector2d> rim;
  const auto add = [&](int i, int j) { rim.push_back(vertices[m.vertex(i, j)].head<2>()); };
  for (int i = 0; i < m.columns; ++i) add(i, 0);
  for (int j = 0; j < m.rows; ++j) add(m.columns, j);
  for (int i = m.columns; i > 0; --i) add(i, m.rows);
  for (int j = m.rows; j > 0; --j) add(0, j);
  const double x = patch.half.x(), y = patch.half.y();
  return outline_error(targets::Outline({{-x, -y}, {x, -y}, {x, y}, {-x, y}}), rim).iou;
}

SurfaceError error_of(const targets::SurfacePatch& patch, const SurfaceDesign& design) {
  SurfaceError out;
  const double diagonal = patch.diagonal();
  double sum = 0;
  for (int j = 0; j <= design.mesh.rows; ++j)
    for (int i = 0; i <= design.mesh.columns; ++i) {
      const Eigen::Vector3d& p = design.vertices[design.mesh.vertex(i, j)];
      const double off = (closest_surface_point(patch, p).distance - layer_of(i) * design.layer) / diagonal;
      sum += off * off;
      out.max = std::max(out.max, std::abs(off));
    }
  out.rms = std::sqrt(sum / static_cast<double>(design.vertices.size()));
  out.cover = covered(patch, design.mesh, design.vertices);
  return out;
}

void measure_mesh(SurfaceDesign& design) {
  const model::QuadMesh& m = design.mesh;
  const double mean = mean_edge(m);
  design.sector = {pi, 0};
  design.edge = {INFINITY, 0};
  const auto spread = [](std::array<double, 2>& range, double value) {
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (int j = 1; j < m.rows; ++j)
    for (int i = 1; i < m.columns; ++i)
      for (const double angle : sectors(m, i, j)) spread(design.sector, angle);
  for (int j = 0; j <= m.rows; ++j)
    for (int i = 0; i <= m.columns; ++i) {
      if (i < m.columns) spread(design.edge, (m.at(i + 1, j) - m.at(i, j)).norm() / mean);
      if (j < m.rows) spread(design.edge, (m.at(i, j + 1) - m.at(i, j)).norm() / mean);
    }
  for (const auto* multipliers : {&m.rising, &m.level})
    for (const double c : *multipliers) design.tilt = std::max(design.tilt, std::atan(std::abs(c)));
}

bool is_valid(const model::QuadMesh& mesh) {
  try {
    validate(mesh);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

bool is_within(const SurfaceDesign& design, const SurfaceOptions& options) {
  const auto keeps = [](const std::array<double, 2>& range, const std::array<double, 2>& bounds) {
    return range[0] >= bounds[0] - slack && range[1] <= bounds[1] + slack;
  };
  return design.valid && keeps(design.sector, options.bounds.sector) &&
         keeps(design.edge, options.bounds.edge) && design.tilt <= options.tilt + slack;
}

/// Miura sheet to start from, and the length of first steps.
struct Trial {
  MiuraStart miura;
  double trust = 1e4;
  double rim = 0.007;  ///< weight of the rim's distances: they decide what the layers leave open
};

constexpr double of_most_fold = 0.85;                   // of the largest allowed fold, at a start
constexpr double from_sector = 3 * radians_per_degree;  // margin of a start to the bounds of sectors

/// Returns a start that is within the bounds from the beginning.
MiuraStart kept_inside(MiuraStart start, const SurfaceOptions& options) {
  start.fold = std::min(start.fold, of_most_fold * bounds_of(options).multiplier);
  const double least = std::max(options.bounds.sector[0], pi - options.bounds.sector[1]) + from_sector;
  start.angle = std::min(std::max(start.angle, least), pi / 2 - from_sector);
  return start;
}

/// One start, in stages: all begin, and the best continue.
class Run {
 public:
  Run(const targets::SurfacePatch& patch, const SurfaceOptions& options, const Trial& trial)
      : patch_(patch),
        options_(options),
        trust_(trial.trust),
        boundary_weight_(trial.rim),
        start_(start_on(patch, options.columns, options.rows, kept_inside(trial.miura, options))) {}

  SurfaceDesign begin() {
    stage(first_boundary_weight, options_.iterations / 5);
    stage(boundary_weight_, options_.iterations / 2);
    return design();
  }

  SurfaceDesign go_on() {
    stage(boundary_weight_, longer * options_.iterations);
    return design();
  }

  /// Searches from this sheet with every number of its mesh changed a little.
  /// @param seed of the random numbers
  SurfaceDesign shaken(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> off(0, shake);
    for (int k = 0; k < start_.variables.layer(); ++k) start_.x[k] += off(random);
    evaluations_ = 0;
    stage(boundary_weight_, 2 * options_.iterations / 3);
    return design();
  }

  /// Continues from the state of another run of the same start.
  void take(const Run& other) { start_ = other.start_; }

 private:
  void stage(double rim, int iterations) {
    const SurfaceProblem problem(patch_, start_.variables, bounds_of(options_), rim);
    SolverOptions solver;
    solver.max_evaluations = std::max(1, iterations);
    solver.tolerance = min_progress;
    solver.stop = options_.stop;
    solver.trust_radius = trust_;
    start_.x = start_.x.cwiseMax(problem.lower()).cwiseMin(problem.upper());
    const SolveResult found = solve(problem, start_.x, solver);
    evaluations_ += found.evaluations;
    start_.x = found.x;
  }

  SurfaceDesign design() const {
    SurfaceDesign out;
    const SurfaceVariables& v = start_.variables;
    out.mesh = march(march_data(v, start_.x.data())).mesh;
    for (auto* multipliers : {&out.mesh.rising, &out.mesh.level})
      for (double& c : *multipliers) c /= std::sin(options_.theta);
    for (Vector2d& vertex : out.mesh.vertices) vertex /= std::cos(options_.theta);
    out.vertices = placed_vertices(v, start_.x);
    out.theta = options_.theta;
    out.layer = start_.x[v.layer()] * v.unit;
    out.error = error_of(patch_, out);
    measure_mesh(out);
    out.valid = is_valid(out.mesh);
    out.within = is_within(out, options_);
    out.evaluations = evaluations_;
    return out;
  }

  const targets::SurfacePatch& patch_;
  const SurfaceOptions& options_;
  double trust_, boundary_weight_;
  SurfaceStart start_;
  int evaluations_ = 0;
};

/// Returns the proportions to try: first those of the best sheets on caps, saddles and vases, then a grid
/// about them.
std::vector<Trial> trials() {
  constexpr double deg = radians_per_degree;
  std::vector<Trial> out = {{{53 * deg, 1.5, -1, 1}, 1e4, 0.005}, {{53 * deg, 1.5, 1, -1}, 1e4, 0.005},
                            {{57 * deg, 1.2, -1, 1}, 1e3, 0.02},  {{57 * deg, 1.5, -1, 1}, 1e3, 0.02},
                            {{57 * deg, 1.5, 1, 1}, 1e4},         {{57 * deg, 1.5, -1, -1}, 1e4},
                            {{62 * deg, 1.5, 1, -1}, 1e3, 0.02},  {{62 * deg, 1.5, -1, 1}, 1e2, 0.005}};
  for (const double trust : {1e4, 1e3})
    for (const double fold : {1.5, 1.2, 1.78})
      for (const double angle : {53.0, 57.0, 62.0, 70.0})
        for (const int side : {1, -1})
          for (const int turn : {1, -1}) out.push_back({{angle * deg, fold, side, turn}, trust});
  return out;
}

bool fits_better(const SurfaceDesign& a, const SurfaceDesign& b) {
  if (a.within != b.within) return a.within;
  if (a.valid != b.valid) return a.valid;
  if (std::isnan(a.error.cover) != std::isnan(b.error.cover)) return std::isnan(b.error.cover);
  return a.error.rms < b.error.rms;
}

}  // namespace

void SurfaceOptions::validate() const {
  require("columns", columns, columns >= 2, "at least 2");
  require("rows", rows, rows >= 2, "at least 2");
  require("theta", theta, theta > 0 && theta < pi / 4, "in (0, pi/4) rad");
  require("tilt", tilt, tilt > 0 && tilt < pi / 2, "in (0, pi/2) rad");
  require("starts", starts, starts >= 1, "at least 1");
  require("iterations", iterations, iterations >= 1, "at least 1");
  require("shakes", shakes, shakes >= 0, "at least 0");
  require("enough", enough, enough >= 0, "at least 0");
}

namespace {

/// Runs rounds of searches from the best run, shaken. Runs and designs of a round depend only on its number.
SurfaceDesign after_shakes(Run best_run, SurfaceDesign best, const SurfaceOptions& options, double diagonal,
                           const Progress& progress) {
  for (int round = 0; round < options.shakes && !(best.error.rms <= options.enough && best.within); ++round) {
    if (options.stop.stop_requested()) break;
    progress("search anew", static_cast<double>(round) / options.shakes,
             fmt::format("round {} of {}, best {:.2g} mm off", round + 1, options.shakes,
                         best.error.rms * diagonal));
    std::vector<Run> runs(shaken_per_round, best_run);
    std::vector<SurfaceDesign> designs(shaken_per_round);
    model::run_in_parallel(shaken_per_round, options.threads, [&](int k) {
      designs[k] = runs[k].shaken(static_cast<unsigned>(round * shaken_per_round + k));
    });
    const auto found = std::min_element(designs.begin(), designs.end(), fits_better) - designs.begin();
    for (const SurfaceDesign& design : designs) best.evaluations += design.evaluations;
    best.shakes += shaken_per_round;
    if (!fits_better(designs[found], best)) continue;
    designs[found].evaluations = best.evaluations;
    designs[found].shakes = best.shakes;
    designs[found].start = best.start;
    designs[found].starts = best.starts;
    best = std::move(designs[found]);
    best_run.take(runs[found]);
  }
  best.stopped = options.stop.stop_requested();
  return best;
}

}  // namespace

SurfaceDesign fit_surface(const targets::SurfacePatch& patch, const SurfaceOptions& options,
                          const Progress& progress) {
  options.validate();
  const std::vector<Trial> all = trials();
  const int count = std::min<int>(options.starts, static_cast<int>(all.size()));
  const int kept = (count + 1) / 2;
  std::vector<Run> runs;
  for (int k = 0; k < count; ++k) runs.emplace_back(patch, options, all[k]);
  std::vector<SurfaceDesign> designs(count);
  std::vector<int> order(count), evaluations(count);
  std::iota(order.begin(), order.end(), 0);
  int ended = 0;
  double least = std::numeric_limits<double>::infinity();
  std::mutex words;  // guards `least` and `ended`
  const auto fit = [&](int runs_of_stage, const std::function<SurfaceDesign(Run&)>& stage) {
    model::run_in_parallel(runs_of_stage, options.threads, [&](int k) {
      const int start = order[k];
      SurfaceDesign found = stage(runs[start]);
      found.start = start;
      evaluations[start] = found.evaluations;
      const double rms = found.valid ? found.error.rms : std::numeric_limits<double>::infinity();
      if (designs[start].mesh.vertices.empty() || fits_better(found, designs[start]))
        designs[start] = std::move(found);
      const std::lock_guard lock(words);
      least = std::min(least, rms);
      ++ended;
      const std::string best =
          std::isfinite(least) ? fmt::format(", best {:.2g} mm off", least * patch.diagonal()) : "";
      progress("search", static_cast<double>(ended) / (count + kept),
               fmt::format("search {} of {}{}", ended, count + kept, best));
    });
  };
  fit(count, [](Run& run) { return run.begin(); });
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return fits_better(designs[a], designs[b]); });
  fit(kept, [](Run& run) { return run.go_on(); });
  SurfaceDesign best = *std::min_element(designs.begin(), designs.end(), fits_better);
  best.starts = count;
  best.stopped = options.stop.stop_requested();
  best.evaluations = std::accumulate(evaluations.begin(), evaluations.end(), 0);
  if (!best.valid) return best;
  return after_shakes(runs[best.start], best, options, patch.diagonal(), progress);
}

namespace {

constexpr int states = 40;                  // of the motion: a body turns by less than a degree between two
constexpr double least = 0.02;              // cell edges: lower walls are threads
constexpr double height_tolerance = 0.005;  // cell edges: finer than a layer of a print

bool is_free_at(model::OrigamiSheet sheet, double theta, double height) {
  sheet.structure.size.height_mm = height * sheet.structure.size.edge_mm;
  model::WallContact contact(sheet.structure);
  for (int k = states; k >= 1; --k)
    if (!contact.overlapping(fold(sheet, theta * k / states)).empty()) return false;
  return true;
}

}  // namespace

bool is_free(const model::OrigamiSheet& sheet, double theta) {
  return is_free_at(sheet, theta, sheet.structure.size.height_mm / sheet.structure.size.edge_mm);
}

double free_height(const model::OrigamiSheet& sheet, double theta, double most) {
  if (!is_free_at(sheet, theta, least)) return 0;
  if (is_free_at(sheet, theta, most)) return most;
  double low = least, high = most;
  while (high - low > height_tolerance) {
    const double middle = (low + high) / 2;
    (is_free_at(sheet, theta, middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace kinetix::optim
