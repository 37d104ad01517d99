#include "sim/physics_result.hpp"

namespace kinetix::sim {

std::string to_string(PhysicsResult::Status status) {
  switch (status) {
    case PhysicsResult::Status::settled:
      return "settled";
    case PhysicsResult::Status::not_settled:
      return "not settled";
    case PhysicsResult::Status::hinge_gap_exceeded:
      return "hinge gap exceeded";
    case PhysicsResult::Status::drive_missed:
      return "drive missed";
    case PhysicsResult::Status::wrong_branch:
      return "wrong branch";
    case PhysicsResult::Status::blocked:
      return "blocked";
    case PhysicsResult::Status::blew_up:
      break;
  }
  return "blew up";
}

}  // namespace kinetix::sim
