#pragma once

#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"
#include "sim/physics_options.hpp"

namespace kinetix::sim {

/// The two parts of a state that overlap most or are closest to overlapping.
struct PartContact {
  int first = -1, second = -1;  ///< bodies; -1 if no parts touch
  double depth = 0;             ///< overlap, cell edges; slightly negative for parts that just touch

  bool touches() const { return first >= 0; }
};

/// Outcome of a simulation. Only a settled one is a valid result.
struct PhysicsResult {
  enum class Status {
    settled,             ///< at rest, hinges (unless elastic) and drive within gap_limit
    not_settled,         ///< still moving at the end of the time
    hinge_gap_exceeded,  ///< a hinge gap exceeds gap_limit (or exceeded tear_limit); elastic: stretch_limit
    drive_missed,        ///< hinges within limits, but the drive is off by more than gap_limit
    wrong_branch,        ///< plates: the sheet folded to the other sign of theta
    blocked,  ///< parts touch, and the (rigid) hinges or the drive give way or the parts overlap; ends the
              ///< run
    blew_up,  ///< a speed became infinite, NaN or larger than speed_limit
  };

  Status status = Status::not_settled;
  std::string why;        ///< the status in words, with its numbers
  model::State state;     ///< last state, mm, in the structure's body order; not finite if it blew up
  model::HingeGaps gaps;  ///< of that state
  double drive_gap = 0;   ///< largest distance of a gripped body from its plate, cell edges, or of the driven
                          ///< hinge from its angle, rad
  PartContact contact;    ///< in that state
  double residual_motion = 0;  ///< of parts that still oscillate at the end, cell edges or rad at half an
                               ///< edge (PhysicsOptions::settle_residual_motion)
  int steps = 0;               ///< steps taken
  double simulated_s = 0;      ///< simulated time, s
  double seconds = 0;          ///< wall-clock time of the run, s
};

std::string to_string(PhysicsResult::Status status);

/// Returns the overlap of parts beyond which a run is blocked, cell edges. It is
/// PhysicsOptions::overlap_limit, or half the thickness of a wall with elastic hinges. Pressed deeper,
/// contact would push walls through each other.
double overlap_limit(const model::Linkage& structure, const PhysicsOptions& options);

/// Sets status and reason of a finished run from its last measurements.
/// @param settled whether the run came to rest.
/// @param result its status blew_up is kept
void set_status(const model::Linkage& structure, const model::LinkageDrive& drive,
                const PhysicsOptions& options, bool settled, PhysicsResult& result);

}  // namespace kinetix::sim
