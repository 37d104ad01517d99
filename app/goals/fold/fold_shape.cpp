#include "app/goals/fold/fold_shape.hpp"

#include <fmt/format.h>

#include "app/console/short_form.hpp"
#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "app/files/structure_section.hpp"
#include "app/models/model_file.hpp"
#include "targets/fold/fold_goal.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr double fold_cell_mm = 10;  // the default of a design; the folding of a net does not depend on it

targets::KeyTable fold_structure_keys() {
  return targets::KeyTable({cell_mm_key(targets::by_default(fold_cell_mm)), wall_mm_key()});
}

targets::KeyTable fold_tolerance_keys() {
  std::vector<targets::Key> keys = {
      {"angle_deg", &FoldFile::angle_tolerance, value::angle({0, 90, false, true, "degrees"}),
       "most that the fold of a crease may be off"},
      {"shape", &FoldFile::shape_tolerance, value::number(targets::part_of_one),
       "limit of [face_rms](#face_rms), relative to the edge of a face"},
      {"size", &FoldFile::size_tolerance, value::number(targets::part_of_one),
       "limit of the difference between an edge of the folded box and `target.box_mm`, relative to its "
       "length"},
      verify_key(),
  };
  const auto limits = hinge_limit_keys("The net folds at a smaller angle to stay within it");
  keys.insert(keys.end() - 1, limits.begin(), limits.end());
  return targets::KeyTable(std::move(keys));
}

/// Returns a function that gives the walls for any cell edge: sizes from the file, and defaults from the edge, at least
/// as thick as the process prints.
std::function<model::CellSize(double)> walls_for(const targets::Section& structure,
                                                 const model::CellSize& given, double least_wall_mm) {
  const targets::Section wall = structure.section("wall_mm");
  const bool has_thickness = wall.optional("thickness").has_value(),
             has_height = wall.optional("height").has_value();
  return [=](double edge_mm) {
    model::CellSize size = default_size(edge_mm);
    size.thickness_mm = std::max(size.thickness_mm, least_wall_mm);
    if (has_thickness) size.thickness_mm = given.thickness_mm;
    if (has_height) size.height_mm = given.height_mm;
    return size;
  };
}

void read_structure(const targets::Section& root, FoldFile& file) {
  const auto node = root.optional("structure");
  if (const auto cells = node ? node->optional("cells") : std::nullopt)
    throw cells->key_error(
        "the cells of a fold follow from its faces. Remove the key, and give faces in target.box or "
        "target.net");
  file.size = read_size(root.section("structure"), fold_cell_mm);
  file.size =
      walls_for(root.section("structure"), file.size, read_process(root).min_wall_mm)(file.size.edge_mm);
}

/// Chooses the cells and their edge for a box of given size.
void choose_cells(const targets::Section& root, FoldFile& file) {
  const targets::Node target = root.required("target", "");
  const targets::Section structure = root.section("structure");
  optim::BoxOptions options;
  options.required_mm = *file.goal.box_mm;
  options.open = file.goal.open;
  options.crease_columns = file.goal.nets.front().creases.front().columns;
  if (structure.optional("cell_mm")) options.edge_mm = file.size.edge_mm;
  options.fold.tilt = file.tilt;
  options.fold.theta = file.theta;
  const model::CellSize given = file.size;
  options.size = walls_for(structure, given, read_process(root).min_wall_mm);
  const optim::BoxInCells box = target.located([&] { return fit_box(options); });
  file.size = options.size(box.edge_mm);
  file.goal = targets::box_goal(box.edges, options.open, options.crease_columns);
  file.goal.box_mm = options.required_mm;
  file.box_folded_mm = box.folded_mm;
  file.box = std::move(options);
}

void check_force_limit(const targets::Node& force, const FoldFile& file) {
  if (file.hinge.model != HingeSection::Model::elastic)
    throw force.key_error("only applies to elastic hinges. Add `hinge`, or remove the key");
  if (file.drive)
    throw force.key_error(
        "only applies to an external drive, and springs in the hinges need none. Remove the key");
}

/// Rejects a strain limit without elastic hinges, because strain is known only in their equilibrium.
void check_strain_limit(const targets::Node& strain, const FoldFile& file) {
  if (file.hinge.model != HingeSection::Model::elastic)
    throw strain.key_error("only applies to elastic hinges. Remove `model: rotary` of `hinge`, or this key");
}

void read_tolerance(const targets::Section& root, FoldFile& file) {
  const targets::Section section = root.section("tolerance");
  root.read_into(file);
  if (const auto size = section.optional("size"); size && !file.goal.box_mm)
    throw size->key_error("only applies together with target.box_mm. Add target.box_mm, or remove the key");
  file.limits = read_hinge_limits(section, file.hinge, file.hinge_parts);
  if (const auto force = section.optional("force_N")) check_force_limit(*force, file);
  if (const auto strain = section.optional("strain")) check_strain_limit(*strain, file);
}

targets::KeyTable keys_of(const FoldFile& usual) {
  return goal_keys(
      {
          {"target", targets::fold_target_keys(), "the goal", targets::needed},
          {"structure", fold_structure_keys(), "flat net"},
          {"variables", net_variables_keys(usual.tilt, usual.theta),
           "quantities that the search changes, with their ranges"},
          {"tolerance", fold_tolerance_keys(), "limits for a met goal"},
      },
      any_hinge, {robust_key()});
}

}  // namespace

const targets::KeyTable& fold_keys() {
  static const targets::KeyTable keys = keys_of(FoldFile());
  return keys;
}

FoldFile read_fold_file(const targets::Node& node) {
  const targets::Section root = read_root(node, fold_keys());
  FoldFile file;
  file.goal = read_fold(root.required("target", ""), read_mesh_file);
  read_structure(root, file);
  const NetVariables variables = read_net_variables(root, file.size, {file.tilt, file.theta});
  file.tilt = variables.tilt;
  file.theta = variables.theta;
  if (file.goal.box_mm) choose_cells(root, file);
  read_settings(root, file.size.edge_mm, file);
  read_hinges(root, file.size, file);
  read_tolerance(root, file);
  if (file.goal.solid && file.robust)
    throw root.optional("robust")->error(
        "only applies to boxes and nets of squares. Remove the key for a solid");
  if (file.goal.solid && file.limits.any())
    throw root.optional("tolerance")
        ->error("force_N and strain only apply to boxes and nets of squares. Remove them for a solid");
  return file;
}

namespace {

using Json = nlohmann::ordered_json;

constexpr double reported_miss =
    0.001;  // degrees of a crease, and ratio to a face's edge: less is irrelevant

/// Describes the columns of all creases: "2 columns", or "1 to 4 columns".
std::string describe_columns(const targets::NetLayout& layout) {
  int least = targets::max_crease_columns, most = 0;
  for (const targets::PlacedCrease& crease : layout.creases) {
    least = std::min(least, crease.columns());
    most = std::max(most, crease.columns());
  }
  if (least >= most) return fmt::format("{} {}", most, most == 1 ? "column" : "columns");
  return fmt::format("{} to {} columns", least, most);
}

std::string size_text(const targets::FoldGoal& goal, const std::array<double, 3>& mm) {
  std::string text =
      fmt::format("{} box {:.1f} x {:.1f} x {:.1f} mm", goal.open ? "folded" : "closed", mm[0], mm[1], mm[2]);
  const auto& asked = goal.box_mm;
  if (asked)
    text += fmt::format("; requested {:g} x {:g} x {:g} mm, off by at most {:.1f} %", (*asked)[0],
                        (*asked)[1], (*asked)[2], 100 * optim::size_miss(mm, *asked));
  return text;
}

std::string face_name(int face) { return std::to_string(face + 1); }

/// Returns the name of a crease, made of the numbers of its faces: "3-7".
std::string crease_name(const targets::SolidCrease& crease) {
  return face_name(crease.first) + "-" + face_name(crease.second);
}

Json places_json(const targets::SolidNet& net, const std::vector<int>& bodies) {
  Json out = Json::array();
  for (const int body : bodies)
    out.push_back({net.structure.graph.vertices[body].x(), net.structure.graph.vertices[body].y()});
  return out;
}

/// Lists the bodies at the corners of a face in order, with the first one repeated at the end.
std::vector<int> round_face(const targets::SolidFace& face) {
  std::vector<int> corners;
  for (const std::vector<int>& side : face.sides)
    for (const int body : {side.front(), side.back()})
      if (corners.empty() || corners.back() != body) corners.push_back(body);
  if (corners.back() != corners.front()) corners.push_back(corners.front());
  return corners;
}

Json target_of(const targets::FoldGoal& goal, const targets::FoldNet& net) {
  Json out = {{"kind", "fold"}};
  if (goal.box) out["box"] = *goal.box;
  if (goal.box_mm) out["box_mm"] = *goal.box_mm;
  if (goal.open) out["open"] = targets::box_face_names()[*goal.open];
  out["faces"] = Json::array();
  for (const targets::FoldFace& face : net.faces)
    out["faces"].push_back({{"name", face.name}, {"cells", {face.width, face.height}}});
  out["creases"] = Json::array();
  for (const targets::FoldCrease& crease : net.creases)
    out["creases"].push_back({{"faces", {net.faces[crease.first].name, net.faces[crease.second].name}},
                              {"side", to_string(crease.side)},
                              {"angle_deg", to_degrees(crease.angle)},
                              {"shift", crease.shift}});
  return out;
}

Json target_of(const targets::SolidGoal& goal, const targets::SolidNet& net) {
  Json out = {{"kind", "fold"}, {"solid", goal.name}, {"cells", goal.cells}};
  out["faces"] = Json::array();
  for (std::size_t f = 0; f < net.faces.size(); ++f)
    out["faces"].push_back({{"name", face_name(static_cast<int>(f))}});
  out["creases"] = Json::array();
  for (const targets::SolidCrease& crease : net.creases)
    out["creases"].push_back({{"faces", {face_name(crease.first), face_name(crease.second)}},
                              {"angle_deg", to_degrees(crease.angle)}});
  return out;
}

void add_crease(const optim::FoldedNet& net, std::size_t c, FoldShape& shape) {
  const targets::FoldCrease& crease = net.net.creases[c];
  const targets::PlacedCrease& placed = net.layout.creases[c];
  FoldShape::Crease out{crease_name(net.net, crease), crease.angle, {}, {}};
  for (const model::Wall& wall : bending_walls(placed)) out.hinges.push_back(*net.structure.hinge_at(wall));
  out.section = {{"name", out.name},
                 {"faces", {crease.first, crease.second}},
                 {"axis", placed.axis == model::Axis::x ? "x" : "y"},
                 {"cell", label(placed.cells.low)},
                 {"cells", {placed.cells.width, placed.cells.height}},
                 {"columns", placed.columns()}};
  shape.creases.push_back(std::move(out));
}

void add_crease(const targets::SolidNet& net, const targets::SolidCrease& crease, FoldShape& shape) {
  const auto& edges = net.structure.graph.edges;
  const auto &near = crease.hinges.front(), &far = crease.hinges.back();
  const std::vector<int> corners = {edges[near.front()].from, edges[near.back()].from, edges[far.back()].to,
                                    edges[far.front()].to};
  FoldShape::Crease out{crease_name(crease), crease.angle, {}, {}};
  for (const std::vector<int>& column : crease.hinges)
    out.hinges.insert(out.hinges.end(), column.begin(), column.end());
  out.section = {{"name", out.name},
                 {"faces", {crease.first, crease.second}},
                 {"corners", places_json(net, corners)},
                 {"columns", net.columns}};
  shape.creases.push_back(std::move(out));
}

void add_face(const optim::FoldedNet& net, std::size_t f, FoldShape& shape) {
  const model::CellRectangle& face = net.layout.faces[f];
  shape.faces.push_back(
      {{"name", net.net.faces[f].name}, {"cell", label(face.low)}, {"cells", {face.width, face.height}}});
  std::vector<int>& outline = shape.outlines.emplace_back();
  for (const auto& [i, j] :
       {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1), std::pair(0, 0)})
    outline.push_back(*net.structure.body_at({face.low.i + i * face.width, face.low.j + j * face.height}));
  shape.side += (face.width + face.height) / 2.0 / static_cast<double>(net.layout.faces.size());
}

void add_face(const targets::SolidNet& net, std::size_t f, FoldShape& shape) {
  std::vector<int> ends;
  for (const auto& side : net.faces[f].sides) ends.insert(ends.end(), {side.front(), side.back()});
  shape.faces.push_back({{"name", face_name(static_cast<int>(f))}, {"corners", places_json(net, ends)}});
  shape.outlines.push_back(round_face(net.faces[f]));
}

/// Adds the results that both searches have: attempts, evaluations, and whether it folds or was stopped.
template <class Design>
void add_search(const Design& design, FoldShape& shape) {
  shape.attempts = design.attempts;
  shape.evaluations = design.evaluations;
  shape.folds = design.folds;
  shape.stopped = design.stopped;
}

}  // namespace

std::vector<std::string> FoldShape::violations(const FoldFile& file, const targets::FoldError& of,
                                               const std::string& who) const {
  std::vector<std::string> why;
  for (std::size_t c = 0; c < creases.size(); ++c)
    if (!(std::abs(of.fold[c] - creases[c].angle) <= file.angle_tolerance))
      why.push_back(
          fmt::format("{}: crease `{}` folds by {:.2f} deg; {:.2f} deg is required, within {:.3g} deg", who,
                      creases[c].name, to_degrees(of.fold[c]), to_degrees(creases[c].angle),
                      to_degrees(file.angle_tolerance)));
  if (!(of.rms <= file.shape_tolerance))
    why.push_back(fmt::format("{}: faces are {} mm rms off the solid, limit {} mm", who,
                              format_figures(of.rms * face_mm()),
                              format_figures(file.shape_tolerance * face_mm())));
  return why;
}

double FoldShape::largest_miss(const targets::FoldError& of) const {
  double most = 0;
  for (std::size_t c = 0; c < creases.size(); ++c)
    most = std::max(most, std::abs(of.fold[c] - creases[c].angle));
  return most;
}

double FoldShape::face_mm() const { return side * sheet.size().edge_mm * std::cos(theta); }

std::string FoldShape::describe(const targets::FoldError& of, const std::optional<Limits>& limits) const {
  const auto limit = [&](double value, const char* unit) {
    return limits ? fmt::format(" (limit {}{})", format_figures(value), unit) : "";
  };
  return fmt::format("{} crease{} within {:.3g} deg{}, faces {} mm rms off{}", creases.size(),
                     creases.size() == 1 ? "" : "s", std::max(to_degrees(largest_miss(of)), reported_miss),
                     limit(limits ? limits->angle_deg : 0, ""), format_figures(of.rms * face_mm()),
                     limit(limits ? limits->shape * face_mm() : 0, " mm"));
}

std::array<double, 3> edges_mm(const targets::FoldGoal& goal, const optim::FoldDesign& design) {
  const optim::FoldedNet& net = design.folded;
  return optim::folded_box(*goal.box, goal.open, net.structure.size.edge_mm, net.theta,
                           net.layout.creases[0].columns());
}

FoldShape shape_of(const targets::FoldGoal& goal, const optim::FoldDesign& design) {
  const optim::FoldedNet& net = design.folded;
  FoldShape out{.sheet = net.structure,
                .theta = net.theta,
                .target = target_of(goal, net.net),
                .error = net.error,
                .tilt = net.tilt};
  for (std::size_t f = 0; f < net.net.faces.size(); ++f) add_face(net, f, out);
  for (std::size_t c = 0; c < net.net.creases.size(); ++c) add_crease(net, c, out);
  add_search(design, out);
  out.obstacles = design.obstacles;
  out.why_not = "no unfolding and no number of columns tried folds freely";
  out.unfoldings = goal.nets.size();
  out.unfolding = design.net;
  out.lines = {{"net", fmt::format("{} face{}, {} per crease, unfolding {} of {}", net.net.faces.size(),
                                   net.net.faces.size() == 1 ? "" : "s", describe_columns(net.layout),
                                   design.net + 1, goal.nets.size())}};
  if (goal.box) {
    out.edges_mm = edges_mm(goal, design);
    out.lines.push_back({"size", size_text(goal, *out.edges_mm)});
  }
  out.error_of = [net](const model::State& state) {
    return fold_error(net.net, net.layout, net.structure, state, net.theta);
  };
  out.ideal = [net](const model::Lattice& sheet, const model::State& state) {
    return ideal_vertices(net.net, net.layout, *sheet.squares(), state, net.theta);
  };
  return out;
}

FoldShape shape_of(const targets::SolidGoal& goal, const optim::SolidDesign& design) {
  const targets::SolidNet& net = design.net;
  FoldShape out{.sheet = net.structure,
                .theta = design.theta,
                .target = target_of(goal, net),
                .side = net.edge,
                .error = design.error,
                .tilt = design.tilt};
  for (std::size_t f = 0; f < net.faces.size(); ++f) add_face(net, f, out);
  for (const targets::SolidCrease& crease : net.creases) add_crease(net, crease, out);
  add_search(design, out);
  for (const optim::FoldAttempt& attempt : design.attempts) out.obstacles.push_back(attempt.why);
  out.why_not = "no number of columns tried folds freely";
  out.lines = {{"net", fmt::format("{} face{} of {} cells per side, {} {} per crease", net.faces.size(),
                                   net.faces.size() == 1 ? "" : "s", 2 * goal.cells, net.columns,
                                   net.columns == 1 ? "column" : "columns")},
               {"size", fmt::format("edges of {:.1f} mm when it is closed",
                                    net.edge * net.structure.size.edge_mm * std::cos(design.theta))}};
  out.error_of = [net, theta = design.theta](const model::State& state) {
    return solid_error(net, state, theta);
  };
  out.ideal = [net, theta = design.theta](const model::Lattice&, const model::State& state) {
    return ideal_places(net, state, theta);
  };
  return out;
}

}  // namespace kinetix::app
