#include "benchmarks/peers/mujoco_run.hpp"

namespace kinetix::bench {

std::string to_string(MujocoResult::Status status) {
  switch (status) {
    case MujocoResult::Status::settled:
      return "settled";
    case MujocoResult::Status::not_settled:
      return "not settled";
    case MujocoResult::Status::blew_up:
      return "blew up";
    case MujocoResult::Status::not_installed:
      return "MuJoCo is not installed";
  }
  return "?";
}

}  // namespace kinetix::bench
