#include "app/assembly/body_pieces.hpp"
#include "app/studio/session/session.hpp"

namespace kinetix::app::studio {

void Session::turn_by(const Message& message) {
  const Moving& moving = player_.moving();
  if (!moving.bodies) throw InvalidInput("driven: is of designs of bodies");
  const auto& hinges = moving.linkage.hinges;
  const int hinge = message.integer("hinge", 0, static_cast<int>(hinges.size()) - 1);
  if (hinges[hinge].ball) throw InvalidInput("hinge: is a ball, which has no axis to be turned about");
  player_.turn_by(hinge);
  ++revision_;
  tell_design();
  tell_state();
  follow(0, {});
}

/// Finds the way of the hinge that is turned, and then looks it through for bodies that meet.
/// @param theta to which it is then turned, rad   @param pull of the bodies, instead of a turned hinge
void Session::follow(double theta, const std::optional<model::Pull>& pull) {
  start(follower_, 0, type_,
        [this, revision = revision_, theta, pull, moving = player_.moving()](const std::stop_token& asked) {
          const auto stop = [&] { return asked.stop_requested(); };
          const auto tell_way = [&](const BodiesWay& way, double to) {
            if (stop()) return;
            enqueue([this, revision, to, way = std::make_shared<const BodiesWay>(way)] {
              if (revision == revision_) take(way, to);
            });
          };
          BodiesWay way = way_of(moving.linkage, moving.way->hinge, pull, stop);
          tell_way(way, theta);
          const model::Assembly& assembly = moving.bodies->assembly;
          way.meets = {first_meeting(assembly, way.back, stop), first_meeting(assembly, way.forth, stop)};
          tell_way(way, 0);
        });
}

void Session::take(std::shared_ptr<const BodiesWay> way, double theta) {
  player_.take(std::move(way));
  tell_design();
  if (theta != 0) player_.fold_to(theta);
  changed_ = true;
}

/// Bodies collide in the engine by convex pieces, which are cut once and take a while.
void Session::cut_for_engine() {
  awaits_engine_ = true;
  const double id = std::exchange(id_, 0);
  start(cutter_, id, type_,
        [this, client = client_, id, bodies = player_.moving().bodies](const std::stop_token&) {
          const model::Assembly& assembly = bodies->assembly;
          const auto parts = std::make_shared<const sim::ContactParts>(
              contact_parts(pieces_of(assembly, opened_.threads), assembly));
          enqueue([this, client, id, parts] {
            player_.take(parts);
            if (std::exchange(awaits_engine_, false)) player_.enter(Mode::bullet);
            note_heard(client, id);
            changed_ = true;
            tell_state();
          });
        });
}

}  // namespace kinetix::app::studio
