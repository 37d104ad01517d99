#pragma once

#include "model/material/manufactured_hinge.hpp"

namespace kinetix::model {

/// Standard deviations of printed dimensions from their nominal values, from hinge to hinge. The values in
/// processes() are estimates: half a line, layer or droplet, and what guides call the accuracy of small
/// parts.
struct PrintError {
  double t_mm = 0.1;           ///< of the position of a hinge along its wall, >= 0
  double tilt_deg = 0.5;       ///< of a wall, degrees, >= 0
  double clearance_mm = 0.05;  ///< of the clearance of a pin, >= 0

  bool operator==(const PrintError&) const = default;
};

/// Cross-section of the line that a nozzle extrudes, mm.
struct Filament {
  double line_mm = 0;   ///< width, > 0
  double layer_mm = 0;  ///< height, > 0
};

/// Limits of a process that prints or cuts sheets, mm. Clearances are per side. For guidance only: printers, resins and settings
/// differ.
struct Process {
  std::string name;                 ///< as in files
  double clearance_mm = 0;          ///< in the plane of the layers; smaller ones fuse
  double upright_clearance_mm = 0;  ///< across the layers
  double min_wall_mm = 0;
  double min_pin_mm = 0;  ///< diameter
  PrintError sd = {};
  std::string source = {};
  std::string rubber = {};            ///< name of the material of soft parts
  std::array<double, 2> bed_mm = {};  ///< of a common printer or the user's, x and y
  double max_height_mm = 0;           ///< largest height of a print on that printer
  bool is_multi_material = false;  ///< hard and soft material in one print; else soft parts are printed apart
  std::string film = {};           ///< material of walls printed with living hinges; empty: separate strips
  bool spreads_on_bed = false;     ///< first layers spread: plastic is pressed, resin is overcured
  std::optional<Filament> filament = {};  ///< of extrusion processes, whose overhangs sag
  std::string carries = {};               ///< support of overhangs that needs no planning; empty: none
  /// Kinds of hinges that a design may leave open, in the order in which they are tried.
  std::vector<HingeKind> hinges = {HingeKind::pin, HingeKind::block};
  double min_film_mm = 0;     ///< thickness of a living hinge; 0: not checked
  double sheet_mm = 0;        ///< thickness of the flat sheet that walls are cut from; 0: walls are printed
  double kerf_mm = 0;         ///< width of the cut through that sheet
  bool is_bed_given = false;  ///< whether bed_mm is the user's: a larger sheet is cut into tiles

  /// Checks whether all walls are cut in one piece from a flat sheet: they are as high as it is thick.
  bool cuts_sheets() const { return sheet_mm > 0; }

  bool operator==(const Process& other) const {
    return name == other.name && clearance_mm == other.clearance_mm &&
           upright_clearance_mm == other.upright_clearance_mm && min_wall_mm == other.min_wall_mm &&
           min_pin_mm == other.min_pin_mm && min_film_mm == other.min_film_mm && sheet_mm == other.sheet_mm &&
           kerf_mm == other.kerf_mm && film == other.film && sd == other.sd;
  }
};

/// Returns the processes polyjet, fdm, sla, sls and laser (hinges.md section 3).
const std::vector<Process>& processes();
/// Finds a process by name. @return null for an unknown name
const Process* find_process(std::string_view name);

/// @throws InvalidInput, naming the field and its range
void validate(const PrintError& sd);

/// Standard deviations of a hinge's position and tilt because of a pin's clearance.
struct ClearanceScatter {
  double place_mm = 0;  ///< along the wall, and across it
  double tilt = 0;      ///< rad
};

/// Returns the scatter of a hinge because of its pin's clearance c. The pin's position is uniform within c,
/// which itself prints with the standard deviation s of the process. With the root mean square c' = sqrt(c^2
/// + s^2), the deviations are c' / sqrt(3) in position and atan(2 c' / h) / sqrt(3) in tilt. Both use the
/// whole clearance. Zero for other hinges, and for pins whose energy includes the clearance.
ClearanceScatter clearance_scatter(const ManufacturedHinge& hinge, const PrintError& sd);

/// Feature of a sheet that a process cannot print.
struct PrintProblem {
  std::string what;  ///< one sentence with the requested and the least size
  /// Cell edge, mm, at which it could be printed if the whole sheet, with its clearances, were scaled up.
  double cell_mm = 0;
};

/// Finds walls, rods and clearances that are too small, and bridges of a cut sheet that are too narrow, or
/// shorter than the cut is wide. The kind rod may be of wire of any diameter. Nothing is printed in its bore, which
/// only has to be wider than the rod by the scatter of the clearance. Printed elastomer and living hinges are not checked: their least thickness
/// depends on the line or droplet of the printer.
/// @param hinge empty: for a sheet whose hinges have no dimensions yet
std::vector<PrintProblem> print_problems(const Process& process, const CellSize& size,
                                         const std::optional<ManufacturedHinge>& hinge);

/// Returns the least cell edge at which the sheet could be printed if all of it were scaled up, mm. It is the
/// present edge if there is no problem.
double min_cell_mm(const Process& process, const CellSize& size,
                   const std::optional<ManufacturedHinge>& hinge);

}  // namespace kinetix::model
