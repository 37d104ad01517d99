#include "app/studio/play/page_updates.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <string_view>

namespace kinetix::app::studio {
namespace {

constexpr double layout = 1;  // version of the layout below

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

constexpr double max_owed_s = 0.1;  // s simulated: a delay of a tenth of a second is not visible
// Computing time between two frames: it leaves 20 frames per second, even if the engine is slow.
constexpr std::chrono::milliseconds busy{30};

}  // namespace

std::string frame_bytes(const Frame& frame, std::int64_t number, int client) {
  Numbers out(10 + 7 * frame.state.size());
  const auto processed = frame.processed.find(client);
  out.add(layout);
  out.add(static_cast<double>(number));
  out.add(frame.revision);
  out.add(frame.theta);
  out.add(frame.seconds);
  out.add(processed == frame.processed.end() ? 0 : processed->second);
  out.add(frame.force_N);
  out.add(frame.energy_Nmm);
  out.add(static_cast<double>(frame.mode));
  out.add(static_cast<double>(frame.state.size()));
  for (const model::Pose& pose : frame.state) add_pose(out, pose);
  return out.take();
}

void PlayTime::restart() {
  pending_s_ = 0;
  played_ = Clock::now();
}

void PlayTime::pass(double speed, const std::function<bool()>& plays, const std::function<void()>& step) {
  const Clock::time_point now = Clock::now();
  const double passed = std::chrono::duration<double>(now - played_).count();
  pending_s_ = std::min(pending_s_ + speed * passed, max_owed_s);
  played_ = now;
  if (!plays()) return;
  for (; pending_s_ >= live_step_s && Clock::now() - now < busy; pending_s_ -= live_step_s) step();
}

namespace {

constexpr std::array<std::string_view, 7> present = {"hello", "meshes", "design",  "state",
                                                     "path",  "result", "progress"};

bool accumulates(const Text& text) {
  return std::find(present.begin(), present.end(), text.type) == present.end();
}

}  // namespace

void WaitingTexts::add(Text text) {
  if (accumulates(text)) {
    counted_ += text.bytes->size();
    texts_.push_back(std::move(text));
    return;
  }
  const auto first = [this](std::string_view type) {
    return std::find_if(texts_.begin(), texts_.end(), [&](const Text& one) { return one.type == type; });
  };
  const auto older = first(text.type);
  // Results and paths must follow the design that they belong to, and a design must follow its meshes.
  if (older != texts_.end() && (text.type == "design" || text.type == "meshes")) {
    *older = std::move(text);
    return;
  }
  texts_.insert(text.type == "meshes" ? first("design") : texts_.end(), std::move(text));
  if (older != texts_.end()) texts_.erase(older);
}

Text WaitingTexts::take() {
  Text first = std::move(texts_.front());
  texts_.pop_front();
  if (accumulates(first)) counted_ -= first.bytes->size();
  return first;
}

}  // namespace kinetix::app::studio
