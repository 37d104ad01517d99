#include "app/studio/session/session.hpp"

#include <mutex>
#include <optional>

#include "app/studio/messages/design_message.hpp"

namespace kinetix::app::studio {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the rows of an equilibrium path that the page draws.
Json path_rows(const KnownPath& way, const Equilibria& equilibria) {
  Json rows = Json::array();
  for (const model::DrivenState& at : way.states)
    rows.push_back({{"theta_rad", at.step.theta},
                    {"force_N", equilibria.force_N(at.step.theta, at.step.load)},
                    {"energy_Nmm", at.step.energy},
                    {"stable", at.step.stable}});
  return rows;
}

}  // namespace

/// Newest shape of an equilibrium path that is not shown yet.
struct Session::NewestShape {
  std::mutex mutex;
  std::optional<std::pair<model::DrivenState, double>> at;  ///< state and its force, N
};

/// Traces equilibria to theta on a separate thread, starting from the known ones. Shapes are shown as they
/// are found.
void Session::trace(double theta) {
  if (theta == 0) return show_flat();
  const int client = client_, number = ++traces_;
  const double id = std::exchange(id_, 0);
  start(tracer_, id, "theta",
        [this, client, number, id, theta, design = history_.current(), moving = player_.moving(),
         known = way_, is_settled = stable_of_ == way_](const std::stop_token& stop) {
          if (stop.stop_requested()) return dropped(client, id);
          const Equilibria equilibria(design, moving);
          const auto newest = std::make_shared<NewestShape>();
          const auto see = [&](const model::DrivenState& at) {
            const double force = equilibria.force_N(at.step.theta, at.step.load);
            const std::lock_guard lock(newest->mutex);
            const bool is_awaited = newest->at.has_value();
            newest->at.emplace(at, force);
            if (!is_awaited) enqueue([this, number, newest] { show_newest(number, *newest); });
          };
          std::string why;
          const auto way = equilibria.go(theta, known, stop, see, why);
          if (stop.stop_requested()) return dropped(client, id);
          Json rows = path_rows(*way, equilibria);
          enqueue([this, number, client, id, way, why, rows = std::move(rows)] {
            note_heard(client, id);
            changed_ = true;
            if (number != traces_) return;
            way_ = way;
            path_ = rows;
            send_path();
            if (!why.empty()) tell(error_message(why, 0, "equilibrium"), client);
          });
          if (way == known && is_settled) return;
          auto states = equilibria.stable(*way, stop);
          if (stop.stop_requested()) return;
          enqueue([this, number, way, states = std::move(states)] {
            if (number != traces_) return;
            stable_ = states;
            stable_of_ = way;
          });
        });
}

/// Shows the flat state, which needs no search: nothing is strained.
void Session::show_flat() {
  tracer_.stop_current();
  ++traces_;
  player_.show_equilibrium(rest_state(player_.moving().linkage), 0, 0, 0);
  changed_ = true;
}

void Session::show_newest(int number, NewestShape& newest) {
  std::optional<std::pair<model::DrivenState, double>> shape;
  {
    const std::lock_guard lock(newest.mutex);
    shape = std::exchange(newest.at, std::nullopt);
  }
  if (number != traces_ || !shape) return;
  const auto& [at, force] = *shape;
  player_.show_equilibrium(at.state, at.step.theta, force, at.step.energy);
  changed_ = true;
}

/// Reports the command as done: newer work replaced it.
void Session::dropped(int client, double id) {
  enqueue([this, client, id] {
    note_heard(client, id);
    changed_ = true;
  });
}

void Session::snap() {
  if (player_.mode() != Mode::equilibrium) throw InvalidInput("snap: needs the mode equilibrium");
  if (stable_.size() < 2)
    throw InvalidInput(
        "snap: no other stable state is known; fold further first, past where it would snap over");
  next_stable_ = (next_stable_ + 1) % stable_.size();
  const model::StableState& state = stable_[next_stable_];
  player_.show_equilibrium(state.state, player_.moving().theta_of(state.state), 0, state.energy);
}

}  // namespace kinetix::app::studio
