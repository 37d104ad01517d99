#include "app/print/folding_card.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/print/format/sheet_drawing.hpp"
#include "app/print/print_report.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/run/plan.hpp"
#include "model/base/box.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Rings = std::vector<std::vector<Vector2d>>;

constexpr double picture_wide_mm = 180, picture_high_mm = 78;  // mm, of A4 within its margins
constexpr double arrow_rim_mm = 16, bare_rim_mm = 2;           // mm about a sheet, with arrows and without
constexpr double outline_mm = 0.12, bold_mm = 0.8;             // mm: thin and bold lines of a page
constexpr double arrow_mm = 12, head_mm = 4;                   // mm, length of an arrow and of its head
constexpr const char *body_fill = "#d9d9d4", *ink = "#202020", *push = "#c03030";

/// Place of a sheet on a picture: how its mm become mm on the page.
struct PageScale {
  Vector2d low, high;  ///< box of the drawing, mm
  double rim_mm;       ///< about the drawing, mm of the page
  double reduction;    ///< mm of the sheet per mm of the page

  Vector2d operator()(const Vector2d& p) const {
    return {(p.x() - low.x()) / reduction + rim_mm, (high.y() - p.y()) / reduction + rim_mm};
  }
  Vector2d size() const { return (high - low) / reduction + Vector2d(2 * rim_mm, 2 * rim_mm); }
};

/// Returns the least reduction in steps of a half with which a drawing fits: 1 is true size.
PageScale fit_on_page(const SheetDrawing& drawing, double rim_mm) {
  const Vector2d sides = drawing.high - drawing.low;
  const double least =
      std::max(sides.x() / (picture_wide_mm - 2 * rim_mm), sides.y() / (picture_high_mm - 2 * rim_mm));
  return {drawing.low, drawing.high, rim_mm, std::max(1.0, std::ceil(2 * least) / 2)};
}

std::string describe_scale(double reduction) {
  return reduction == 1 ? "true size" : fmt::format("1 : {:g}", reduction);
}

void add_parts(CardPicture& picture, const PageScale& scale, const std::vector<SheetDrawing::Part>& parts,
               const char* fill) {
  for (const SheetDrawing::Part& part : parts) {
    Rings rings = part.rings;
    for (auto& ring : rings)
      for (Vector2d& p : ring) p = scale(p);
    picture.shapes.push_back({std::move(rings), fill, ink, outline_mm});
  }
}

/// Adds a triangle with its tip there.
void add_head(CardPicture& picture, const Vector2d& tip, const Vector2d& along) {
  const Vector2d back = tip - head_mm * along, across = head_mm / 2 * Vector2d(-along.y(), along.x());
  picture.shapes.push_back({{{tip, back + across, back - across}}, push, push, outline_mm});
}

void add_arrow(CardPicture& picture, const Vector2d& tip, const Vector2d& along) {
  picture.shapes.push_back({{{tip - arrow_mm * along, tip - head_mm * along}}, "", push, bold_mm});
  add_head(picture, tip, along);
}

/// Adds an arrow that turns about a place. @param sense 1: counter-clockwise seen from above
void add_turn(CardPicture& picture, const Vector2d& middle, double sense) {
  constexpr double radius_mm = 6, from = 0.3, to = 2.6;  // mm, rad
  constexpr int parts = 16;
  std::vector<Vector2d> arc;
  for (int k = 0; k <= parts; ++k) {
    const double angle = from + (to - from) * (sense > 0 ? k : parts - k) / parts;
    arc.push_back(middle + radius_mm * Vector2d(std::cos(angle), -std::sin(angle)));
  }
  const Vector2d along = (arc.back() - arc[parts - 1]).normalized();
  const Vector2d tip = arc.back() + head_mm / 2 * along;
  picture.shapes.push_back({{arc}, "", push, bold_mm});
  add_head(picture, tip, along);
}

/// Returns the hinge nearest to the middle of the sheet.
int middle_hinge(const SheetDrawing& drawing) {
  const Vector2d middle = (drawing.low + drawing.high) / 2;
  const auto nearer = [&](const auto& a, const auto& b) {
    return (a.place - middle).squaredNorm() < (b.place - middle).squaredNorm();
  };
  return static_cast<int>(std::min_element(drawing.hinges.begin(), drawing.hinges.end(), nearer) -
                          drawing.hinges.begin());
}

/// Returns how the upper body of a hinge turns against the lower one on the way to the fold, 1: counter-clockwise.
double sense_of_turn(const PrintSheet& sheet, int hinge) {
  const model::RestHinge& at = sheet.linkage.hinges[hinge];
  const double turn = hinge_turn(sheet.linkage, sheet.path.back(), hinge);
  return std::copysign(1.0, turn * at.axis.z());
}

constexpr const char* warm_springs = "Warm it. The springs in its hinges fold it.";

/// Adds to the flat picture what a drive does, and returns it in words.
struct DriveDrawing {
  const PrintSheet& sheet;
  const SheetDrawing& drawing;
  const PageScale& scale;
  CardPicture& picture;

  std::string operator()(const model::Plates& plates) const {
    const Vector2d low = scale({drawing.low.x(), drawing.high.y()}),
                   high = scale({drawing.high.x(), drawing.low.y()}), middle = (low + high) / 2;
    const bool across = plates.axis == model::Axis::y;
    const Vector2d along = across ? Vector2d(0, 1) : Vector2d(1, 0);
    add_arrow(picture, across ? Vector2d(middle.x(), low.y()) : Vector2d(low.x(), middle.y()), along);
    add_arrow(picture, across ? Vector2d(middle.x(), high.y()) : Vector2d(high.x(), middle.y()), -along);
    return fmt::format(
        "Push the two sides at the arrows towards each other, all along them, until they are {} nearer than "
        "when flat.",
        describe_approach(plates));
  }
  /// Describes by how much plates come nearer: in mm, and in percent if they grip a part of the sheet.
  std::string describe_approach(const model::Plates& plates) const {
    if (plates.grip) return fmt::format("{:.3g} %", 100 * plates.compression);
    Eigen::AlignedBox3d rest;
    for (const model::LinkageBody& body : sheet.linkage.bodies) rest.extend(body.position);
    const double flat_mm = sheet.linkage.size.edge_mm * rest.sizes()[plates.axis == model::Axis::x ? 0 : 1];
    return fmt::format("{:.3g} mm", flat_mm * plates.compression);
  }
  std::string operator()(const model::HingeTurn& turn) const {
    add_turn(picture, scale(drawing.hinges[turn.hinge].place), sense_of_turn(sheet, turn.hinge));
    return fmt::format("Turn the hinge at the arrow by {:.3g} degrees. The others follow.",
                       std::abs(to_degrees(turn.angle)));
  }
  std::string operator()(const model::CordPull& cord) const {
    std::vector<Vector2d> line;
    for (const int hinge : cord.through) line.push_back(scale(drawing.hinges[hinge].place));
    picture.shapes.push_back({{line}, "", push, bold_mm});
    if (line.size() > 1) add_head(picture, line.back(), (line.back() - line[line.size() - 2]).normalized());
    return fmt::format(
        "Tie a string to the hinge at one end of the line, lead it past the others, and pull it until it is "
        "{:.3g} mm shorter.",
        cord.shorten_mm);
  }
  std::string operator()(const model::ShapeMemory&) const { return warm_springs; }
  std::string operator()(const model::BodyPull&) const { return "Pull its parts to their places."; }
};

/// Returns how to clean a print. @param supports whether supports were printed outside its pins
std::string describe_cleaning(const std::string& process, bool supports) {
  if (process == "polyjet")
    return "Take the support material out of every gap, with a water jet or in its bath.";
  if (process == "laser") return "Take it out of the sheet, and push the waste out of its cells.";
  if (process == "sls") return "Blow the powder out of every gap with compressed air.";
  if (process == "sla")
    return "Wash it, and let the solvent run through every gap, before it is cured. Cut its supports off.";
  if (process == "fdm" && supports)
    return "Break the supports off. They are outside the hinges: leave none in a gap.";
  return "There are no supports. Take it off the bed, and cut off what spread there.";
}

constexpr double thinnest_blade_mm = 0.2;  // mm: blades of knives begin there

std::string describe_freeing(const PrintSheet& sheet) {
  if (!is_pin(sheet.kind())) return "Bend every hinge once to each side.";
  const double clearance_mm = least_clearance_mm(sheet).value_or(0);
  const std::string stuck = clearance_mm < thinnest_blade_mm
                                ? "warm it with a hair dryer, and turn it again."
                                : fmt::format("push a blade into its gap of {:.2g} mm.", clearance_mm);
  return "Turn every hinge a few degrees to and fro. Where one sticks, " + stuck;
}

std::string describe_force(const Folding& folding) {
  if (folding.is_unaided) return "";
  const std::string load =
      folding.is_force ? fmt::format("{:.3g} N", folding.load) : fmt::format("{:.3g} N mm", folding.load);
  const std::string effort = describe_effort(folding);
  const std::string tool = effort == "by hand"        ? "which a hand gives"
                           : effort == "with a clamp" ? "which takes a clamp or another tool"
                                                      : "which is more than a clamp gives";
  return fmt::format(
      " It takes {}, {}.{}", load, tool,
      folding.turns_freely ? " This is the friction of its pins, which is an assumption." : "");
}

/// Makes a sentence of the reason why no drive folds the sheet.
std::string describe_no_push(const std::string& why) {
  return why.starts_with("no drive") ? "N" + why.substr(1) + "." : "No single push folds it: " + why + ".";
}

std::string describe_locking(const Lock& lock) {
  const char* const how = lock.kind == "clip"
                              ? "Hold the fold, and put the clip over the posts of bodies {} and {}."
                              : "Hold the fold, and pull a strap tight through the eyes of bodies {} and {}.";
  return fmt::format(fmt::runtime(how), lock.bodies[0], lock.bodies[1]);
}

std::vector<Eigen::Vector3d> placed_points(const PrintSheet& sheet, const model::State& state) {
  std::vector<Eigen::Vector3d> all;
  for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b)
    for (const Eigen::Vector3d& p : placed_body(sheet, state, b).points) all.push_back(p);
  return all;
}

std::string format_sides(const Eigen::Vector3d& mm) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", mm.x(), mm.y(), mm.z());
}

/// Returns the rotation to a view from the front, the right and above.
Eigen::Matrix3d slanted_view() {
  constexpr double about_z = -0.5, about_x = -1.05;  // rad
  return (Eigen::AngleAxisd(about_x, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(about_z, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

CardPicture draw_fold(const PrintSheet& sheet) {
  const model::State fold = aligned(sheet.path.back(), sheet.path.front());
  const SheetDrawing view = sheet_view(sheet, fold, slanted_view());
  const PageScale scale = fit_on_page(view, bare_rim_mm);
  CardPicture picture{scale.size()};
  add_parts(picture, scale, view.bodies, body_fill);
  picture.caption =
      fmt::format("Folded: {}, seen from a corner, {}",
                  format_sides(smallest_box(placed_points(sheet, fold))), describe_scale(scale.reduction));
  return picture;
}

}  // namespace

FoldingCard make_folding_card(const PrintJob& job) {
  const PrintSheet& sheet = job.sheet;
  const SheetDrawing drawing = sheet_drawing(sheet);
  const PageScale scale = fit_on_page(drawing, arrow_rim_mm);
  CardPicture flat{scale.size()};
  add_parts(flat, scale, drawing.bodies, body_fill);
  add_parts(flat, scale, drawing.soft, "#2e6fb7");
  flat.caption = fmt::format("Flat: {}, seen from above, {}",
                             format_sides(model::box_of(placed_points(sheet, sheet.path.front())).sizes()),
                             describe_scale(scale.reduction));
  FoldingCard card{sheet.name, {}, {}};
  card.steps = {{"Clean", describe_cleaning(sheet.process.name, plan_supports(job).is_needed)}};
  if (sheet.loose_rods() > 0) card.steps.push_back({"Rods", describe_rods(sheet) + "."});
  card.steps.push_back({"Free", describe_freeing(sheet)});
  const bool folds = sheet.path.size() > 1;
  const std::optional<Folding>& folding = job.folding;
  if (folding && folding->drive && folds) {
    const std::string how = std::visit(DriveDrawing{sheet, drawing, scale, flat}, *folding->drive);
    if (!std::holds_alternative<model::HingeTurn>(*folding->drive)) {
      const int start = middle_hinge(drawing);
      const Vector2d place = scale(drawing.hinges[start].place);
      add_turn(flat, place, sense_of_turn(sheet, start));
      flat.labels.push_back(
          {place + Vector2d(arrow_rim_mm, -arrow_rim_mm / 2), fmt::format("hinge {}", start + 1)});
      card.steps.push_back(
          {"Start", fmt::format("A flat sheet can fold to two sides. Turn one half of hinge {} as the round "
                                "arrow shows, and hold it.",
                                start + 1)});
    }
    card.steps.push_back({"Fold", how + describe_force(*folding)});
  } else if (folding && folding->is_unaided) {
    card.steps.push_back({"Fold", warm_springs});
  } else if (folding && folding->is_by_turns()) {
    card.steps.push_back({"Fold",
                          "Turn one hinge after the other until the sheet looks as in the second picture. "
                          "The pushes that were tried lead to another fold."});
  } else if (folding && !folding->is_possible()) {
    card.steps.push_back({"Fold", describe_no_push(folding->why_not)});
  } else {
    card.steps.push_back({"Fold", "Which push folds it is not known."});
  }
  if (sheet.lock) card.steps.push_back({"Lock", describe_locking(*sheet.lock)});
  card.pictures.push_back(std::move(flat));
  if (folds) card.pictures.push_back(draw_fold(sheet));
  return card;
}

}  // namespace kinetix::app
