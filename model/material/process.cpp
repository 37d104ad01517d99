#include "model/material/process.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

constexpr double plainly_less = 0.99;  // ratio to the least size: three digits show a larger difference

void check(const char* field, double value, double most) {
  require(field, value, value >= 0 && value <= most, "from 0 to " + number_text(most));
}

class Problems {
 public:
  Problems(const Process& process, double edge_mm) : process_(process), edge_mm_(edge_mm) {}

  /// @param asked, least mm
  void compare(const char* what, double asked, double least) {
    if (asked >= least) return;
    std::ostringstream text;
    if (asked < plainly_less * least) text << std::setprecision(3);
    text << what << " of " << asked << " mm is below the minimum of " << process_.name << ", " << least
         << " mm";
    all_.push_back({text.str(), edge_mm_ * least / asked});
  }

  std::vector<PrintProblem> all() && { return std::move(all_); }

 private:
  const Process& process_;
  const double edge_mm_;
  std::vector<PrintProblem> all_;
};

}  // namespace

const std::vector<Process>& processes() {
  static const std::vector<Process> all{
      {"polyjet",
       0.05,
       0.05,
       0.6,
       1,
       {0.05, 0.25, 0.02},
       "clearance: Ou et al. 2018, sections 5.1 and 7, 0.05 to 0.25 mm printed, 0.03 "
       "fuses; rods: Forge Labs, Design Guidelines, 1 mm; walls: an estimate, below "
       "the 1 mm that these recommend; errors: estimates, of the order of a layer and "
       "a droplet",
       "tango",
       {255, 252},
       200,
       true,
       "",
       false,
       {},
       "support material that the printer lays down by itself"},
      {"fdm",
       0.3,
       0.4,
       0.8,
       3,
       {0.15, 0.5, 0.1},
       "clearance: HyCube Works, 3D Design Guidelines, above 0.4 mm for loose and "
       "below 0.2 mm for tight fits, walls of 0.8 mm; rods: Arti90, Design Clues for "
       "3D Printing, 3 mm; upright: an estimate, two layers of 0.2 mm; errors: "
       "estimates",
       "tpu95a",
       {220, 220},
       250,
       true,
       "pp",
       true,
       Filament{.line_mm = 0.4, .layer_mm = 0.2}},  // a usual nozzle
      {"sla",
       0.25,
       0.25,
       0.8,
       1,
       {0.1, 0.5, 0.05},
       "clearance and walls: Makelab, Design Guidelines, 0.25 mm between parts that "
       "fit, 0.125 mm at least, walls of 0.8 mm; rods and errors: estimates",
       "tango",
       {145, 145},
       175,
       false,
       "",
       true},
      {"sls",
       0.3,
       0.3,
       0.8,
       1.5,
       {0.15, 0.5, 0.1},
       "clearance: Exaparts, Design guidelines (Formiga P110), 0.3 mm in radius; "
       "walls: additive.tools, PA12, 0.8 mm; rods: an estimate, above the 1 mm of "
       "Arti90, Design Clues for 3D Printing; errors: estimates",
       "tpu95a",
       {165, 165},
       300,
       false,
       "pa12",
       false,
       {},
       "the powder"},
      {.name = "laser",
       .min_wall_mm = 1,
       .sd = {0.05, 0.1, 0},
       .source =
           "kerf: Ponoko, How much material does the laser burn away?, 0.2 mm in acrylic of 3 mm; walls "
           "and bridges: Cut Laser Cut, Understanding the kerf of the laser, details below 1 mm are "
           "fragile, cuts nearer than 0.5 mm may burn away what is between them; place: Snapcut, Design "
           "Guidelines, 0.1 mm, as two deviations; sheet, largest thickness and tilt: estimates",
       .rubber = "tpu95a",
       .bed_mm = {600, 300},
       .max_height_mm = 10,
       .film = "pp",
       .carries = "the sheet",
       .hinges = {HingeKind::film},
       .min_film_mm = 0.5,
       .sheet_mm = 3,
       .kerf_mm = 0.2}};
  return all;
}

const Process* find_process(std::string_view name) {
  for (const Process& process : processes())
    if (process.name == name) return &process;
  return nullptr;
}

void validate(const PrintError& sd) {
  check("t_mm", sd.t_mm, 10);
  check("tilt_deg", sd.tilt_deg, 45);
  check("clearance_mm", sd.clearance_mm, 10);
}

ClearanceScatter clearance_scatter(const ManufacturedHinge& hinge, const PrintError& sd) {
  if (!is_pin(hinge.kind) || hinge.with_play) return {};
  ManufacturedHinge loose = hinge;
  loose.clearance_mm = std::hypot(hinge.clearance_mm, sd.clearance_mm);
  const double even = std::sqrt(3.0);
  return {play_mm(loose) / even, clearance_tilt(loose) / even};
}

std::vector<PrintProblem> print_problems(const Process& p, const CellSize& size,
                                         const std::optional<ManufacturedHinge>& hinge) {
  Problems problems(p, size.edge_mm);
  problems.compare("a wall", size.thickness_mm, p.min_wall_mm);
  if (hinge && hinge->kind == HingeKind::film) {
    problems.compare("a bridge", hinge->thickness_mm, p.min_film_mm);
    problems.compare("a bridge's length", hinge->gap_mm, p.kerf_mm);
  }
  if (hinge && hinge->kind == HingeKind::pin) {
    problems.compare("a rod", hinge->diameter_mm, p.min_pin_mm);
    problems.compare("a clearance", hinge->clearance_mm, p.clearance_mm);
  }
  if (hinge && hinge->kind == HingeKind::rod)
    problems.compare("a rod's clearance", hinge->clearance_mm, p.sd.clearance_mm);
  return std::move(problems).all();
}

double min_cell_mm(const Process& process, const CellSize& size,
                   const std::optional<ManufacturedHinge>& hinge) {
  double least = size.edge_mm;
  for (const PrintProblem& problem : print_problems(process, size, hinge))
    least = std::max(least, problem.cell_mm);
  return least;
}

}  // namespace kinetix::model
