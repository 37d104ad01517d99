#include "app/goals/surface/surface_goal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/result/result_json.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int grid_lines = 9;    // lines per direction in pictures: enough to show the shape
constexpr int grid_points = 25;  // points per line: lines look smooth on a page

Json point(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json grid(const targets::SurfacePatch& patch) {
  Json lines = Json::array();
  for (const bool along_x : {true, false})
    for (int k = 0; k < grid_lines; ++k) {
      Json line = Json::array();
      for (int p = 0; p < grid_points; ++p) {
        const double across = 2.0 * k / (grid_lines - 1) - 1, along = 2.0 * p / (grid_points - 1) - 1;
        const Eigen::Vector2d at = patch.half.cwiseProduct(along_x ? Eigen::Vector2d(along, across)
                                                                   : Eigen::Vector2d(across, along));
        line.push_back(point({at.x(), at.y(), patch.height(at).z}));
      }
      lines.push_back(line);
    }
  return lines;
}

/// Describes why the folded sheet misses the surface, one sentence each.
std::vector<std::string> surface_violations(const SurfaceOutcome& o) {
  std::vector<std::string> why;
  const optim::SurfaceError& error = o.design.error;
  if (!(error.rms <= o.file.shape_tolerance))
    why.push_back(
        fmt::format("model: the vertices are {:.2f} % of the diagonal off the surface; at most {:.2f} % is "
                    "allowed{}",
                    100 * error.rms, 100 * o.file.shape_tolerance,
                    std::isfinite(o.curvature.share)
                        ? fmt::format("; the sheet has {:.0f} % of its curvature", 100 * o.curvature.share)
                        : ""));
  if (!(error.cover >= o.file.cover_tolerance))
    why.push_back(fmt::format("model: {:.0f} % of the area overlaps, at least {:.0f} % is required",
                              100 * error.cover, 100 * o.file.cover_tolerance));
  if (!o.needs_curvature()) return why;
  if (!(o.curvature.share >= o.file.curvature_tolerance))
    why.push_back(fmt::format(
        "model: the sheet has {:.0f} % of the surface's Gauss curvature; at least {:.0f} % is required "
        "(`tolerance.curvature_share`). Allow more in `variables.edge` and `variables.sector_deg`, or take "
        "`target.ribs`",
        100 * o.curvature.share, 100 * o.file.curvature_tolerance));
  if (!(error.rms <= most_of_cone * o.cone_rms))
    why.push_back(
        fmt::format("model: the vertices are {:.2f} % of the diagonal off the surface, the best cylinder or "
                    "cone {:.2f} %; "
                    "at most half of that is allowed",
                    100 * error.rms, 100 * o.cone_rms));
  return why;
}

Json degrees(const std::array<double, 2>& range) { return {to_degrees(range[0]), to_degrees(range[1])}; }

// Rounds of four searches each, together about as long as the search before them. Later rounds gain a few percent.
constexpr int retry_shakes = 4;

/// Returns the largest allowed rms of a doubly curved sheet, over the diagonal; infinity for other surfaces.
double max_rms_to_curve(const targets::SurfacePatch& patch) {
  if (!(curvature_of(patch).total > targets::double_curvature_threshold))
    return std::numeric_limits<double>::infinity();
  targets::PointGrid corners{1, 1, {}};
  for (const double y : {-patch.half.y(), patch.half.y()})
    for (const double x : {-patch.half.x(), patch.half.x()})
      corners.points.emplace_back(x, y, patch.height({x, y}).z);
  return most_of_cone * optim::rms_from_best_cone(optim::points_below(patch, corners)) / patch.diagonal();
}

optim::SurfaceOptions options_of(const SurfaceFile& file, const RunOptions& run) {
  optim::SurfaceOptions out;
  out.columns = file.columns;
  out.rows = file.rows;
  out.theta = file.theta;
  out.tilt = file.tilt;
  out.bounds.sector = file.sector;
  out.bounds.edge = file.edge;
  out.shakes = retry_shakes;
  out.enough = std::min(file.shape_tolerance, max_rms_to_curve(file.patch));
  out.threads = run.threads;
  out.stop = run.stop;
  return out;
}

/// Makes the sheet of a mesh, sized in mm. The mean wall has length 1 in cell edges.
model::OrigamiSheet sheet_of(const model::QuadMesh& mesh, const SurfaceFile& file) {
  const model::OrigamiSheet unit = origami_sheet(mesh, model::CellSize{});
  const double edge_mm = mean_edge(mesh) / mean_edge(unit.mesh);
  return origami_sheet(mesh, file.size(edge_mm));
}

/// Returns the rigid motion (mm) that aligns the sheet's exact state with the vertices of the design.
model::Pose onto_surface(const model::OrigamiSheet& sheet, const optim::SurfaceDesign& design) {
  model::QuadMesh mesh = sheet.mesh;
  for (Eigen::Vector2d& vertex : mesh.vertices) vertex *= std::cos(design.theta);
  const model::FoldedMesh folded = fold_facets(mesh, std::sin(design.theta));
  const auto count = static_cast<Eigen::Index>(folded.vertices.size());
  Eigen::Matrix3Xd from(3, count), to(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    from.col(k) = sheet.structure.size.edge_mm * folded.vertices[k];
    to.col(k) = design.vertices[k];
  }
  const Eigen::Matrix4d motion = rigid_fit(from, to);
  return {motion.topLeftCorner<3, 3>(), motion.topRightCorner<3, 1>()};
}

/// Returns the bodies next to vertex (i, j) of a mesh, one in each adjacent facet.
std::vector<int> bodies_at(const model::QuadMesh& mesh, int i, int j) {
  std::vector<int> out;
  for (const int row : {2 * j - 1, 2 * j})
    for (const int column : {2 * i - 1, 2 * i})
      if (row >= 0 && row < 2 * mesh.rows && column >= 0 && column < 2 * mesh.columns)
        out.push_back(row * 2 * mesh.columns + column);
  return out;
}

Eigen::Vector3d mean_place(const std::vector<int>& bodies, const model::State& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int body : bodies) sum += state[body].p;
  return sum / static_cast<double>(bodies.size());
}

// Search time in s for 81 vertices, measured; it grows with the square of their number.
constexpr double seconds_of_81 = 4;

class SurfaceGoal final : public Goal {
 public:
  explicit SurfaceGoal(SurfaceFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const optim::SurfaceStart start = optim::start_on(file_.patch, file_.columns, file_.rows, {});
    model::QuadMesh mesh = march(march_data(start.variables, start.x.data())).mesh;
    for (Eigen::Vector2d& vertex : mesh.vertices) vertex /= std::cos(file_.theta);
    Forecast out{sheet_of(mesh, file_).structure};
    const double diagonal = file_.patch.diagonal();
    const Eigen::Vector2d sides = 2 * file_.patch.half;
    out.folded_mm = {sides.x(), sides.y(),
                     std::sqrt(std::max(0.0, diagonal * diagonal - sides.squaredNorm()))};
    out.search_s = seconds_of_81 * std::pow((file_.columns + 1) * (file_.rows + 1) / 81.0, 2);
    add_settings(file_, out);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    SearchResult out;
    copy_settings(out, file_);
    auto surface = std::make_unique<SurfaceOutcome>(file_);
    out.tolerances = {{"shape", file_.shape_tolerance},
                      {"cover", file_.cover_tolerance},
                      {"curvature_share", file_.curvature_tolerance}};
    surface->design = fit_surface(file_.patch, options_of(file_, options), options.progress);
    if (!surface->design.valid && options.stop.stop_requested())
      throw Interrupted("no sheet that folds flat was found before the search was stopped");
    if (!surface->design.valid)
      throw InvalidInput(
          "no sheet that folds flat was found for this surface. Give more `structure.facets`, or more room "
          "in `variables`");
    surface->diagonal_mm = file_.patch.diagonal();
    const targets::PointGrid vertices{file_.columns, file_.rows, surface->design.vertices};
    surface->curvature = gauss_share(file_.patch, middle_of(surface->design));
    surface->cone_rms =
        optim::rms_from_best_cone(optim::points_below(file_.patch, vertices)) / surface->diagonal_mm;
    model::OrigamiSheet sheet = sheet_of(surface->design.mesh, file_);
    surface->free_height = optim::free_height(sheet, file_.theta);
    surface->clear = optim::is_free(sheet, file_.theta);
    surface->exact = moved(fold(sheet, file_.theta), onto_surface(sheet, surface->design));
    out.design.structure = std::move(sheet.structure);
    out.theta = file_.theta;
    out.plan.exact = exact_motion(out.design.structure);
    out.to_shown = motion_onto(out.plan.exact.at(out.theta), surface->exact);
    out.is_aligned = true;
    out.goal = std::move(surface);
    return out;
  }

  /// Measures the model's state, and ribs for comparison. Returns nullptr for other states.
  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State&,
                                         const RunOptions& options) const override {
    if (of != StateOf::model) return nullptr;
    const auto& surface = outcome_of<SurfaceOutcome>(run);
    auto out = std::make_shared<SurfaceMeasure>();
    out->violations = violations(surface);
    const targets::RibbedSurface ribbed = targets::ribbed_surface(file_.patch);
    const int facets = file_.patch.half.x() >= file_.patch.half.y() ? file_.columns : file_.rows;
    out->methods = {
        {"sheet", surface.design.error.rms, surface.design.error.max, 1, 1 - surface.design.error.cover}};
    for (SurfaceMethod& method : rib_methods(ribbed, default_ribs(ribbed, facets), true, options.stop))
      out->methods.push_back(std::move(method));
    if (out->methods.size() < 2 || out->violations.empty()) return out;
    const SurfaceMethod& fishbone = out->methods[1];
    if (fishbone.rms <= file_.shape_tolerance)
      out->violations.push_back(
          fmt::format("a fishbone would be {:.2f} % of the diagonal off, with {:.0f} % of the area open: "
                      "`target.ribs: {}`",
                      100 * fishbone.rms, 100 * fishbone.open, facets));
    return out;
  }

  /// Observes the distance of each mesh vertex from its layer of the surface. A vertex moves with the mean of the
  /// bodies next to it.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice&,
                                  const model::State& state) const override {
    const auto& surface = outcome_of<SurfaceOutcome>(found);
    const model::QuadMesh& mesh = surface.design.mesh;
    const model::Pose motion = motion_onto(state, surface.exact);
    const model::State placed = moved(state, motion);
    Observed out{{}, file_.shape_tolerance * surface.diagonal_mm};
    for (int j = 0; j <= mesh.rows; ++j)
      for (int i = 0; i <= mesh.columns; ++i) {
        const std::vector<int> bodies = bodies_at(mesh, i, j);
        const Eigen::Vector3d vertex = surface.design.vertices[mesh.vertex(i, j)] +
                                       mean_place(bodies, placed) - mean_place(bodies, surface.exact);
        const targets::ClosestSurfacePoint at = closest_surface_point(file_.patch, vertex);
        out.points.push_back({bodies, mean_place(bodies, state), motion.R.transpose() * at.normal,
                              at.distance - optim::layer_of(i) * surface.design.layer});
      }
    return out;
  }

 private:
  SurfaceFile file_;
};

}  // namespace

void SurfaceOutcome::add_sections(const Run& run, Json& result) const {
  result["target"] = {{"kind", "surface"},
                      {"name", file.patch.name},
                      {"size_mm", {2 * file.patch.half.x(), 2 * file.patch.half.y()}},
                      {"lines_mm", grid(file.patch)}};
  Json vertices = Json::array(), flat = Json::array();
  for (const Eigen::Vector3d& vertex : design.vertices) vertices.push_back(point(vertex));
  for (const Eigen::Vector2d& vertex : design.mesh.vertices) flat.push_back({vertex.x(), vertex.y()});
  result["surface"] = {{"facets", {design.mesh.columns, design.mesh.rows}},
                       {"lines_mm", grid(file.patch)},
                       {"vertices_mm", vertices},
                       {"flat_mm", flat},
                       {"multipliers", {{"rising", design.mesh.rising}, {"level", design.mesh.level}}},
                       {"diagonal_mm", diagonal_mm},
                       {"layer_mm", design.layer},
                       {"rms", design.error.rms},
                       {"max", design.error.max},
                       {"cover", design.error.cover},
                       {"sector_deg", degrees(design.sector)},
                       {"edge", design.edge},
                       {"beta_deg", to_degrees(design.tilt)},
                       {"free_height", free_height},
                       {"walls_meet", !clear},
                       {"curvature_missing", 1 - curvature.share},
                       {"ways", methods_json(measure_of<SurfaceMeasure>(run).methods)},
                       {"reasons", run.violations}};
  result["optimiser"] = {{"solver", "ceres"}, {"starts", design.starts}, {"evaluations", design.evaluations}};
  add_end(design.stopped, design.within, "the best of all starts is within its bounds",
          "no start led to a mesh within its bounds", result["optimiser"]);
}

void SurfaceOutcome::add_metrics(const Run& run, Json& metrics) const {
  metrics["surface_rms"] = design.error.rms;
  metrics["surface_max"] = design.error.max;
  metrics["cover"] = design.error.cover;
  metrics["free_height"] = free_height;
  metrics["curvature_share"] = curvature.share;
  metrics["developable_rms"] = cone_rms;
  metrics["met"] = run.met();
}

std::vector<SummaryLine> SurfaceOutcome::summary_lines(const Run& run) const {
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"surface", fmt::format("{} mm rms from the surface, limit {} mm; {:.0f} % area overlap, limit {:g} %",
                              format_figures(design.error.rms * diagonal_mm),
                              format_figures(file.shape_tolerance * diagonal_mm), 100 * design.error.cover,
                              100 * file.cover_tolerance)});
  if (needs_curvature())
    lines.push_back(
        {"curvature",
         fmt::format("{:.0f} % of the surface's Gauss curvature; the best cylinder or cone is {:.2f} % "
                     "of the diagonal off the surface",
                     100 * curvature.share, 100 * cone_rms)});
  lines.push_back({"mesh", fmt::format("{} x {} facets, edges {:.2f} to {:.2f} of their mean, sectors {:.0f} "
                                       "to {:.0f} deg, tilts up to {:.1f} deg",
                                       design.mesh.columns, design.mesh.rows, design.edge[0], design.edge[1],
                                       to_degrees(design.sector[0]), to_degrees(design.sector[1]),
                                       to_degrees(design.tilt))});
  const double edge = run.design.structure.size().edge_mm;
  lines.push_back(
      {"walls", fmt::format("a mean wall is {:.2f} mm; {}", edge,
                            free_height > 0
                                ? fmt::format("plates up to {:.2f} mm high never collide", free_height * edge)
                                : "plates of any height collide during folding")});
  const std::vector<SurfaceMethod>& methods = measure_of<SurfaceMeasure>(run).methods;
  if (methods.size() > 1) lines.push_back({"others", describe({methods.begin() + 1, methods.end()})});
  lines.push_back(
      {"search", fmt::format("{:.2g} s, {} evaluations", run.timings.optimise, design.evaluations)});
  return lines;
}

std::vector<std::string> violations(const SurfaceOutcome& o) {
  std::vector<std::string> why = surface_violations(o);
  if (!o.design.within)
    why.push_back("no flat-foldable mesh within the bounds of its sectors, edges and tilts was found");
  if (!o.clear)
    why.push_back(o.free_height > 0
                      ? fmt::format("walls collide during folding; plates up to {:.3f} walls high would not",
                                    o.free_height)
                      : "walls of any height collide during folding");
  return why;
}

std::unique_ptr<Goal> make_goal(SurfaceFile file) { return std::make_unique<SurfaceGoal>(std::move(file)); }

static std::unique_ptr<Goal> read_goal(const targets::Node& root) {
  const targets::Section target = targets::Section(root, surface_file_keys()).section("target");
  return target.optional("ribs") ? make_goal(read_ribs_file(root)) : make_goal(read_surface_file(root));
}

extern const GoalKind surface_kind = {
    .name = "surface",
    .example = "target: {kind: surface, shape: cap}",
    .meaning = "sheet or ribs that cover a curved surface",
    .file = {{"mesh", "mesh"}},
    .read = read_goal,
    .table = surface_file_keys,
    .metrics = {
        {"surface_rms", "",
         "[distance of the mesh's vertices from the surface's layers](#surface_rms), root mean square, "
         "relative to the diagonal"},
        {"surface_max", "",
         "largest distance of the mesh's vertices from the surface's layers, relative to the diagonal"},
        {"cover", "",
         "[area that sheet and surface share](#surface_rms), relative to that of both. For ribs: area of "
         "their cells"},
        {"curvature_share", "",
         "for a sheet: [its Gauss curvature](#curvature_share) relative to that of the surface"},
        {"developable_rms", "",
         "distance of the surface from the [best cylinder or cone](#curvature_share), root mean square, over "
         "the diagonal"},
        {"covered_share", "",
         "for ribs: [share of the surface's area within a cell edge of a rib](#covered_share)"},
        {"goal_rms", "",
         "for ribs: distance of the surface from the nearest rib, root mean square, relative to the "
         "diagonal"},
        {"goal_max", "",
         "for ribs: largest distance of the surface from the nearest rib, relative to the diagonal"},
        {"free_height", "",
         "largest height of plates, in mean walls, at which no walls collide during the motion"}}};

}  // namespace kinetix::app
