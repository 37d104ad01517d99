#include "app/studio/play/frame.hpp"

#include <bit>

namespace kinetix::app::studio {
namespace {

constexpr double layout = 1;  // version of what follows

static_assert(std::endian::native == std::endian::little, "frames are little-endian");
static_assert(sizeof(double) == 8 && std::numeric_limits<double>::is_iec559, "and IEEE doubles");

class Numbers {
 public:
  explicit Numbers(std::size_t count) { bytes_.reserve(count * sizeof(double)); }
  void add(double value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

void add_pose(Numbers& out, const model::Pose& pose) {
  const Eigen::Quaterniond q(pose.R);
  for (const double v : {pose.p.x(), pose.p.y(), pose.p.z(), q.w(), q.x(), q.y(), q.z()}) out.add(v);
}

}  // namespace

std::string frame_bytes(const Frame& frame, std::int64_t number, int client) {
  Numbers out(10 + 7 * frame.state.size());
  const auto heard = frame.heard.find(client);
  out.add(layout);
  out.add(static_cast<double>(number));
  out.add(frame.revision);
  out.add(frame.theta);
  out.add(frame.seconds);
  out.add(heard == frame.heard.end() ? 0 : heard->second);
  out.add(frame.force_N);
  out.add(frame.energy_Nmm);
  out.add(static_cast<double>(frame.mode));
  out.add(static_cast<double>(frame.state.size()));
  for (const model::Pose& pose : frame.state) add_pose(out, pose);
  return out.take();
}

}  // namespace kinetix::app::studio
