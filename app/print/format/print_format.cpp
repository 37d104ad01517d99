#include "app/print/format/print_format.hpp"

#include "targets/document/wording.hpp"

namespace kinetix::app {

const std::vector<const PrintFormat*>& print_formats() {
  static const std::vector<const PrintFormat*> list = {
      &stl_format, &threemf_format, &step_format, &svg_format,
      &dxf_format, &mjcf_format,    &glb_format,  &scad_format,
  };
  return list;
}

const PrintFormat& print_format(std::string_view name) {
  std::vector<std::string_view> names;
  for (const PrintFormat* format : print_formats()) {
    if (format->name == name) return *format;
    names.push_back(format->name);
  }
  names.push_back("all");
  throw InvalidInput("--format: unknown format " + targets::in_ticks(name) +
                     targets::did_you_mean(name, names) + "; allowed: " + targets::joined(names));
}

namespace {

constexpr double apart = 2;          // diameters, from one lying rod to the next: one is left free
constexpr double rods_apart_mm = 2;  // mm, from one column of lying rods to the next: they stay apart

/// Returns the length of a loose rod. Its points are alternately of the section below and above, as in rod_solid.
double length_of(const model::Polyhedron& rod) { return (rod.points[1] - rod.points[0]).norm(); }

double radius_of(const model::Polyhedron& rod) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : rod.points) middle += p / static_cast<double>(rod.points.size());
  const Eigen::Vector3d axis = (rod.points[1] - rod.points[0]).normalized(), arm = rod.points[0] - middle;
  return (arm - arm.dot(axis) * axis).norm();
}

/// Returns a rod that lies along x, from (x, y, 0) on.
model::Polyhedron lying(const model::Polyhedron& rod, double x, double y) {
  const double length = length_of(rod), radius = radius_of(rod);
  model::Polyhedron out = rod;
  const std::size_t sides = rod.points.size() / 2;
  for (std::size_t k = 0; k < rod.points.size(); ++k) {
    const double angle = 2 * pi * static_cast<double>(k / 2) / static_cast<double>(sides);
    out.points[k] = {x + (k % 2 == 0 ? 0 : length), y + radius * std::cos(angle),
                     radius + radius * std::sin(angle)};
  }
  return out;
}

}  // namespace

model::Polyhedron rounded_for_file(model::Polyhedron solid) {
  // Casts each number: Eigen 3.4 treats two casts of a vector in one expression as none.
  for (Eigen::Vector3d& p : solid.points)
    for (double& x : p) x = static_cast<float>(x);
  return solid;
}

model::Polyhedron hard_part(const PrintJob& job) {
  model::Polyhedron all;
  for (int b = 0; b < static_cast<int>(job.sheet.meshes.size()); ++b)
    append(placed(job.sheet.meshes[b], job.state()[b]), all);
  return rounded_for_file(std::move(all));
}

model::Polyhedron soft_part(const PrintJob& job) {
  model::Polyhedron all;
  for (int h = 0; h < static_cast<int>(job.sheet.soft.size()); ++h)
    if (!job.sheet.soft[h].points.empty()) append(placed_soft(job.sheet, job.state(), h), all);
  return rounded_for_file(std::move(all));
}

model::Polyhedron joined(model::Polyhedron hard, const model::Polyhedron& soft) {
  append(soft, hard);
  return hard;
}

TileParts tile_parts(const PrintJob& job, int tile) {
  const PrintSheet& sheet = job.sheet;
  const model::State& flat = job.folded ? sheet.path.front() : job.state();
  TileParts parts;
  for (int b = 0; b < static_cast<int>(sheet.meshes.size()); ++b)
    if (sheet.tiles.of_body[b] == tile) append(placed(sheet.meshes[b], flat[b]), parts.hard);
  for (int h = 0; h < static_cast<int>(sheet.soft.size()); ++h)
    if (sheet.tiles.of_body[sheet.linkage.hinges[h].lower] == tile && !sheet.soft[h].points.empty())
      append(placed_soft(sheet, flat, h), parts.soft);
  return {rounded_for_file(std::move(parts.hard)), rounded_for_file(std::move(parts.soft))};
}

bool is_printable_rod(const PrintSheet& sheet, int hinge) {
  return !sheet.rods[hinge].points.empty() &&
         sheet.hinges[hinge].made.diameter_mm >= sheet.process.min_pin_mm;
}

model::Polyhedron laid_out_rods(const PrintSheet& sheet) {
  model::Polyhedron all;
  double length = 0, width = 0;
  int count = 0;
  for (int h = 0; h < static_cast<int>(sheet.rods.size()); ++h) {
    if (!is_printable_rod(sheet, h)) continue;
    length = std::max(length, length_of(sheet.rods[h]));
    width = std::max(width, 2 * apart * radius_of(sheet.rods[h]));
    ++count;
  }
  if (count == 0) return all;
  // Enough rows per column to make the field about square, like a bed.
  const int rows = static_cast<int>(std::ceil(std::sqrt(count * (length + rods_apart_mm) / width)));
  int placed = 0;
  for (int h = 0; h < static_cast<int>(sheet.rods.size()); ++h) {
    if (!is_printable_rod(sheet, h)) continue;
    append(lying(sheet.rods[h], (placed / rows) * (length + rods_apart_mm), (placed % rows) * width), all);
    ++placed;
  }
  return rounded_for_file(std::move(all));
}

namespace {

constexpr double on_bed_mm = 0.01;  // mm: less than any layer; corners of files are floats

double lowest(const model::Polyhedron& solid, const Eigen::Vector3d& up) {
  double low = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : solid.points) low = std::min(low, up.dot(p));
  return low;
}

}  // namespace

double steepest_deg(const PrintSheet& sheet) {
  double least = 1;
  for (const model::RestHinge& hinge : sheet.linkage.hinges)
    least = std::min(least, std::abs(hinge.axis.z()));
  return to_degrees(std::acos(least));
}

double overhang_mm2(const model::Polyhedron& solid, const Eigen::Matrix3d& turn) {
  const Eigen::Vector3d up = turn.row(2).transpose();
  const double bed = lowest(solid, up) + on_bed_mm, steep = std::sin(steep_deg * radians_per_degree);
  double area = 0;
  for (const auto& [a, b, c] : solid.triangles) {
    const Eigen::Vector3d &p = solid.points[a], &q = solid.points[b], &r = solid.points[c];
    if (up.dot(p) < bed && up.dot(q) < bed && up.dot(r) < bed) continue;
    const Eigen::Vector3d twice = (q - p).cross(r - p);  // outwards, its length twice the area
    // Slightly steeper than the limit, so that walls at 45 degrees do not depend on rounding.
    if (-up.dot(twice) > (steep + 1e-6) * twice.norm()) area += twice.norm() / 2;
  }
  return area;
}

std::vector<PrintOrientation> lies(const PrintJob& laid) {
  PrintJob job = laid;
  job.turned.reset();
  const model::Polyhedron all = joined(hard_part(job), soft_part(job));
  std::vector<PrintOrientation> out{{"flat", Eigen::Matrix3d::Identity()},
                                    {"over", Eigen::Vector3d(1, -1, -1).asDiagonal()}};
  for (PrintOrientation& lie : out) lie.overhang_mm2 = overhang_mm2(all, lie.turn);
  return out;
}

const PrintOrientation& best(const std::vector<PrintOrientation>& all) {
  return *std::min_element(all.begin(), all.end(), [](const PrintOrientation& a, const PrintOrientation& b) {
    return a.overhang_mm2 < b.overhang_mm2;
  });
}

void lay(PrintJob& job, const PrintOrientation& lie) {
  job.turned = job.state();
  for (model::Pose& pose : *job.turned) pose = {lie.turn * pose.R, lie.turn * pose.p};
  job.lie = lie.name;
}

}  // namespace kinetix::app
