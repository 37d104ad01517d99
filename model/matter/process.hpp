#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/matter/made_hinge.hpp"

namespace kinetix::model {

/// By how much what a process prints differs from what was asked, as standard deviations from hinge to hinge. Those
/// of processes() are estimates: half a line, layer or droplet, and what guides call the accuracy of small parts.
struct PrintError {
  double t_mm = 0.1;           ///< of the place of a hinge along its wall, >= 0
  double tilt_deg = 0.5;       ///< of a wall, degrees, >= 0
  double clearance_mm = 0.05;  ///< of the clearance of a pin, >= 0

  bool operator==(const PrintError&) const = default;
};

/// What a nozzle lays down, mm.
struct Filament {
  double line_mm = 0;   ///< width, > 0
  double layer_mm = 0;  ///< height, > 0
};

/// What a process can print, mm; clearances are a side. For guidance: printers, resins and settings differ.
struct Process {
  std::string name;                 ///< as files say it
  double clearance_mm = 0;          ///< in the plane of the layers: less fuses
  double upright_clearance_mm = 0;  ///< across the layers
  double least_wall_mm = 0;
  double least_pin_mm = 0;  ///< diameter
  PrintError sd = {};
  std::string source = {};
  std::string rubber = {};            ///< name of the material that its soft parts are made of
  std::array<double, 2> bed_mm = {};  ///< of a usual printer, x and y
  double most_height_mm = 0;          ///< of a print on it
  bool joins_two = false;  ///< hard and soft in one print; else soft parts are a print of their own
  std::string film =
      {};  ///< name of the material of walls and films in one; empty: films are strips of their own
  bool spreads_on_bed =
      false;  ///< first layers, as plastic is pressed and resin hardened for long against a bed
  std::optional<Filament> filament = {};  ///< of processes that lay one down: their overhangs sag
  std::string carries =
      {};  ///< what holds up overhangs without supports that one has to plan; empty: nothing

  bool operator==(const Process& other) const {
    return name == other.name && clearance_mm == other.clearance_mm &&
           upright_clearance_mm == other.upright_clearance_mm && least_wall_mm == other.least_wall_mm &&
           least_pin_mm == other.least_pin_mm && sd == other.sd;
  }
};

/// polyjet, fdm, sla, sls (docs/hinges.md section 3).
const std::vector<Process>& processes();
/// @return null for a name that none has
const Process* find_process(std::string_view name);

/// @throws InvalidInput, naming the field and its range
void validate(const PrintError& sd);

/// By how much the play of a pin moves its hinge, as standard deviations.
struct PlayScatter {
  double place_mm = 0;  ///< along the wall, and across it
  double tilt = 0;      ///< rad
};

/// A pin rests anywhere in its bore, evenly within its clearance c, which prints with the standard deviation s of the
/// process: c' = sqrt(c^2 + s^2) is the root of its mean square, and the hinge sits off by c' / sqrt(3) and leans by
/// atan(2 c' / h) / sqrt(3). Both at once, as if each had the play to itself. Nothing of blocks and films, and of pins
/// whose equilibrium itself has the play.
PlayScatter play_scatter(const MadeHinge& hinge, const PrintError& sd);

/// What of a sheet a process cannot print.
struct PrintProblem {
  std::string what;    ///< one sentence with the number asked and the least that can be
  double cell_mm = 0;  ///< the cell edge at which this could be printed were all of the sheet larger; a
                       ///< clearance grows with it
};

/// Walls, rods and clearances that are too small. Blocks and films are not judged: how thin they can be is up to
/// the line or droplet of the printer. @param hinge none: of a sheet whose hinges have no made shape yet
std::vector<PrintProblem> print_problems(const Process& process, const CellSize& size,
                                         const std::optional<MadeHinge>& hinge);

/// The least cell edge at which the sheet could be printed were all of it larger, mm: the edge itself where it can
/// be as it is.
double least_cell_mm(const Process& process, const CellSize& size, const std::optional<MadeHinge>& hinge);

}  // namespace kinetix::model
